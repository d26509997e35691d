# SPDX-License-Identifier: GPL-3.0-or-later
# The page of the report from its table: awk -f page.awk CASES TABLE. Charts are the files CASE-time.svg and CASE-order.svg
# of the folder; what a case is stands in the lines "#:" of its program.
FNR == NR {
    split($0, field, "|")
    gsub(/ /, "", field[1])
    split(field[2], part, " ")
    program[field[1]] = part[1]
    answers[field[1]] = field[7]
    good_to[field[1]] = field[8] + 0
    n_words = split(field[9], part, " ")
    for (i = 1; i < n_words; i += 2) asked[field[1], part[i]] = part[i + 1]
    next
}
FNR == 1 { next }
{
    rows++
    name[rows] = $1; scheme[rows] = $2; cells[rows] = $3; dtsc[rows] = $4; error[rows] = $5; seconds[rows] = $6
    steps[rows] = $7; bytes[rows] = $8; status[rows] = $9; value[rows] = $10; exact[rows] = $11
    order_at[rows] = $12 == "nan" ? "" : sprintf("%.2f", $12); fit[rows] = sprintf("%.2f", $13)
    order_exactly[rows] = $12; fit_exactly[rows] = $13
    if (!($1 in from)) { from[$1] = rows; order[++cases] = $1 }
    to[$1] = rows
}

function escape(text) { gsub(/&/, "\\&amp;", text); gsub(/</, "\\&lt;", text); gsub(/>/, "\\&gt;", text); return text }

# Whether row r has an error, and that error; one below what the answer is good to counts as that.
function has_error(r) { return error[r] != "nan" && error_in(r) > 0 }
function error_in(r) { return error[r] + 0 < good_to[name[r]] ? good_to[name[r]] : error[r] + 0 }

# Marks the rows that no row of the case beats in both error and seconds.
function mark_front(c,    r, q) {
    for (r = from[c]; r <= to[c]; r++) {
        on_front[r] = has_error(r)
        for (q = from[c]; on_front[r] && q <= to[c]; q++)
            if (has_error(q) && error_in(q) <= error_in(r) && seconds[q] + 0 <= seconds[r] + 0 &&
                (error_in(q) < error_in(r) || seconds[q] + 0 < seconds[r] + 0)) on_front[r] = 0
    }
}

