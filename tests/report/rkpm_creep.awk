# SPDX-License-Identifier: GPL-3.0-or-later
#: Reproducing kernel particles: creep of a cantilever (20 x 1, plane stress; spec rkpm 11.3 M8, decks/rkpm/creep_beam.mpm)
#: under a load of 1 at its end: a generalised Maxwell body of Young's moduli 1e5 at long times and 5e5 at once, relaxation
#: time 1, whose pressure relaxes as well. Value: sinking of the tip at t = 10. Exact for a beam of Euler and Bernoulli:
#: 4 L^3/(E h^3) (1 - 0.8 exp(-t/5)) with E = 1e5, 0.28535417. A plane body sinks by shear too, 0.2 % more, and less as
#: its clamp holds it across, so that it is good to 1e-3. Nodal rules (nsci, nsni) and Gauss points, bases; with more cells
#: steps are shorter in proportion, 0.1 with two cells in the height. Cells are those in the height.
BEGIN { if (what == "deck") print_deck() }
function print_deck() {
    rkpm_head("creep of a cantilever", "")
    printf "node box 0 20 -0.5 0.5 %d %d\nsupp %s\nprob creep\nfunc load\nforc 1\nmodu 1e5 0.3\nelem 4e5 1\nvrel on\n", 20 * cells + 1, cells + 1,
        has("quad") ? 2.5 : 1.75
    printf "span 10 %.17g\nfrom 0 1\nheld x0\ncons tran\n%s\nends\nendi\n", 0.2 / cells, words
}
END { if (what == "measure" && n > 0) printf "%.8g\n", value[n, "tip"] }
