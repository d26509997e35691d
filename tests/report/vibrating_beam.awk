# SPDX-License-Identifier: GPL-3.0-or-later
#: A free elastic beam, ten times as long as high (10 x 1, Young's modulus and density 1, Poisson's ratio 0), in its first
#: bending mode over one period, with so small a deflection that no point crosses a cell.
#: Answer: the deflection W(x) sin(wt) of Timoshenko's theory with the shear coefficient 5/6; its frequency w, the root of its
#: equation, is 0.0625862, 3.1 % below that of Euler and Bernoulli. Plane finite elements (eight nodes, 4 in the height) give
#: 0.062587 and the same W within 6e-5.
#: The error is the root mean square over points and sixteen times, over that of the mode.
#: Cells are those in the height. (The word nuli gives this mode to one plate of 49152 points only.)
BEGIN {
    long = 10; amplitude = 1e-6; slender = 1 / 12 # radius of inertia of the section, squared
    soft = 2.4 # Young's modulus over the shear modulus and the shear coefficient: 1/(0.5 x 5/6)
    pi = 3.14159265358979323846
    solve()
    if (what == "deck") print_deck(1 / cells)
}
function cosh(x) { return (exp(x) + exp(-x)) / 2 }
function sinh(x) { return (exp(x) - exp(-x)) / 2 }
# The two wave numbers at frequency w: W is a cosh(rise x) + cos(wave x), and the section turns by a rise_turn sinh(rise x) -
# wave_turn sin(wave x), where shear takes the rest of the slope.
function numbers(w,    sum, root) {
    sum = w * w * (1 + soft) / 2
    root = sqrt(sum * sum - w * w * (soft * w * w - 1 / slender))
    rise = sqrt(root - sum); wave = sqrt(root + sum)
    rise_turn = rise + soft * w * w / rise; wave_turn = wave - soft * w * w / wave
}
# Zero where neither moment nor shear force acts on the ends.
function imbalance(w,    half) {
    half = long / 2
    numbers(w)
    return rise_turn * rise * cosh(rise * half) * (wave_turn - wave) * sin(wave * half) + \
        wave_turn * wave * cos(wave * half) * (rise - rise_turn) * sinh(rise * half)
}
# The least frequency by halving: between a half of that of Euler and Bernoulli and this itself.
function solve(    high, low, i) {
    high = 22.3733 * sqrt(slender) / (long * long); low = high / 2
    for (i = 0; i < 60; i++) {
        w = (low + high) / 2
        if (imbalance(w) * imbalance(high) > 0) high = w
        else low = w
    }
    numbers(w)
    part_rise = wave_turn * wave * cos(wave * long / 2) / (rise_turn * rise * cosh(rise * long / 2))
}
function deflection(x) { return part_rise * cosh(rise * x) + cos(wave * x) }
function turn(x) { return part_rise * rise_turn * sinh(rise * x) - wave_turn * sin(wave * x) }
function slope(x) { return part_rise * rise * sinh(rise * x) - wave * sin(wave * x) }
function print_deck(h,    b, id, x, y, speed) {
    b = beyond(h)
    head("beam in its first bending mode", 80 * cells * cells)
    printf "grid %.17g %.17g %.17g %.17g %.17g %.17g\ndcell %.17g\nfixed 0 0 0 0 2 2\n", -2 * h, long + 2 * h, -2 * h, 1 + 2 * h, -b, h + b, h
    printf "%s\ndtscale %s\nendt %.17g\noutt %.17g\nbulk 0 0\ndigits 12\ntecp\noutr disy\n", words, dtsc, 2 * pi / w, 2 * pi / w / 16
    printf "mate\n1 %s 1 1 0\npart bloc 1\n1 1 %.17g 0 0 0 %d %d 2\nvelo\n", has("tl") ? "neoh" : "elas", h / 2, 20 * cells, 2 * cells
    for (id = 0; id < 80 * cells * cells; id++) {
        x = (id % (20 * cells) + 0.5) * h / 2 - long / 2; y = (int(id / (20 * cells)) % (2 * cells) + 0.5) * h / 2 - 0.5
        speed = amplitude * w
        # sections bend as the parabola of shear stress over the height has it
        printf "node %d %.17g %.17g 0\n", id + 1,
            speed * (1.25 * (slope(x) - turn(x)) * (y - 4 * y * y * y / 3) - slope(x) * y), speed * deflection(x)
    }
    print "endv\nendi"
}
what == "measure" && zones > 1 && NF > 3 {
    x = (((n - 1) % (20 * cells) + 0.5) / (2 * cells)) - long / 2
    error = value[n, "disy"] / amplitude - deflection(x) * sin(w * time)
    sum += error * error
    all += deflection(x) ^ 2 / 2
}
END { if (what == "measure" && all > 0) printf "%.8g\n", sqrt(sum / all) }
