#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the decks of numbers.table and compares what they give: sh tests/decks/run_decks.sh BUILD
# With `all` behind BUILD those of numbers_long.table too, with the time each deck takes and a count.
# A line of a table: DECK | FILE ENDING | tecstat's words | expected | tolerance | where it comes from
# In a word ~ stands for a blank. The tolerance is relative, or absolute with an `a` behind it.
build=$(cd "$1" && pwd) || exit 2
all=$2
here=$(dirname "$0")
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
passed=0
failed=0
previous=
cat /tmp/h/dw/nt ${all:+"$here/numbers_long.table"} >"$folder/rows"

# run_deck DECK: once for all of its lines
run_deck() {
    start=$(date +%s.%N)
    "$build/mpm3d" --quiet -o "$folder" "$here/../../$1" || { echo "FAIL $1: exit status $?"; failed=$((failed + 1)); }
    [ "$all" ] && echo "$start $(date +%s.%N)" | awk -v deck="$1" '{ printf "time %s: %.1f s\n", deck, $2 - $1 }'
    previous=$1
}

while IFS='|' read -r deck ending words expected tolerance source; do
    deck=$(echo "$deck" | tr -d ' ')
    case $deck in '' | '#'*) continue ;; esac
    ending=$(echo "$ending" | tr -d ' ')
    job=$(basename "$deck" .mpm)
    [ "$deck" = "$previous" ] || run_deck "$deck"
    name="$deck $ending$words"
    set --
    for word in $words; do set -- "$@" "$(echo "$word" | tr '~' ' ')"; done
    found=$("$build/tecstat" "$folder/$job$ending" "$@" 2>&1 | tail -n 1)
    if echo "$found $expected $tolerance" | awk -v name="$name" '{
        absolute = sub(/a$/, "", $3); difference = $1 - $2; if (difference < 0) difference = -difference
        size = $2 < 0 ? -$2 : $2; bound = absolute ? $3 + 0 : $3 * size
        if ($1 + 0 == $1 && difference <= bound) print "ok " name
        else { print "FAIL " name ": " $1 " instead of " $2 ", tolerance " bound; exit 1 }
    }'; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
done <"$folder/rows"
[ "$all" ] && echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
