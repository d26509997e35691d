# SPDX-License-Identifier: GPL-3.0-or-later
#: Reproducing kernel particles: div grad u = (x^2 + y^2) e^(x y) on a unit square with u = e^(x y) on its boundary (spec
#: rkpm 11.2 C), linear basis, support 1.75 spacings, 2 x 2 Gauss points per cell, by how the boundary is held: by
#: transformation of coefficients, Lagrange multipliers, a penalty of 1e5, Nitsche's method with 1e5 and with 100 over the
#: spacing. Exact: e^(x y) itself. The error is its L2 norm over that of the solution, 1.39 (by the midpoint rule). Cells are
#: those along an axis.
BEGIN { if (what == "deck") print_deck() }
function print_deck() {
    rkpm_head("e^(x y)", "")
    printf "node box 0 1 0 1 %d %d\nsupp 1.75\ngaus 2\nprob poisson\nfunc expo\n%s\nends\nendi\n", cells + 1, cells + 1, words
}
function norm(    i, j, n, sum) {
    n = 400
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++) sum += exp(2 * (i + 0.5) * (j + 0.5) / (n * n))
    return sqrt(sum) / n
}
END { if (what == "measure" && n > 0) printf "%.8g\n", value[n, "L2"] / norm() }
