#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every word of the manual has a text, and stands in a deck of decks/ or tests/; MANUAL.md is that of
# the program. sh tests/cli/words.sh BUILD
build=$(cd "$1" && pwd) || exit 2
cd "$(dirname "$0")/../.." || exit 2
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
failed=0
"$build/mpm3d" --manual >"$folder/manual"
if cmp -s "$folder/manual" MANUAL.md; then echo "ok MANUAL.md is up to date"; else echo "FAIL MANUAL.md is not that of the program: make manual"; failed=1; fi
# all words of all decks, cut to four letters; comments do not count
find decks tests -name '*.mpm' | while read -r deck; do cat "$deck"; done | sed 's/!.*//' | tr ', \t' '\n\n\n' |
    tr '[:upper:]' '[:lower:]' | cut -c1-4 | sort -u >"$folder/used"
# a type of seos stands third on its line
find decks tests -name '*.mpm' | while read -r deck; do cat "$deck"; done | sed 's/!.*//' |
    awk 'tolower(substr($1, 1, 4)) == "seos" { print $3 }' | sort -u >>"$folder/used"
awk -F'|' '/^\| `/ { word = $2; gsub(/[ `]/, "", word); text = $3; gsub(/ /, "", text); print tolower(word), length(text), /not in this version/ }' "$folder/manual" |
while read -r word length later; do
    if [ "$length" -lt 4 ]; then
        echo "FAIL $word has no text"
    elif [ "$later" = 1 ] || grep -qx "$(echo "$word" | cut -c1-4)" "$folder/used"; then
        echo "ok $word"
    else
        echo "FAIL $word stands in no deck"
    fi
done >"$folder/said"
cat "$folder/said"
grep -q '^FAIL' "$folder/said" && failed=1
exit $failed
