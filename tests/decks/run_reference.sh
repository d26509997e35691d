#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the decks of reference/ and compares them with figures of the reference program:
# sh tests/decks/run_reference.sh BUILD. One check per deck and file: all its lines of
# reference.table must hold.
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
failed=0
for deck in "$here"/reference/*.mpm; do
    job=$(basename "$deck" .mpm)
    "$build/mpm3d" --quiet -o "$folder" "$deck" || { echo "FAIL $job: exit status $?"; failed=1; continue; }
    for ending in _energy.dat _momentum.dat _curv.dat _contact.dat _anim.dat; do
        grep -q "^$job $ending " "$here/reference.table" || continue
        # the last zone of the file; names from its VARIABLES line, with _ for blanks inside
        awk -v job="$job" -v ending="$ending" -v table="$here/reference.table" '
            /^VARIABLES/ { n = split($0, part, "\""); for (i = 2; i <= n; i += 2) { name = tolower(part[i]); gsub(/ /, "_", name); column[name] = i / 2 } next }
            /^ZONE/ { row = 0; next }
            /^TITLE/ { next }
            { value[++row] = $0 }
            END {
                bad = count = 0; worst = 0
                while ((getline line <table) > 0) {
                    split(line, want, " ")
                    if (want[1] != job || want[2] != ending) continue
                    count++
                    place = column[want[4]]; split(value[want[3]], found, " ")
                    difference = found[place] - want[5]; if (difference < 0) difference = -difference
                    if (difference / want[6] > worst) worst = difference / want[6]
                    if (!place || found[place] == "" || !(difference <= want[6])) {
                        if (bad++ < 5) print "  row " want[3] " " want[4] ": " found[place] " instead of " want[5]
                    }
                }
                if (bad) { print "FAIL " job ending ": " bad " of " count " figures"; exit 1 }
                printf "ok %s%s: %d figures, largest deviation %.1e of the scale\n", job, ending, count, worst * 1e-5
            }' "$folder/$job$ending" || failed=1
    done
done
exit $failed
