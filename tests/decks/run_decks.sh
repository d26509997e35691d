#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the decks of numbers.table and compares what they give: sh tests/decks/run_decks.sh BUILD
# A line of the table: DECK | FILE ENDING | tecstat's words | expected | tolerance | where it comes from
# The tolerance is relative, or absolute with an `a` behind it.
build=$(cd "$1" && pwd) || exit 2
here=$(dirname "$0")
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
failed=0
previous=
while IFS='|' read -r deck ending words expected tolerance source; do
    deck=$(echo "$deck" | tr -d ' ')
    case $deck in '' | '#'*) continue ;; esac
    ending=$(echo "$ending" | tr -d ' ')
    job=$(basename "$deck" .mpm)
    if [ "$deck" != "$previous" ]; then
        "$build/mpm3d" --quiet -o "$folder" "$here/../../$deck" || { echo "FAIL $deck: exit status $?"; failed=1; }
        previous=$deck
    fi
    name="$deck $ending$words"
    # shellcheck disable=SC2086 # the words are to be split
    found=$("$build/tecstat" "$folder/$job$ending" $words 2>&1 | tail -n 1)
    echo "$found $expected $tolerance" | awk -v name="$name" '{
        absolute = sub(/a$/, "", $3); difference = $1 - $2; if (difference < 0) difference = -difference
        size = $2 < 0 ? -$2 : $2; bound = absolute ? $3 + 0 : $3 * size
        if ($1 + 0 == $1 && difference <= bound) print "ok " name
        else { print "FAIL " name ": " $1 " instead of " $2 ", tolerance " bound; exit 1 }
    }' || failed=1
done <"$here/numbers.table"
exit $failed
