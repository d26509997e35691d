# SPDX-License-Identifier: GPL-3.0-or-later
# Writes decks/thesis/overhang_arch.stl: awk -f tools/make_overhang_stl.awk >decks/thesis/overhang_arch.stl
# A part with overhangs, build direction z, in mm: an arch of 6 x 3 x 4 (opening: 4 wide, straight up to
# z = 1.5, then a half circle of radius 2 as n chords) under a table of 8 x 3 x 1, which juts out by 1 on
# both sides. Its volume is 3 (8 + 6 4 - 4 1.5 - n 2 sin(pi/n)) = 59.2042283 mm3 for n = 24.

# A triangle of the x z plane, counterclockwise.
function cap(x1, z1, x2, z2, x3, z3) { px[++count] = x1; pz[count] = z1; px[++count] = x2; pz[count] = z2; px[++count] = x3; pz[count] = z3 }
function quad(x1, z1, x2, z2, x3, z3, x4, z4) { cap(x1, z1, x2, z2, x3, z3); cap(x1, z1, x3, z3, x4, z4) }
function facet(x1, y1, z1, x2, y2, z2, x3, y3, z3,    nx, ny, nz, size) {
    nx = (y2 - y1) * (z3 - z1) - (z2 - z1) * (y3 - y1)
    ny = (z2 - z1) * (x3 - x1) - (x2 - x1) * (z3 - z1)
    nz = (x2 - x1) * (y3 - y1) - (y2 - y1) * (x3 - x1)
    size = sqrt(nx * nx + ny * ny + nz * nz)
    printf "facet normal %.6g %.6g %.6g\nouter loop\n", nx / size, ny / size, nz / size
    printf "vertex %.9g %.9g %.9g\nvertex %.9g %.9g %.9g\nvertex %.9g %.9g %.9g\nendloop\nendfacet\n", x1, y1, z1, x2, y2, z2, x3, y3, z3
}
function key(x, z) { return sprintf("%.9g %.9g", x, z) }
# The walls stand on the edges that only one triangle of the cap has.
function wall(i, j) {
    if ((key(px[j], pz[j]) "," key(px[i], pz[i])) in edge) return
    facet(px[j], 0, pz[j], px[i], 0, pz[i], px[j], depth, pz[j])
    facet(px[i], 0, pz[i], px[i], depth, pz[i], px[j], depth, pz[j])
}
BEGIN {
    pi = atan2(0, -1); n = 24; depth = 3; base = 4; top = 5; spring = 1.5; radius = 2
    strips = 0; x[0] = -4; x[1] = -3
    for (i = 0; i <= n; i++) { x[2 + i] = i == 0 ? -radius : i == n ? radius : -radius * cos(pi * i / n)
                               arch[2 + i] = i == 0 || i == n ? spring : spring + radius * sin(pi * i / n) }
    x[n + 3] = 3; x[n + 4] = 4; strips = n + 4
    for (i = 0; i < strips; i++) {
        quad(x[i], base, x[i + 1], base, x[i + 1], top, x[i], top)
        if (i >= 2 && i < n + 2) quad(x[i], arch[i], x[i + 1], arch[i + 1], x[i + 1], base, x[i], base)
    }
    # legs: their inner side has the point where the arch begins
    cap(-3, base, -3, 0, -2, 0); cap(-3, base, -2, 0, -2, spring); cap(-3, base, -2, spring, -2, base)
    cap(3, base, 2, 0, 3, 0); cap(3, base, 2, spring, 2, 0); cap(3, base, 2, base, 2, spring)
    for (i = 1; i <= count; i++) { j = i % 3 ? i + 1 : i - 2; edge[key(px[i], pz[i]) "," key(px[j], pz[j])] = 1 }
    print "solid overhang_arch"
    for (i = 1; i <= count; i += 3) { # x z counterclockwise looks towards y-
        facet(px[i], 0, pz[i], px[i + 1], 0, pz[i + 1], px[i + 2], 0, pz[i + 2])
        facet(px[i], depth, pz[i], px[i + 2], depth, pz[i + 2], px[i + 1], depth, pz[i + 1])
    }
    for (i = 1; i <= count; i++) wall(i, i % 3 ? i + 1 : i - 2)
    print "endsolid overhang_arch"
}
