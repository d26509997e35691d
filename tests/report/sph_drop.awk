# SPDX-License-Identifier: GPL-3.0-or-later
#: Smoothed particles: a disc of radius 1, density 1 and viscosity 1 with surface tension 10, in two dimensions; it starts without
#: pressure. Exact (Laplace): 10 inside. Value: mean pressure of particles within 0.5 of the middle, over times 1 to 2.
#: Cells are spacings in the radius; dtsc is cfl.
BEGIN { if (what == "deck") print_deck(1 / cells) }
function print_deck(h,    i, j, points) {
    for (i = 0; i < cells; i++)
        for (j = 0; j < cells; j++)
            points += 4 * ((i + 0.5) ^ 2 + (j + 0.5) ^ 2 < cells * cells)
    sph_head("drop at rest", 1, points, "c0 40\ncfl " dtsc)
    print "grid -2 2 -2 2 -1 1\nendt 2\noutt 0.1\ntecp\noutr pres\nmate\n1 flui 1 1\nprop 1 surf 1 300 10"
    printf "part cyli 1\n1 1 %.17g z 0 0 %.17g 1 %.17g\nendi\n", h, -h / 2, h
}
what == "measure" && zones > 1 && time >= 1 && NF > 3 && value[n, "X"] ^ 2 + value[n, "Y"] ^ 2 < 0.25 { sum += value[n, "pres"]; count++ }
END { if (what == "measure" && count > 0) printf "%.8g\n", sum / count }
