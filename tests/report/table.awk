# SPDX-License-Identifier: GPL-3.0-or-later
# Rows of runs.txt with their errors and orders: awk -f table.awk CASES RUNS. CASES has the answers in field 7, what
# they are good to in field 8. `order` is that between the run and the next coarser one of the same scheme and time step,
# `fit` that of the line through it and all coarser ones (least squares of the logarithms), so that the last row of
# a scheme has the order of its two finest runs and that of all. Failed runs and errors below what the answer is good to
# tell no order.
FNR == NR {
    split($0, field, "|")
    gsub(/ /, "", field[1])
    sub(/^ */, "", field[7]); sub(/ *$/, "", field[7])
    answer[field[1]] = field[7]
    good_to[field[1]] = field[8] + 0
    next
}
{ rows++; row[rows] = $0 }
# A self-reference: the last good run of that scheme, as resolutions rise, with its first time step.
answer[$1] == "self " $2 && $5 == 0 && !(($1, $3) in seen) { reference[$1] = $6; holder[$1] = $3; seen[$1, $3] = 1 }
function error_of(found, exact) { return exact == 0 ? "nan" : sprintf("%.4e", found > exact ? (found - exact) / (exact < 0 ? -exact : exact) : (exact - found) / (exact < 0 ? -exact : exact)) }

# Order and fit of the run with that many cells in series s (a case, scheme and time step), whose rows come in any order.
function orders_of(s, cells,    i, x, y, n, sum_x, sum_y, sum_xx, sum_xy, coarse, own) {
    for (i = 1; i <= runs[s]; i++) {
        if (at[s, i] > cells) continue
        x = log(at[s, i]); y = log(error_at[s, i])
        n++; sum_x += x; sum_y += y; sum_xx += x * x; sum_xy += x * y
        if (at[s, i] == cells) own = i
        else if (!coarse || at[s, i] > at[s, coarse]) coarse = i
    }
    if (!coarse) return "nan nan"
    return sprintf("%.3f %.3f", log(error_at[s, coarse] / error_at[s, own]) / log(cells / at[s, coarse]),
        (sum_x * sum_y - n * sum_xy) / (n * sum_xx - sum_x * sum_x))
}

END {
    print "case scheme cells dtsc error seconds particle_steps bytes status value answer order fit"
    for (r = 1; r <= rows; r++) {
        split(row[r], v, " ")
        kind = answer[v[1]]
        exact = kind
        if (kind == "error") exact = 0
        if (kind ~ /^self/) exact = v[1] in reference ? reference[v[1]] : "nan"
        # at the resolution of the answer itself there is nothing to compare with
        is_finest = kind ~ /^self/ && v[3] == holder[v[1]]
        if (v[6] == "nan" || exact == "nan" || is_finest) error = "nan"
        else error = kind == "error" ? sprintf("%.4e", v[6]) : error_of(v[6] + 0, exact + 0)
        dtsc = v[2] ~ /(^|\+)(quas|rkpm)(\+|$)/ ? "-" : v[4]
        line[r] = v[1] " " v[2] " " v[3] " " dtsc " " error " " v[7] " " v[8] " " v[9] " " v[5] " " v[6] " " exact
        series[r] = v[1] " " v[2] " " dtsc; cells[r] = v[3] + 0
        counts[r] = v[5] == 0 && error != "nan" && error + 0 > good_to[v[1]]
        if (!counts[r]) continue
        i = ++runs[series[r]]
        at[series[r], i] = cells[r]; error_at[series[r], i] = error + 0
    }
    for (r = 1; r <= rows; r++) print line[r], counts[r] ? orders_of(series[r], cells[r]) : "nan nan"
}
