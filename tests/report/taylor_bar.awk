# SPDX-License-Identifier: GPL-3.0-or-later
#: A copper cylinder of radius 3.81 and length 25.4 mm strikes a rigid wall at 190 m/s, a quarter of it (the data of
#: decks/mpm3d/taylor_copper.mpm). Value: its length, mm, after 0.08 ms, when it has come to rest.
#: No closed form: the run with the most cells of the scheme musl is the answer.
BEGIN {
    s = 3.81 / cells / 2
    if (what == "deck") print_deck(2 * s)
}
function print_deck(h,    b, i, j, points) {
    b = beyond(h)
    for (i = 0; i < 2 * cells; i++) # points of a quarter of the section
        for (j = 0; j < 2 * cells; j++) points += (i + 0.5) ^ 2 + (j + 0.5) ^ 2 < 4 * cells * cells ? 1 : 0
    head("Taylor bar", points * int(25.4 / s + 0.5))
    printf "spx %.17g 10.16\nspy %.17g 10.16\nspz %.17g 26.67\ndcell %.17g\nfixed 2 0 2 0 2 0\n", -b, -b, -b, h
    printf "%s\ndtscale %s\nendt 0.08\ntecp\noutr disz\nmate\n", words, dtsc
    print "1 sjc 8.93e-3 117e3 0.35 90 292 0.31 0.025 1e-3\nseos 1 2 3940 1.49 1.96 0"
    printf "part soli 1\n1 8.93e-3 %.17g 0 0 0\nadd cyli z 0 0 3.81 0 25.4\nkeep box 0 4 0 4 0 26\nendp\nvelo\nbody 1 0 0 -190\nendv\nendi\n", s
}
END {
    if (what == "measure") {
        for (i = 1; i <= n; i++) longest = value[i, "Z"] > longest ? value[i, "Z"] : longest
        printf "%.8g\n", longest + s / 2
    }
}
