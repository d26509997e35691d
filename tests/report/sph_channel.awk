# SPDX-License-Identifier: GPL-3.0-or-later
#: Smoothed particles: water (kinematic viscosity 1e-6) at rest between plates 1 mm apart, in a channel that repeats along x.
#: Driven by an acceleration of 1e-3 (Poiseuille; the largest speed becomes 1.25e-4), after 1 s; with plate=1 by the upper
#: plate at speed 1e-4 (Couette), after 0.1 s, while the profile is curved. Exact: the series of both. The error is the root
#: mean square of the velocity over the particles, over the largest speed there is. With more cells it comes to the error of
#: the viscous force on a lattice, which is 0.964 (Morris) and 0.756 (Monaghan and Gingold) of what it should be at h of 1.2
#: spacings, 0.997 and 0.886 at 1.5. Cells are particles across; dtsc is cfl.
BEGIN {
    pi = 3.14159265358979323846; height = 1e-3; viscosity = 1e-6
    gravity = plate ? 0 : 1e-3; speed = plate ? 1e-4 : 0; largest = plate ? speed : gravity * height ^ 2 / (8 * viscosity)
    if (what == "deck") print_deck(height / cells)
}
function print_deck(h,    along, t) {
    along = 10; t = plate ? 0.1 : 1
    sph_head("channel", 3, (cells + 8) * along, "c0 " 10 * largest "\ncfl " dtsc "\nperi on\nwall 2\nwall 3 velo " speed " 0 0")
    printf "grid 0 %.17g -1 1 -1 1\nendt %g\noutt %g\ntecp\noutr velx\nmate\n1 flui 1000 1e-3\n", along * h, t, t
    printf "part bloc 1\n1 1000 %.17g 0 0 0 %d %d 1\n", h, along, cells
    printf "part bloc 1\n1 1000 %.17g 0 %.17g 0 %d 4 1\npart bloc 1\n1 1000 %.17g 0 %.17g 0 %d 4 1\n", h, -4 * h, along, h, height, along
    printf "load\ngrav 1 %g 0 0\nendl\nendi\n", gravity
}
function exact(y, t,    k, w, sum) {
    for (k = 1; k < 100; k++) {
        w = k * pi / height
        sum += plate ? (k % 2 ? -1 : 1) * 2 * speed / (k * pi) * sin(w * y) * exp(-viscosity * w * w * t) : \
            (k % 2 ? -4 * gravity / (viscosity * w * w * w * height) * sin(w * y) * exp(-viscosity * w * w * t) : 0)
    }
    return (plate ? speed * y / height : gravity * y * (height - y) / (2 * viscosity)) + sum
}
# Velocities are half a step behind.
what == "measure" && zones > 1 && NF > 3 && value[n, "Y"] > 0 && value[n, "Y"] < height {
    sum += (value[n, "velx"] - exact(value[n, "Y"], time - step / 2)) ^ 2
    count++
}
END { if (what == "measure" && count > 0) printf "%.8g\n", sqrt(sum / count) / largest }
