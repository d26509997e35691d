# SPDX-License-Identifier: GPL-3.0-or-later
#: Reproducing kernel particles: Timoshenko's cantilever (4 x 1, Young's modulus 3e7, Poisson's ratio 0.3, plane stress; spec
#: rkpm 11.2 E) under a parabolic shear load of 1000 at its end, held at the other end as the exact solution has it, linear
#: basis (quad: quadratic), by rule of integration. Exact: Timoshenko's solution. The error is that of strains in the norm of
#: their energy, over the energy; it counts the whole field, and not the tip only, whose error may vanish by chance. Cells
#: are those in the height.
BEGIN { if (what == "deck") print_deck() }
function print_deck() {
    rkpm_head("Timoshenko's cantilever", "")
    printf "node box 0 4 -0.5 0.5 %d %d\nsupp %s\ngnor 4\nprob elastic\nfunc beam\nmodu 3e7 0.3\nforc -1000\nheld x0\n%s\nends\nendi\n",
        4 * cells + 1, cells + 1, has("quad") ? 2.5 : 1.75, words
}
END { if (what == "measure" && n > 0) printf "%.8g\n", value[n, "energy"] }
