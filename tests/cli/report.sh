#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The smallest form of `make report`: table, page and charts are complete, orders of convergence are those of the
# method. sh tests/cli/report.sh BUILD
build=$(cd "$1" && pwd) || exit 2
root=$(cd "$(dirname "$0")/../.." && pwd) || exit 2
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
failures=0
check() {
    name=$1; shift
    if "$@" >"$folder/printed" 2>&1; then echo "ok $name"; else echo "FAIL $name"; sed 's/^/    /' "$folder/printed" | head -n 20; failures=1; fi
}
# order SCHEME LEAST: from 8 to 16 cells of the bar before points cross cells (acceptance of the study: 0.9 and 1.5)
order() {
    check "$1: order at least $2" awk -v scheme="$1" -v least="$2" '$1 == "wave_bar" && $2 == scheme { error[$3] = $5 }
        END { order = error[16] > 0 ? log(error[8] / error[16]) / log(2) : 0; print "order " order; exit order < least }' "$folder/report/table.txt"
}

check "the smallest report" sh "$root/tests/report/report.sh" "$build" "$folder/report" smoke
check "a row for each run, all finished" awk 'NR > 1 && ($9 != 0 || $6 + 0 <= 0 || $7 + 0 <= 0 || $8 + 0 <= 0) { print; bad = 1 }
    END { exit bad || NR < 49 }' "$folder/report/table.txt"
check "errors of all runs" awk 'NR > 1 && !($5 + 0 > 0) { print; bad = 1 } END { exit bad }' "$folder/report/table.txt"
# A beam of reproducing kernel particles and of material points: both come nearer to one answer (order 1.5 and more, between 2 and 4 cells).
for scheme in rkpm+gauss rkpm+nsci rkpm+gauss+quad usl+damped quas; do
    check "cantilever by $scheme: error and order" awk -v scheme="$scheme" '$1 == "cantilever" && $2 == scheme && $3 == 4 { print; good = $5 < 0.02 && $12 > 1.5 }
        END { exit !good }' "$folder/report/table.txt"
done
check "reproducing kernel particles have no dtsc" awk '$1 ~ /^rkpm_/ || $2 ~ /^rkpm/ { n++; if ($4 != "-") bad = 1 } END { exit bad || n < 10 }' "$folder/report/table.txt"
for scheme in usf usl musl musl+gimp; do order $scheme 0.9; done
order musl+bimp 1.5
check "the bar: the orders asked are met, with eight schemes" awk '/<h2 id=wave_bar>/ { here = 1 } /<h2 id=tensile>/ { here = 0 }
    here && /at least .*: met/ { met++ } here && /missed/ { bad = 1 } END { exit bad || met != 8 }' "$folder/report/index.html"
check "bending beam: error falls by at least 3.5 from 2 to 4 cells" awk '$1 == "vibrating_beam" && $2 ~ /^(usf|usl|musl|musl\+bimp)$/ {
    error[$2, $3] = $5; names[$2] = 1 } END { for (n in names) { k++; ratio = error[n, 4] > 0 ? error[n, 2] / error[n, 4] : 0
    if (ratio < 3.5) { print n, ratio; bad = 1 } } exit bad || k != 4 }' "$folder/report/table.txt"
check "compression: damped to the static answer" awk '$1 == "compression_web" { value[$2] = $10 }
    END { off = value["usl+damped"] / value["quas"] - 1; print off; exit !(value["quas"] < -13 && off < 1e-6 && off > -1e-6) }' "$folder/report/table.txt"
check "plates that move smoothed particles: Morris within 0.5 %, Monaghan within 5 % of the plate's speed" awk '$1 == "sph_couette" && $3 == 16 {
    error[$2] = $5 } END { print error["morris+h1.5"], error["mg+h1.5"]; exit !(error["morris+h1.5"] > 0 && error["morris+h1.5"] < 0.005 && error["mg+h1.5"] > 0 && error["mg+h1.5"] < 0.05) }' "$folder/report/table.txt"
check "the page has each case" sh -c 'for c in wave_bar tensile compression_web vibrating_beam sph_couette rkpm_poisson rkpm_creep cantilever; do grep -q "<h2 id=$c>" "$1" || exit 1; done' - "$folder/report/index.html"
check "the page ends" grep -q '^</html>$' "$folder/report/index.html"
check "each picture of the page is there" sh -c 'cd "$1" && n=0 && for f in $(sed -n "s/.*<img src=\"\([^\"]*\)\".*/\1/p" index.html); do
    grep -q "</svg>" "$f" || exit 1; n=$((n + 1)); done; test "$n" = 16' - "$folder/report"