function print_description(c,    line, path) {
    path = here "/" program[c] ".awk"
    printf "<p>"
    while ((getline line <path) > 0)
        if (line ~ /^#:/) print escape(substr(line, 4))
    close(path)
    print "</p>"
    if (good_to[c] > 0) print "<p>The answer is good to " good_to[c] "; smaller errors count as that here and in the charts.</p>"
}

function print_chart(c, which, text,    path, line, is_there) {
    path = c "-" which ".svg"
    is_there = (getline line <(folder "/" path)) > 0
    close(folder "/" path)
    if (is_there) print "<figure><img src=\"" path "\" alt=\"" c ": error " text "\"></figure>"
    else print "<p>No run has an error to draw " text ".</p>"
}

function run_name(r) { return "<b>" scheme[r] "</b> with " cells[r] " cells" (dtsc[r] == "-" ? "" : " at dtsc " dtsc[r]) }

# The next row of the front in seconds behind the row `last` (0: the first); 0: none.
function next_on_front(c, last,    r, best) {
    for (r = from[c]; r <= to[c]; r++)
        if (on_front[r] && r != last && !(r in told) && (!best || seconds[r] + 0 < seconds[best] + 0)) best = r
    return best
}

# What is asked of the orders of a scheme's finest run r: nothing, or that with the word met or missed. Both count: an
# error that jumps about has a high order now and then.
function judged(r, c,    least) {
    if (!((c, scheme[r]) in asked)) return ""
    least = asked[c, scheme[r]] + 0
    return "at least " least ": " (order_exactly[r] + 0 >= least && fit_exactly[r] + 0 >= least ? "met" : "<b class=bad>missed</b>")
}

# The orders of each scheme at the first time step: between its two finest runs with an error above that of the answer,
# and of the line through all of them.
function print_orders(c,    r, finest, count) {
    split("", finest)
    for (r = from[c]; r <= to[c]; r++)
        if ((dtsc[r] == dtsc[from[c]] || dtsc[r] == "-") && order_at[r] != "" &&
            (!(scheme[r] in finest) || cells[r] + 0 > cells[finest[scheme[r]]] + 0)) { finest[scheme[r]] = r; count++ }
    if (!count) return
    print "<p>Order of convergence in cells" (dtsc[from[c]] == "-" ? "" : " at dtsc " dtsc[from[c]]) ":</p>"
    print "<table><tr><th>scheme<th>up to cells<th>of the two finest runs<th>of all, least squares<th>asked of both</tr>"
    for (r = from[c]; r <= to[c]; r++)
        if (finest[scheme[r]] == r)
            print "<tr><td>" scheme[r] "<td>" cells[r] "<td>" order_at[r] "<td>" fit[r] "<td>" judged(r, c) "</tr>"
    print "</table>"
}

function error_said(r) { return error[r] + 0 < good_to[name[r]] ? "below the " good_to[name[r]] " that the answer is good to" : error[r] + 0 }

# The scheme that has the least error over most of the time between the quickest and the slowest run (in its logarithm).
function print_worth(c,    r, last, slowest, span, whole, own, best, least) {
    split("", told); split("", own)
    for (r = from[c]; r <= to[c]; r++) {
        if (!has_error(r)) continue
        if (seconds[r] + 0 > slowest) slowest = seconds[r] + 0
        if (!least || error_in(r) < error_in(least) || (error_in(r) == error_in(least) && seconds[r] + 0 < seconds[least] + 0)) least = r
    }
    if (!least) { print "<p>No run has an error, so no scheme is worth it here.</p>"; return }
    while ((r = next_on_front(c, last)) > 0) {
        if (last) own[scheme[last]] += log(seconds[r] / seconds[last])
        else first_seconds = seconds[r] + 0
        told[r] = 1; last = r
    }
    own[scheme[last]] += log(slowest / seconds[last])
    whole = log(slowest / first_seconds)
    for (r = from[c]; r <= to[c]; r++)
        if (scheme[r] in own && (best == "" || own[scheme[r]] > own[best])) best = scheme[r]
    printf "<p class=worth><b>Worth it: %s</b>, which has the least error over %.0f %% of the times from %s to %s s (in their logarithm)", \
        best, (whole > 0 ? 100 * own[best] / whole : 100), first_seconds, slowest
    if (scheme[least] == best) printf ", and the least of all, %s, in %s s.</p>\n", error_said(least), seconds[least]
    else printf "; the least of all, %s, is that of %s in %s s.</p>\n", error_said(least), scheme[least], seconds[least]
}

# The front in words; what the schemes beside it miss.
function print_verdict(c,    r, q, last, text, count, best) {
    split("", told); split("", winner); split("", others)
    while ((r = next_on_front(c, last)) > 0) {
        text = text (last ? "; " : "") "from " seconds[r] " s on " run_name(r) " (error " error[r] ")"
        winner[scheme[r]] = 1; told[r] = 1; last = r; count++
    }
    print count ? "<p>Least error for the time spent: " text ".</p>" : "<p>No run has an error: nothing can be said.</p>"
    print_orders(c)
    text = ""
    for (r = from[c]; r <= to[c]; r++)
        if (has_error(r) && !(scheme[r] in winner) && !(scheme[r] in others)) {
            others[scheme[r]] = 1
            best = r
            for (q = from[c]; q <= to[c]; q++)
                if (has_error(q) && scheme[q] == scheme[r] && error_in(q) < error_in(best)) best = q
            text = text (text ? ", " : "") scheme[r] " (best " error[best] ", " sprintf("%.3g", error_in(best) / error_in(last)) " times the least)"
        }
    if (text) print "<p>Never on the front: " text ".</p>"
    print_spoilt(c)
}

# Runs without an end, and schemes whose error grows with resolution.
function print_spoilt(c,    r, text, grows) {
    for (r = from[c]; r <= to[c]; r++) {
        if (status[r] != 0) text = text (text ? ", " : "") run_name(r) " (status " status[r] ")"
        if (order_at[r] != "" && order_exactly[r] + 0 < 0) grows = grows (grows ? ", " : "") run_name(r)
    }
    if (text) print "<p class=bad>Runs that failed: " text ".</p>"
    if (grows) print "<p class=bad>No convergence, the error is larger than with fewer cells: " grows ".</p>"
}

function print_rows(c,    r) {
    print "<details><summary>All " to[c] - from[c] + 1 " runs</summary><table><tr><th>scheme<th>cells<th>dtsc<th>error" \
        "<th>order<th>fit<th>seconds<th>particle-steps<th>memory, bytes<th>status<th>value<th>answer</tr>"
    for (r = from[c]; r <= to[c]; r++)
        print "<tr" (on_front[r] ? " class=front" : status[r] != 0 ? " class=bad" : "") "><td>" scheme[r] "<td>" cells[r] "<td>" \
            dtsc[r] "<td>" error[r] "<td>" order_at[r] "<td>" (order_at[r] == "" ? "" : fit[r]) "<td>" seconds[r] "<td>" steps[r] "<td>" bytes[r] "<td>" status[r] \
            "<td>" value[r] "<td>" (answers[c] ~ /error/ ? "" : exact[r]) "</tr>"
    print "</table></details>"
}

END {
    print "<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Accuracy of " version "</title><style>"
    print "body{font:16px/1.45 sans-serif;max-width:960px;margin:2em auto;padding:0 1em;color:#222}"
    print "table{border-collapse:collapse;font-size:13px}td,th{border:1px solid #ccc;padding:2px 7px;text-align:right}"
    print "td:first-child,th:first-child{text-align:left}.front{background:#e3f1e3;font-weight:bold}.bad{color:#a11}.worth{border-left:4px solid #4a4;padding-left:.6em}"
    print "figure{margin:1em 0}img{max-width:100%}summary{cursor:pointer}</style>"
    print "<h1>Accuracy and cost</h1>"
    printf "<p>%s on %s: %d runs of size <i>%s</i> in %d s, one after another on one thread. ", version, machine, rows, size, seconds_all
    print "Errors are relative to the answer that stands with each case. Run time is the whole run with reading and output, in"
    print "steps of a millisecond (less counts as one), the least of three where it is below 0.1 s; memory is that of particles and grid; a particle-step is one step of one"
    print "particle, for the static method (quas) one application of the stiffness to it, of reproducing kernel particles a step or a"
    print "problem of one node; their memory is that of nodes and the matrix. The front of Pareto joins the runs that no"
    print "other run of the case beats in both error and time (bold in the tables). The same numbers stand in"
    print "<a href=table.txt>table.txt</a>. An order there is that from the next coarser run to this one, a fit that of the line through this"
    print "and all coarser ones.</p><ul>"
    for (i = 1; i <= cases; i++) print "<li><a href=#" order[i] ">" order[i] "</a>"
    print "</ul>"
    for (i = 1; i <= cases; i++) {
        c = order[i]
        mark_front(c)
        print "<h2 id=" c ">" c "</h2>"
        print_description(c)
        print_verdict(c)
        print_chart(c, "time", "against time")
        print_chart(c, "order", "against resolution")
        print_rows(c)
        print_worth(c)
    }
    print "</html>"
}
