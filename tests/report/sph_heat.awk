# SPDX-License-Identifier: GPL-3.0-or-later
#: Smoothed particles that stay in place: a slab of thickness 1 and diffusivity 1 between plates at 1 and 0, which starts at 0
#: and repeats along the plates. Exact: the sine series, 0.11384 in the middle at time 0.05. The error is that of the
#: temperature there, by the cubic through the four nearest rows, at the time of the output. A lattice conducts 0.964 (h of 1.2
#: spacings) or 0.997 (1.5) of what it should, which no number of cells mends. With "solid" the slab is solid, and conducts by
#: the factor that makes its lattice exact. Cells are particles in the thickness; dtsc is a part of the stable step of conduction.
BEGIN {
    pi = 3.14159265358979323846
    if (what == "deck") print_deck(1 / cells)
}
function print_deck(h,    along) {
    along = 10
    sph_head("slab between plates", 3, (cells + 8) * along, "c0 1\nfroz on\nperi on\nwall 2 temp 1\nwall 3 temp 0\ntemp 1 0")
    printf "grid 0 %.17g -1 2 -1 1\nendt 0.05\noutt 0.05\ndtfx %.9g\ntecp\noutr cels\n", along * h, \
        dtsc * 0.125 * (has("h1.5") ? 2.25 : 1.44) * h * h
    print "mate\n1 flui 1 1e-3\nprop 1 capa 1 0 1\nprop 1 cond 1 0 1"
    if (has("solid")) print "prop 1 melt 8 9 0"
    printf "part bloc 1\n1 1 %.17g 0 0 0 %d %d 1\n", h, along, cells
    printf "part bloc 1\n1 1 %.17g 0 %.17g 0 %d 4 1\npart bloc 1\n1 1 %.17g 0 1 0 %d 4 1\nendi\n", h, -4 * h, along, h, along
}
function series(x, t,    k, sum) {
    for (k = 1; k < 200; k++) sum += 2 / (k * pi) * sin(k * pi * x) * exp(-k * k * pi * pi * t)
    return 1 - x - sum
}
# Rows of particles by their distance from the middle, in spacings: 1 and 3 halves on both sides.
what == "measure" && zones > 1 && NF > 3 {
    far = int(2 * absolute(value[n, "Y"] - 0.5) * cells + 0.5)
    if (far == 1 || far == 3) { sum[far] += value[n, "cels"]; count[far]++ }
}
END {
    if (what == "measure" && count[1] > 0) {
        middle = (9 * sum[1] / count[1] - sum[3] / count[3]) / 8
        printf "%.8g\n", absolute(middle / series(0.5, time) - 1)
    }
}
