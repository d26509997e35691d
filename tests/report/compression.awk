# SPDX-License-Identifier: GPL-3.0-or-later
#: The partitioned cylinder of the thesis (5.3, coarse, decks/thesis/compression_coarse.mpm): a disc of radius 3.8, 3.8 mm
#: thick, whose opening of radius 2.28 is crossed by a web of 1.52 mm, made of cubes of 0.19 mm. Its top row is
#: pressed down with 100 N/mm^3 (109.744 N), its bottom row stands on a clamped floor. Half of it, the plane x = 0 being one
#: of symmetry, and a thousandth of the load, so that small strain is exact. Cells are those in the radius; cubes are cut
#: into points, or joined where a cell is coarser. Value: mean stress along y, MPa for the whole load, in the web at y = 0.
#: Answer: -15.14, where finite elements on the same cubes (eight nodes, edges of 0.19, 0.095, 0.0475 mm: -14.956 -15.060
#: -15.105) tend to; a round body with flats has -14.80, so that shape counts for more than this. The static limit of
#: linear shapes in 10 cells, by that other program, is -14.322.
#: With whole = 1 (a case of its own): the mean over the volume. In balance that is F (3.8 - 0.095 + 3.8)/V = -5.98007968, to
#: the strain of some 1e-7, with any cells that fit the cubes; the error says how well motion is damped, equilibrium solved.
BEGIN {
    cube = 0.19
    if (what == "deck") { fill(3.8 / cells); print_deck(3.8 / cells) }
}
# Whether the cube of column i and row j from the axis, i >= 0, belongs to the body.
function is_body(i, j,    a, b) {
    a = 2 * i + 1; b = 2 * j + 1
    return a * a + b * b < 1600 && !(25 * (a * a + b * b) < 14400 && 5 * a > 40)
}
# filled, pressed: the parts of a square of side s at (x, y) that are body, and loaded.
function look_at(x, y, s,    n, step, i, j, column, row) {
    n = s > cube ? int(s / cube + 0.5) : 1; step = s / n
    filled = pressed = 0
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++) {
            column = int((x + (i + 0.5) * step - s / 2) / cube); row = int((y + (j + 0.5) * step - s / 2) / cube + 20) - 20
            if (!is_body(column, row)) continue
            filled += 1 / (n * n)
            if (row == 19) pressed += 1 / (n * n)
        }
}
function fill(h,    s, i, j) {
    s = h / 2
    for (j = -2 * cells; j < 2 * cells; j++)
        for (i = 0; i < 2 * cells; i++) {
            look_at((i + 0.5) * s, (j + 0.5) * s, s)
            if (!filled) continue
            count++
            at_x[count] = (i + 0.5) * s; at_y[count] = (j + 0.5) * s; volume[count] = filled * s * s * s; force[count] = -0.1 * pressed * s * s * s
        }
}
function print_deck(h,    b, layers, k, i) {
    b = beyond(h); layers = 2 * cells
    head("partitioned cylinder", count * layers)
    printf "grid %.17g %.17g %.17g %.17g %.17g %.17g\ndcell %.17g\nfixed 2 0 1 0 0 0\n", -b, 3.8 + 2 * h, -3.8 - b, 3.8 + 2 * h, -2 * h, 3.8 + 2 * h, h
    printf "%s\ndtscale %s\nendt 0.03\ndigits 12\ntecp\noutr stsy\noutr volu\njaum off\n", words, dtsc
    if (has("damped")) print "Damp 1200"
    printf "mate\n1 elas 4.4705e-3 115000 0.34\npart poin 1 %d\n", count * layers
    for (k = 0; k < layers; k++)
        for (i = 1; i <= count; i++)
            printf "%d 1 %.10g %.17g %.17g %.17g\n", k * count + i, 4.4705e-3 * volume[i], at_x[i], at_y[i], (k + 0.5) * h / 2
    print "load"
    for (k = 0; k < layers; k++)
        for (i = 1; i <= count; i++)
            if (force[i]) printf "part %d 0 %.17g 0\n", k * count + i, force[i]
    print "endl\nendi"
}
END {
    if (what == "measure") {
        fill(3.8 / cells)
        for (i = 1; i <= n; i++) {
            own = (i - 1) % count + 1
            if (!whole && (at_x[own] > 0.76 || at_y[own] ^ 2 > (3.8 / cells) ^ 2)) continue
            sum += volume[own] * value[i, "stsy"]
            weight += volume[own]
        }
        printf "%.8g\n", 1000 * sum / weight
    }
}