check "charts name their axes with units" grep -q "run time.*s" "$folder/report/wave_bar-time.svg"
check "each row of the table stands on the page" sh -c 'awk "NR > 1 { print \$5, \$8 }" "$1/table.txt" | while read -r error bytes; do
    grep -q "<td>$error<td>.*<td>$bytes<td>" "$1/index.html" || exit 1; done' - "$folder/report"
check "each case ends with the scheme that is worth it" awk '/<h2 id=/ { cases++ } /class=worth><b>Worth it: [^<]/ { said++ }
    END { exit cases != 8 || said != 8 }' "$folder/report/index.html"

# Orders on a made-up table: 0.4 0.1 0.05 with 2 4 8 cells have order 2, then 1, and log2 of them a line of slope -1.5.
echo 'made | made | a b c d quas | 0.5 0.1 | ; ; | measure | 2 | 1e-3 | a 0.9 b 1.5 d 0.9 quas 0.9' >"$folder/made.cases"
while read -r scheme cells dtsc status value seconds; do echo "made $scheme $cells $dtsc $status $value $seconds 10 20"; done \
    >"$folder/made.runs" <<EOF
a 2 0.5 0 2.8 1
a 2 0.1 0 2.4 5
a 4 0.5 0 1.8 2
a 4 0.1 0 2.4 10
a 8 0.5 0 2.1 4
b 4 0.5 0 2.8 2
b 2 0.5 0 3.6 1
b 8 0.5 3 nan 4
b 16 0.5 0 2.2 8
d 2 0.5 0 2.2 3
d 4 0.5 0 2.8 6
d 8 0.5 0 2.4 12
c 2 0.5 0 2.4 1
c 4 0.5 0 2.0001 100
quas 2 0.5 0 2.4 0.5
quas 4 0.5 0 2.3 1
EOF
awk -f "$root/tests/report/table.awk" "$folder/made.cases" "$folder/made.runs" >"$folder/table.txt"
# made SCHEME CELLS DTSC "ORDER FIT"
made() {
    check "made-up table: $1 with $2 cells at $3 has order and fit $4" awk -v s="$1" -v c="$2" -v d="$3" -v expected="$4" '
        $2 == s && $3 == c && $4 == d { found = $12 " " $13 } END { print "found " found; exit found != expected }' "$folder/table.txt"
}
made a 2 0.5 "nan nan"
made a 4 0.5 "2.000 2.000"
made a 8 0.5 "1.000 1.500"
made a 4 0.1 "0.000 0.000"
made b 4 0.5 "1.000 1.000"  # rows in any order
made b 8 0.5 "nan nan"      # failed
made b 16 0.5 "1.000 1.000" # over the run that failed
made c 4 0.5 "nan nan"      # better than the answer
made quas 4 - "0.415 0.415"
awk -v size=smoke -v folder="$folder" -v here="$root/tests/report" -v version=made -v machine=up -v seconds_all=0 \
    -f "$root/tests/report/page.awk" "$folder/made.cases" "$folder/table.txt" >"$folder/made.html"
has_line() { check "made-up page: $1" grep -q -F "$2" "$folder/made.html"; }
has_line "an order that is met" "<td>a<td>8<td>1.00<td>1.50<td>at least 0.9: met<"
has_line "an order that is missed" "<td>b<td>16<td>1.00<td>1.00<td>at least 1.5: <b class=bad>missed<"
has_line "a high order now and then is no order" "<td>d<td>8<td>1.00<td>-0.50<td>at least 0.9: <b class=bad>missed<"
has_line "another one" "<td>quas<td>4<td>0.41<td>0.41<td>at least 0.9: <b class=bad>missed<"
# the front: quas from 0.5 and 1 s, a from 2 and 4 s, c from 100 s: a has log(100/2) of log(100/0.5)
has_line "the scheme of most of the time" "Worth it: a</b>, which has the least error over 74 % of the times from 0.5 to 100 s"
has_line "the least error" "the least of all, below the 0.001 that the answer is good to, is that of c in 100 s"

cp -r "$root/tests/report" "$folder/copy"
printf 'bar | wave_bar travel=0 amplitude=1e-7 | musl nothing | 0.5 | 8; 8; 8 | measure | error\n' >"$folder/copy/cases.table"
check "an unknown scheme is a mistake" sh -c '! sh "$1/copy/report.sh" "$2" "$1/report" smoke' - "$folder" "$build"
printf 'bar | wave_bar travel=0 amplitude=20 | musl usl | 0.9 | 8; 8; 8 | measure | error\n' >"$folder/copy/cases.table"
check "a failing run is no reason to stop" sh "$folder/copy/report.sh" "$build" "$folder/report" smoke
check "it stays in the table" awk '$1 == "bar" && $9 == 3 && $5 == "nan" { found = 1 } END { exit !found }' "$folder/report/table.txt"
check "and on the page" grep -q "Runs that failed: .*status 3" "$folder/report/index.html"
exit $failures
