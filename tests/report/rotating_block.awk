# SPDX-License-Identifier: GPL-3.0-or-later
#: An elastic square of side 1 turns by a quarter about its centre through the grid; its rim moves with 1/200 of the wave
#: speed, so that it is rigid to about 1e-4.
#: Exact: points go round on circles. The error is the root mean square of their distance from there, over that of their
#: distance from the centre.
BEGIN {
    pi = 3.14159265358979323846; spin = 2 * pi
    if (what == "deck") print_deck(1 / cells)
}
function print_deck(h,    b, id, x, y) {
    b = beyond(h)
    head("rotating block", 8 * cells * cells)
    printf "grid -1 2 -1 2 %.17g %.17g\ndcell %.17g\nfixed 0 0 0 0 2 2\n", -b, h + b, h
    printf "%s\ndtscale %s\nendt 0.25\ndigits 12\ntecp\noutr velx\n", words, dtsc
    printf "mate\n1 %s 1 %.17g 0.25\npart bloc 1\n1 1 %.17g 0 0 0 %d %d 2\nvelo\n", has("tl") ? "neoh" : "elas", 4e4 * pi * pi, h / 2,
        2 * cells, 2 * cells
    for (id = 0; id < 8 * cells * cells; id++) {
        x = (id % (2 * cells) + 0.5) * h / 2; y = (int(id / (2 * cells)) % (2 * cells) + 0.5) * h / 2
        printf "node %d %.17g %.17g 0\n", id + 1, -spin * (y - 0.5), spin * (x - 0.5)
    }
    print "endv\nendi"
}
END {
    if (what == "measure") {
        c = cos(spin * time); s = sin(spin * time)
        for (i = 1; i <= n; i++) {
            x = first[i, "X"] - 0.5; y = first[i, "Y"] - 0.5
            sum += (value[i, "X"] - 0.5 - c * x + s * y) ^ 2 + (value[i, "Y"] - 0.5 - s * x - c * y) ^ 2
            radius += x * x + y * y
        }
        printf "%.8g\n", sqrt(sum / radius)
    }
}
