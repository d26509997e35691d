# SPDX-License-Identifier: GPL-3.0-or-later
#: A block of 4 x 4 x 2 mm with the residual stress of a scan along x, -5 along and -2 MPa across (thesis chapter 6, a
#: hundredth of the stress, so that small strain is exact), opened at once.
#: Free: strain along x is that of Hooke's law, (-5 + 0.34 x 2)/115000 = -3.7565217e-5, in any shape. With its bottom
#: held there is no closed form: the finest static run is the answer.
BEGIN {
    if (what != "deck") exit
    h = 4 / cells
    head("residual stress", 4 * cells * cells * cells)
    printf "grid %.17g %.17g %.17g %.17g %.17g %.17g\ndcell %.17g\n", -h, 4 + h, -h, 4 + h, -h, 2 + h, h
    printf "%s\ndtscale %s\nendt 0.02\ndigits 12\ntecp\noutr disx\n", words, dtsc
    if (has("damped")) print "Damp 3000"
    printf "mate\n1 elas 4.4705e-3 115e3 0.34\npart bloc 1\n1 4.4705e-3 %.17g 0 0 0 %d %d %d\n", h / 2, 2 * cells, 2 * cells, cells
    print "jaum off\nresi 1 -5 -2 0\nscan 0"
    if (fixed) printf "fixn -9 9 -9 9 %.17g 0 1 1 1\n", -h
    print "endi"
}
