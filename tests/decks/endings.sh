#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the decks of decks/extreme: those of endings.table must stop with the status and words there, the
# others come to their end, and no output file has a number that is not finite: sh tests/decks/endings.sh BUILD
# With `all` behind BUILD those of numbers_long.table too. What they find is compared by run_decks.sh.
build=$(cd "$1" && pwd) || exit 2
all=$2
cd "$(dirname "$0")/../.." || exit 2
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
failed=0
for deck in decks/extreme/*.mpm; do
    [ "$all" ] || ! grep -q "^$deck " tests/decks/numbers_long.table || continue
    row=$(grep "^$deck " tests/decks/endings.table)
    expected=$(echo "${row:-- | 0 | }" | awk -F'|' '{ gsub(/ /, "", $2); print $2 }')
    words=$(echo "$row" | awk -F'|' '{ sub(/^ */, "", $3); sub(/ *$/, "", $3); print $3 }')
    start=$(date +%s.%N)
    timeout 600 "$build/mpm3d" --quiet -o "$folder" "$deck" 2>"$folder/message"
    status=$?
    [ "$all" ] && echo "$start $(date +%s.%N)" | awk -v deck="$deck" '{ printf "time %s: %.1f s\n", deck, $2 - $1 }'
    if [ "$status" -ne "$expected" ]; then
        echo "FAIL $deck: exit status $status instead of $expected"; sed 's/^/    /' "$folder/message"; failed=1
    elif ! grep -q -e "$words" "$folder/message" && [ "$row" ]; then
        echo "FAIL $deck: no '$words' in its message"; sed 's/^/    /' "$folder/message"; failed=1
    elif grep -Eil '(^|[[:space:]])[-+]?(nan|inf|infinity)([[:space:]]|$)' $(find "$folder" -name '*.dat') /dev/null; then
        echo "FAIL $deck: a number in its output is not finite"; failed=1
    else
        echo "ok $deck: $(head -n 1 "$folder/message" | sed 's/.*: //')"
    fi
    rm -f "$folder"/*
done
exit $failed
