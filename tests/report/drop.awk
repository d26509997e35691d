# SPDX-License-Identifier: GPL-3.0-or-later
#: A drop of radius 0.01 meets a frictionless wall at 1.2604, which is the fall of spec rkpm 11.4 G (decks/rkpm/drop_snni.mpm),
#: in a plane, by reproducing kernel particles (rkpm; a wall of springs, Lagrangian kernel) and by material points (a wall
#: of grid nodes, which holds it as well), side by side: neo-Hookean with one Maxwell element of modulus 5600, relaxation time
#: 0.02, Poisson's ratio 0.4, density 1000, gravity 9.81. Value: width over diameter 0.009456 after they meet, where it is largest.
#: Answer: 1.480 by an independent explicit finite element program (constant strain, 30 rings of elements), good to 1e-2.
#: Cells are spacings of nodes in the radius; of material points cells, with two points along each axis.
BEGIN {
    radius = 0.01; spacing = radius / cells / (has("rkpm") ? 1 : 2)
    if (what == "deck") has("rkpm") ? print_nodes() : print_points(2 * spacing)
}
function print_nodes() {
    rkpm_head("drop", sprintf("nmat 1\nendt 0.009456\noutt 0.009456\ndtfx %.3g\nmate\n1 fmax 1000 0 0.4 1 5600 0.02", 5e-5 / cells))
    printf "prob dynamic\nnode disc 0 %.17g %.17g %.17g\nsupp 2\nmode lagrangian\nstar 0 -1.2604\ngrav 0 -9.81\nwall spring y 0 1.25e7\n%s\nends\ntecp\nendi\n",
        radius, radius, spacing, words
}
function print_points(h,    b, i, j, points) {
    b = beyond(h)
    for (i = 0; i < 2 * cells; i++)
        for (j = 0; j < 2 * cells; j++)
            points += 4 * ((i + 0.5) ^ 2 + (j + 0.5) ^ 2 < 4 * cells * cells)
    head("drop", 2 * points)
    printf "grid %.17g %.17g %.17g %.17g %.17g %.17g\ndcell %.17g\nfixed 0 0 2 0 2 2\n", -2 * radius, 2 * radius, -b, 2.5 * radius, -b, h + b, h
    printf "%s\ndtscale %s\nendt 0.009456\ndigits 12\nbulk 0 0\ntecp\n", words, dtsc
    printf "mate\n1 fmax 1000 0 0.4 1 5600 0.02\npart cyli 1\n1 1000 %.17g z 0 %.17g 0 %.17g %.17g\n", spacing, radius, radius, h
    print "velo\nbody 1 0 -1.2604 0\nendv\nload\ngrav 1 0 -9.81 0\nendl\nendi"
}
END {
    if (what != "measure" || n == 0) exit
    low = high = value[1, "X"]
    for (i = 2; i <= n; i++) {
        if (value[i, "X"] < low) low = value[i, "X"]
        if (value[i, "X"] > high) high = value[i, "X"]
    }
    printf "%.8g\n", (high - low + spacing) / (2 * radius)
}
