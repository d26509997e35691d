#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every deck of decks/ stands in numbers.table, numbers_long.table or endings.table, and the comment at
# its head says the numbers or words that the tables expect and how long it takes: `Takes N s`. sh tests/decks/heads.sh BUILD
cd "$(dirname "$0")/../.." || exit 2
tables="tests/decks/numbers.table tests/decks/numbers_long.table"
failed=0
for deck in $(find decks -name '*.mpm' | sort); do
    # the comment lines between the title and the first command
    head=$(awk 'NR == 1 { next } /^!/ { print; next } { exit }' "$deck" | tr '\n' ' ')
    said=1
    # shellcheck disable=SC2086 # the two names are to be split
    numbers=$(awk -F'|' -v deck="$deck" '{ gsub(/ /, "", $1); gsub(/ /, "", $4) } $1 == deck { print $4 }' $tables | sort -u)
    # decks that must stop: the words of their message
    words=$(awk -F'|' -v deck="$deck" '{ gsub(/ /, "", $1); sub(/^ */, "", $3); sub(/ *$/, "", $3) } $1 == deck { print $3 }' tests/decks/endings.table)
    case "$head" in
    *"$words"*) ;;
    *) echo "FAIL $deck: its head does not say '$words', which endings.table expects"; said=0 ;;
    esac
    [ "$numbers$words" ] || { echo "FAIL $deck is in no table of tests/decks"; said=0; }
    for number in $numbers; do
        case "$head" in
        *[!0-9.]"$number"[!0-9]*) ;;
        *) echo "FAIL $deck: its head does not say $number, which a table expects"; said=0 ;;
        esac
    done
    echo "$head" | grep -Eq 'Takes [0-9.]+ s\b' || { echo "FAIL $deck: its head does not say how long it takes"; said=0; }
    if [ $said -eq 1 ]; then echo "ok $deck"; else failed=1; fi
done
exit $failed
