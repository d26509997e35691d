# SPDX-License-Identifier: GPL-3.0-or-later
#: A cantilever (4 x 1, plane stress) clamped at one end, under a shear traction at the other, by reproducing kernel
#: particles (rkpm) and by material points, side by side: Young's modulus 5e5, Poisson's ratio 0.3. With creep=1 it is a
#: generalised Maxwell body of moduli 1e5 at long times and 5e5 at once, relaxation time 0.2, whose pressure relaxes as
#: well, after t = 2. Material points are in plane strain with the moduli that are plane stress then, E (1 + 2 nu)/(1 +
#: nu)^2 and nu/(1 + nu), which holds in creep too, as all moduli relax alike. At rest their equilibrium is found directly
#: (quas), or they move and are damped; in creep they move, damped, and so light that their bending lasts a hundredth of
#: the retardation. Value: displacement of the middle of the end, over that of a beam of Euler and Bernoulli at once.
#: Answer: 1.0432 at rest, where both methods tend to with 4, 8 and 16 cells (quadratic functions of rkpm 1.04076 1.04241
#: 1.04294, quas 1.03115 1.03968 1.04216); in creep times (5 - 4 exp(-2)), 4.6513. Cells are those in the height.
BEGIN {
    long = 4; load = 1e-3 # so small that it does not matter that strains of material points are finite
    at_once = 4 * load * long ^ 3 / 5e5
    if (what == "deck") has("rkpm") ? print_nodes() : print_points(1 / cells)
}
function print_nodes() {
    rkpm_head("cantilever", "")
    printf "node box 0 %d -0.5 0.5 %d %d\nsupp %s\nprob creep\nfunc load\nforc %.17g\nmodu 1e5 0.3\nelem 4e5 0.2\nvrel on\n", long,
        long * cells + 1, cells + 1, has("quad") ? 2.5 : 1.75, load
    printf "span 2 %.17g\nfrom 0 1\nheld x0\ncons tran\n%s\nends\nendi\n", creep ? 0.04 / cells : 2, words
}
function print_points(h,    b, to_plane, density, slow) {
    b = beyond(h); to_plane = 1.6 / 1.69
    density = creep ? 0.16 : 1
    slow = 3.516 * sqrt((creep ? 1e5 : 5e5) / (12 * density)) / long ^ 2 # of the first bending
    head("cantilever", 32 * cells * cells)
    printf "grid %.17g %.17g %.17g %.17g %.17g %.17g\ndcell %.17g\nfixed 1 0 0 0 2 2\n", -b, long + 2 * h, -0.5 - 3 * h, 0.5 + 3 * h, -b, h + b, h
    printf "%s\ndtscale %s\nendt %g\ndigits 12\ntecp\noutr disy\n", words, dtsc, creep ? 2 : 0.4
    if (has("damped")) printf "Damp %.4g\n", 2 * slow
    if (creep) printf "mate\n1 maxw %.17g %.17g %.17g 1 %.17g 0.2 volume\n", density, 1e5 * to_plane, 0.3 / 1.3, 4e5 * to_plane
    else printf "mate\n1 elas %.17g %.17g %.17g\n", density, 5e5 * to_plane, 0.3 / 1.3
    printf "part bloc 1\n1 %.17g %.17g 0 -0.5 0 %d %d 2\nload\nface x+ 1 0 %.17g 0\nendl\nendi\n", density, h / 2, 8 * cells, 2 * cells, load
}
# The two rows of points beside the middle, extrapolated from the two last columns; of nodes the step of no length, or the last.
END {
    if (what != "measure" || n == 0) exit
    if (has("rkpm")) { printf "%.8g\n", value[creep ? n : 1, "tip"] / at_once; exit }
    across = 2 * cells; along = 8 * cells
    for (j = cells - 1; j <= cells; j++) {
        last = j * along + along
        tip += (1.5 * value[last, "disy"] - 0.5 * value[last - 1, "disy"]) / 2
    }
    printf "%.8g\n", tip / at_once
}
