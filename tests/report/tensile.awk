# SPDX-License-Identifier: GPL-3.0-or-later
#: A bar of 15 x 5 x 5 mm pulled by 0.025 MPa over its end, with symmetry planes at the other faces (thesis 5.2 with
#: a thousandth of the load, so that small strain is exact). The load is a volume force on the last layer of points,
#: or, with "face", a traction on the surface.
#: Exact: strain sigma/E = 0.025/120000 = 2.0833333e-7 between the outermost points.
BEGIN {
    if (what != "deck") exit
    h = 5 / cells; b = beyond(h)
    head("tensile test", 24 * cells * cells * cells)
    printf "spx %.17g %.17g\nspy %.17g %.17g\nspz %.17g %.17g\ndcell %.17g\nfixed 2 0 2 0 2 0\n", -b, 15 + 2 * h, -b, 5 + 2 * h, -b, 5 + 2 * h, h
    printf "%s\ndtscale %s\nendt 0.1\ndigits 12\ntecp\noutr disx\n", words, dtsc
    if (has("damped")) print "Damp 800"
    printf "mate\n1 elas 8.96e-3 120e3 0.33\npart bloc 1\n1 8.96e-3 %.17g 0 0 0 %d %d %d\nload\n", h / 2, 6 * cells, 2 * cells, 2 * cells
    if (has("face")) print "face x+ 1 0.025 0 0"
    else printf "box %.17g 15 0 5 0 5 %.17g 0 0\n", 15 - h / 2, 0.05 / h
    print "endl\nendi"
}
