#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What gcc's static analyser finds in the program and its tools; findings that answers.table explains are let pass, others fail.
# sh tests/check/analyse.sh [FILE ...]; without files all of src and tools. Two files at a time (JOBS).
cd "$(dirname "$0")/../.." || exit 2
if ! echo 'int main(void) { return 0; }' | gcc -fanalyzer -x c - -o /dev/null 2>/dev/null; then
    echo "skip analyse: no gcc with -fanalyzer here"
    exit 0
fi
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
export folder LC_ALL=C # quotes of messages hang on the language
[ $# -gt 0 ] || set -- src/*.c src/*/*.c tools/*.c
printf '%s\n' "$@" | xargs -P "${JOBS:-2}" -I{} sh -c '
    log=$folder/$(echo {} | tr / _)
    gcc -std=c11 -O1 -Isrc -fopenmp -fanalyzer -c {} -o "$log.o" >"$log.log" 2>&1 || echo "FAIL {}: it does not compile"
    sed -n "s|^.*warning: \(.*\)|{} \| \1|p" "$log.log" | grep "Wanalyzer"' >"$folder/found"
failed=0
grep '^FAIL' "$folder/found" && failed=1
sort -u "$folder/found" | grep -v '^FAIL' >"$folder/findings"
# a finding is answered by a row with its file and a part of its text
awk -F'|' '
    NR == FNR { if (!/^#/ && NF > 2) { n++; file[n] = $1; gsub(/ /, "", file[n]); part[n] = $2; gsub(/^ +| +$/, "", part[n]) } next }
    {
        name = $1; gsub(/ /, "", name)
        for (i = 1; i <= n; i++) if (file[i] == name && index($0, part[i])) { answered++; next }
        print "FAIL " $0; bad = 1
    }
    END { print answered + 0, "findings are answered in tests/check/answers.table"; exit bad }' tests/check/answers.table "$folder/findings" || failed=1
[ $failed -ne 0 ] || echo "ok $# files analysed"
exit $failed
