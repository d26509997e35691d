# SPDX-License-Identifier: GPL-3.0-or-later
# Rows of runs.txt with their errors: awk -f table.awk CASES RUNS. The answers are in field 7 of CASES.
FNR == NR {
    split($0, field, "|")
    gsub(/ /, "", field[1])
    sub(/^ */, "", field[7]); sub(/ *$/, "", field[7])
    answer[field[1]] = field[7]
    next
}
{ rows++; row[rows] = $0 }
# A self-reference: the last good run of that scheme, as resolutions rise, with its first time step.
answer[$1] == "self " $2 && $5 == 0 && !(($1, $3) in seen) { reference[$1] = $6; holder[$1] = $3; seen[$1, $3] = 1 }
function error_of(found, exact) { return exact == 0 ? "nan" : sprintf("%.4e", found > exact ? (found - exact) / (exact < 0 ? -exact : exact) : (exact - found) / (exact < 0 ? -exact : exact)) }
END {
    print "case scheme cells dtsc error seconds particle_steps bytes status value answer"
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
        print v[1], v[2], v[3], v[2] ~ /(^|\+)quas(\+|$)/ ? "-" : v[4], error, v[7], v[8], v[9], v[5], v[6], exact
    }
}
