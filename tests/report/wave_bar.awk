# SPDX-License-Identifier: GPL-3.0-or-later
#: An elastic bar of length 1 with free ends in its first standing mode over one period.
#: Exact (wave equation, small amplitude): v = v0 cos(pi x) cos(pi t), with Young's modulus and density 1.
#: The error is the root mean square of the velocity over points and sixteen times, over that of the mode.
#: Velocities leapfrog: they are compared half a step earlier (usf: later) than the time of the output.
#: With travel > 0 (a case of its own) the bar moves by that part of its length in the period, and points cross cells;
#: the amplitude is larger there, as a node below the mass cutoff takes some 1e-6 of the speed of travel from its points.
BEGIN {
    pi = 3.14159265358979323846; speed = travel / 2
    if (what == "deck") print_deck(1 / cells)
}
function print_deck(h,    id, b) {
    b = beyond(h)
    head("bar in its first mode", 8 * cells)
    printf "grid -1 2 %.17g %.17g %.17g %.17g\ndcell %.17g\nfixed 0 0 2 2 2 2\n", -b, h + b, -b, h + b, h
    printf "%s\ndtscale %s\nendt 2\noutt 0.125\nbulk 0 0\ndigits 12\ntecp\noutr velx\n", words, dtsc
    printf "mate\n1 %s 1 1 0\npart bloc 1\n1 1 %.17g 0 0 0 %d 2 2\nvelo\n", has("tl") ? "neoh" : "elas", h / 2, 2 * cells
    for (id = 0; id < 8 * cells; id++)
        printf "node %d %.17g 0 0\n", id + 1, speed + amplitude * cos(pi * (id % (2 * cells) + 0.5) * h / 2)
    print "endv\nendi"
}
what == "measure" && zones > 1 && NF > 3 {
    x = ((n - 1) % (2 * cells) + 0.5) / (2 * cells)
    at = time + (has("usf") ? 0.5 : -0.5) * step
    error = value[n, "velx"] - speed - amplitude * cos(pi * x) * cos(pi * at)
    sum += error * error
    count++
}
END { if (what == "measure" && count > 0) printf "%.8g\n", sqrt(sum / count) / (amplitude / 2) }
