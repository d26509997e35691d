# SPDX-License-Identifier: GPL-3.0-or-later
#: Cook's membrane, nearly incompressible (Poisson's ratio 0.4995), plane strain: a panel with corners (0, 0) (48, 44)
#: (48, 60) (0, 44), clamped at the left, pulled upwards over its last 4 mm. Value: mean displacement of the loaded points.
#: Converged: 15.70 F/E, by four-node finite elements with averaged volume change, 15.634 15.670 15.685 with 48, 96, 192
#: elements a side. The missing part is volumetric locking.
BEGIN {
    length_x = 48; strip = 4; load = 1e-5
    if (what == "deck") { fill(length_x / cells); print_deck(length_x / cells) }
}
function fill(h,    s, i, j, x, y, low, high) {
    s = h / 2
    for (i = 0; i < 2 * cells; i++)
        for (j = 0; j < 3 * cells; j++) {
            x = (i + 0.5) * s; y = (j + 0.5) * s
            low = y - s / 2 > 44 * x / 48 ? y - s / 2 : 44 * x / 48
            high = y + s / 2 < 44 + 16 * x / 48 ? y + s / 2 : 44 + 16 * x / 48
            if (high - low < 0.05 * s) continue
            count++
            at_x[count] = x; at_y[count] = y; volume[count] = s * h * (high - low)
            if (x > length_x - strip) loaded += volume[count]
        }
}
function print_deck(h,    b, wall, i) {
    b = beyond(h); wall = has("sgmp") ? h : b
    head("Cook's membrane", count)
    printf "spx %.17g %.17g\nspy %.17g %.17g\nspz %.17g %.17g\ndcell %.17g\nfixed 1 0 0 0 2 2\n",
        -wall, 48 + 2 * h, -2 * h, 64 + 2 * h, -b, h + b, h
    printf "%s\ndtscale %s\nendt 20\ndigits 12\ntecp\noutr disy\n", words, dtsc
    if (has("damped")) print "Damp 0.86"
    printf "mate\n1 elas 1e-3 1 0.4995\npart poin 1 %d\n", count
    for (i = 1; i <= count; i++) printf "%d 1 %.17g %.17g %.17g %.17g\n", i, 1e-3 * volume[i], at_x[i], at_y[i], h / 2
    print "load"
    for (i = 1; i <= count; i++)
        if (at_x[i] > length_x - strip) printf "part %d 0 %.17g 0\n", i, load * h * volume[i] / loaded
    print "endl\nendi"
}
END {
    if (what == "measure") {
        fill(length_x / cells)
        for (i = 1; i <= count; i++)
            if (at_x[i] > length_x - strip) sum += volume[i] * value[i, "disy"]
        printf "%.8g\n", sum / loaded / load
    }
}
