# SPDX-License-Identifier: GPL-3.0-or-later
#: A slab of TNT of 100 mm, lit at a wall (programmed burn, JWL gas), one row of points.
#: Exact: behind the front of Chapman and Jouguet the isentrope goes down to 5639.364 MPa, where the gas rests (Taylor's
#: wave of these data, head of decks/mpm3d/tnt_slab.mpm). Value: mean pressure over x = 10 ... 45 mm.
BEGIN {
    if (what != "deck") exit
    h = 100 / cells; b = beyond(h)
    head("detonation of TNT", 2 * cells)
    printf "spx %.17g %.17g\nspy %.17g %.17g\nspz %.17g %.17g\ndcell %.17g\nfixed 2 0 2 2 2 2\n", -b, 100 + 10 * h, -b, h + b, -b, h + b, h
    printf "%s\ndtscale %s\nendt 0.014\ntecp\noutr pres\n", words, dtsc
    print "material\n1 hiex 1.63e-3 6930\nseos 1 3 3.712e5 3.21e3 4.15 0.95 0.3 6993"
    printf "deto 0 %.17g %.17g\nparticle block 1\n1 1.63e-3 %.17g 0 %.17g %.17g %d 1 1\nendi\n", h / 2, h / 2, h / 2, h / 4, h / 4, 2 * cells
}
