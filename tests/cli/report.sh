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
    END { exit bad || NR < 19 }' "$folder/report/table.txt"
check "errors of all runs" awk 'NR > 1 && !($5 + 0 > 0) { print; bad = 1 } END { exit bad }' "$folder/report/table.txt"
for scheme in usf usl musl musl+gimp; do order $scheme 0.9; done
order musl+bimp 1.5
check "the page has each case" sh -c 'for c in wave_bar tensile; do grep -q "<h2 id=$c>" "$1" || exit 1; done' - "$folder/report/index.html"
check "the page ends" grep -q '^</html>$' "$folder/report/index.html"
check "each picture of the page is there" sh -c 'cd "$1" && n=0 && for f in $(sed -n "s/.*<img src=\"\([^\"]*\)\".*/\1/p" index.html); do
    grep -q "</svg>" "$f" || exit 1; n=$((n + 1)); done; test "$n" = 4' - "$folder/report"
check "charts name their axes with units" grep -q "run time.*s" "$folder/report/wave_bar-time.svg"
check "each row of the table stands on the page" sh -c 'awk "NR > 1 { print \$5, \$8 }" "$1/table.txt" | while read -r error bytes; do
    grep -q "<td>$error<td>.*<td>$bytes<td>" "$1/index.html" || exit 1; done' - "$folder/report"
cp -r "$root/tests/report" "$folder/copy"
printf 'bar | wave_bar travel=0 amplitude=1e-7 | musl nothing | 0.5 | 8; 8; 8 | measure | error\n' >"$folder/copy/cases.table"
check "an unknown scheme is a mistake" sh -c '! sh "$1/copy/report.sh" "$2" "$1/report" smoke' - "$folder" "$build"
printf 'bar | wave_bar travel=0 amplitude=20 | musl usl | 0.9 | 8; 8; 8 | measure | error\n' >"$folder/copy/cases.table"
check "a failing run is no reason to stop" sh "$folder/copy/report.sh" "$build" "$folder/report" smoke
check "it stays in the table" awk '$1 == "bar" && $9 == 3 && $5 == "nan" { found = 1 } END { exit !found }' "$folder/report/table.txt"
check "and on the page" grep -q "Runs that failed: .*status 3" "$folder/report/index.html"
exit $failures
