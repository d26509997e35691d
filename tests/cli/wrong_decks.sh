#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Wrong decks, and right ones that look unusual: sh tests/cli/wrong_decks.sh PROGRAM
# PROGRAM is mpm3d or a folder that holds it. Every deck is read with --check and has to end within
# thirty seconds with the messages that wrong_decks.table, wrong_decks_sph.table, wrong_decks_rkpm.table, wrong_decks_dynamic.table or the cases made below ask
# for, and no others.
here=$(cd "$(dirname "$0")" && pwd) || exit 2
program=$1
[ -d "$program" ] && program=$program/mpm3d
case $program in /*) ;; *) program=$PWD/$program ;; esac
[ -x "$program" ] || { echo "FAIL wrong_decks: no program $1"; exit 1; }
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' INT TERM
cd "$folder" || exit 2
LC_ALL=C; export LC_ALL
ASAN_OPTIONS=exitcode=99:${ASAN_OPTIONS:-}; export ASAN_OPTIONS
UBSAN_OPTIONS=exitcode=99:${UBSAN_OPTIONS:-}; export UBSAN_OPTIONS

# Words that --help says are not in this version; a deck later_WORD of any other is left out.
for topic in '' mate load velo outr; do "$program" --help $topic; done </dev/null 2>/dev/null |
    awk '/\(not in this version\)/ { print "later_" tolower($1) }' >later

# The decks of a table, and in `cases` for each: name, status, FILE:LINE:COLUMN:KIND ..., fragment
# make_decks NAME: those of NAME.table, from NAME.base.mpm
make_decks() {
    awk -v base="$here/$1.base.mpm" -v table="$1.table" '
    function escapes(text) {
        gsub(/\\n/, "\n", text); gsub(/\\t/, "\t", text); gsub(/\\r/, "\r", text); gsub(/\\s/, " ", text)
        gsub(/\\\\/, "\\", text)
        return text
    }
    function trim(text) { gsub(/^[ ]+|[ ]+$/, "", text); return text }
    # One edit of the deck in line[1 ... count]; a line may become several.
    function edit(text,    number, what) {
        number = text + 0
        sub(/^[0-9]+ /, "", text)
        what = substr(text, 1, 1)
        text = escapes(substr(text, 3))
        if (what == "-") gone[number] = 1
        else if (what == "=") line[number] = text
        else if (what == "+") before[number] = text "\n"
        else if (what == "<") last = number
        else print "FAIL " table ": bad edit in line " NR ": " what >"/dev/stderr"
    }
    # Writes the deck without its marks and returns their places.
    function write(name,    text, row, column, i, c, places) {
        for (i = 1; i <= last; i++)
            text = text before[i] (gone[i] ? "" : line[i] "\n")
        row = 1; column = 1
        while (match(text, /[\^~\n]/)) {
            c = substr(text, RSTART, 1)
            printf "%s", substr(text, 1, c == "\n" ? RSTART : RSTART - 1) >name
            column += RSTART - 1
            if (c == "\n") { row++; column = 1 }
            else places = places " " name ":" row ":" column (c == "^" ? ":error" : ":warning")
            text = substr(text, RSTART + 1)
        }
        printf "%s", text >name
        close(name)
        return places
    }
    BEGIN {
        while ((getline base_line[++lines] <base) > 0) continue
        while ((getline text <"later") > 0) is_later[text] = 1
    }
    /^#/ || /^[ \t]*$/ { next }
    {
        split("", gone); split("", before)
        for (i = 1; i < lines; i++) line[i] = base_line[i]
        last = lines - 1
        match($0, / \| /); name = trim(substr($0, 1, RSTART - 1)); rest = substr($0, RSTART + 3)
        if (name ~ /^later_/ && !(name in is_later)) next
        # the last bar separates the edits, the fragment may have bars
        match(rest, /^\||.* \| /)
        fragment = trim(substr(rest, 1, RLENGTH - 2)); edits = trim(substr(rest, RLENGTH + 1))
        count = split(edits, part, / ;; /)
        for (i = 1; i <= count; i++) edit(trim(part[i]))
        if (seen[name]++) print "FAIL " table ": two decks are called " name >"/dev/stderr"
        places = write(name ".mpm")
        print name "\t" (places ~ /error/ ? 2 : 0) "\t" places "\t" fragment
    }' "$here/$1.table" >>cases 2>>complaints
}
: >cases; : >complaints
make_decks wrong_decks
make_decks wrong_decks_sph
make_decks wrong_decks_rkpm
make_decks wrong_decks_dynamic
cat complaints

# --- decks that a line of the table can't say ---
base=$here/wrong_decks.base.mpm

# A case: add NAME STATUS "PLACES" "FRAGMENT"; the deck is NAME.mpm
add() { printf '%s\t%s\t%s\t%s\n' "$@" >>cases; }
# Writes a word many times: repeat COUNT WORD
repeat() { awk -v n="$1" -v word="$2" 'BEGIN { for (i = 0; i < n; i++) printf "%s", word }'; }

# Nothing, or nothing to read.
: >empty.mpm
add empty 2 empty.mpm:1:1:error "the deck ends without 'endi'"
printf '\n\n   \n! only a comment' >only_comment.mpm
add only_comment 2 only_comment.mpm:1:1:error "the deck ends without 'endi'"
printf 'endi' >only_endi.mpm
add only_endi 2 "only_endi.mpm:1:1:error only_endi.mpm:1:1:error only_endi.mpm:1:1:error" "the cell size is not given"

# Bytes.
{ sed -n 1,12p "$base"; printf 'dtsc 0.5\000\n'; sed -n '14,$p' "$base"; } >nul.mpm
add nul 2 nul.mpm:13:9:error "NUL byte; a deck is plain text"
printf 'mpm3d\000\000\000\000' >nul_title.mpm
add nul_title 2 nul_title.mpm:1:6:error "NUL byte"
{ cat "$base"; printf '\000\032\377'; } >right_nul_behind_endi.mpm
add right_nul_behind_endi 0 "" ""
dd if="$program" of=binary.mpm bs=30000 count=1 2>/dev/null
add binary 2 '*' "error: "
{ printf '\357\273\277'; cat "$base"; } >right_utf8_mark.mpm
add right_utf8_mark 0 "" ""
{ printf '\357\273\277nbc 1\n'; sed -n '3,$p' "$base"; } >utf8_mark.mpm
add utf8_mark 2 utf8_mark.mpm:1:1:error "unknown keyword 'nbc'"
awk '{ printf "%s\r\n", $0 }' "$base" >right_crlf.mpm
add right_crlf 0 "" ""
awk '{ sub(/^dtsc 0.5/, "dtsc x"); printf "%s\r\n", $0 }' "$base" >crlf.mpm
add crlf 2 crlf.mpm:13:6:error "found 'x'"
printf '%s' "$(cat "$base")" >right_no_line_end.mpm
add right_no_line_end 0 "" ""
awk '{ sub(/^dtsc/, "dt\033[31msc"); print }' "$base" >escape.mpm
add escape 2 escape.mpm:13:1:error "unknown keyword 'dt?[31msc'"

# Size.
{ sed -n 1,12p "$base"; printf 'dtsc '; repeat 1000000 0123456789; printf '\n'; sed -n '14,$p' "$base"; } >long_number.mpm
add long_number 2 long_number.mpm:13:6:error "factor of dtsc is too large: 012345678901234567890123456789012345..."
{ sed -n 1,12p "$base"; printf 'dtsc 0.5'; repeat 100000 0000000000; printf '\n'; sed -n '14,$p' "$base"; } >right_long_number.mpm
add right_long_number 0 "" ""
{ sed -n 1,12p "$base"; printf 'dtsc 1e-'; repeat 1000 0000000000; printf '1\n'; sed -n '14,$p' "$base"; } >right_long_exponent.mpm
add right_long_exponent 0 "" ""
{ sed -n 1,12p "$base"; repeat 1000000 abcdefghij; printf ' 1\n'; sed -n '13,$p' "$base"; } >long_word_of_10_mb.mpm
add long_word_of_10_mb 2 long_word_of_10_mb.mpm:13:1:error "unknown keyword 'abcdefghijabcdefghijabcdefghijabcdef...'"
{ sed -n 1,12p "$base"; repeat 1000000 '          '; printf 'dtsx 1\n'; sed -n '14,$p' "$base"; } >long_line.mpm
add long_line 2 long_line.mpm:13:10000001:error "unknown keyword 'dtsx'"
{ sed -n 1,12p "$base"; printf 'dtsc 0.5 ! '; repeat 1000000 'comment,, '; printf '\n'; sed -n '14,$p' "$base"; } >right_long_comment.mpm
add right_long_comment 0 "" ""
{ sed -n 1,1p "$base"; repeat 1000000 'word '; printf '\n'; sed -n '2,$p' "$base"; } >million_words.mpm
add million_words 2 million_words.mpm:2:1:error "unknown keyword 'word'"
{ sed -n 1,1p "$base"; repeat 1000000 '1 '; printf '\n'; sed -n '2,$p' "$base"; } >million_numbers.mpm
add million_numbers 2 million_numbers.mpm:2:1:error "expected a keyword, found the number 1"
{ sed -n 1,1p "$base"; repeat 300000 'endt 1 musl on '; sed -n '2,$p' "$base"; } >right_million_words.mpm
add right_million_words 0 "" ""
repeat 300000 'wrong
' >many_mistakes.mpm
add many_mistakes 2 '*' "unknown keyword 'wrong'"
repeat 1000000 ',' >commas.mpm
add commas 2 commas.mpm:1:1:error "comma before the first word"
repeat 100000 'load ' >loads.mpm
add loads 2 '*' "'load' inside the block 'load'"
{ sed -n 1,18p "$base"; repeat 100000 'mate '; sed -n '19,$p' "$base"; } >mates.mpm
add mates 2 '*' "'mate' inside the block 'mate'"

# Includes.
mkdir sub sub/deep directory.mpm
split_base() { sed -n '18,20p' "$base"; }
split_base >sub/materials.mpm
{ sed -n 1,17p "$base"; echo 'incl "sub/materials.mpm"'; sed -n '21,$p' "$base"; } >right_include.mpm
add right_include 0 "" ""
{ sed -n 1,17p "$base"; echo 'include sub/materials.mpm bulk 1 1'; sed -n '21,$p' "$base"; } >right_include_bare.mpm
add right_include_bare 0 "" ""
cp sub/materials.mpm "sub/two words.mpm"
{ sed -n 1,17p "$base"; echo 'include   "sub/two words.mpm" ! the materials'; sed -n '21,$p' "$base"; } >right_include_blank.mpm
add right_include_blank 0 "" ""
echo 'incl "../materials.mpm"' >sub/deep/materials.mpm
{ sed -n 1,17p "$base"; echo 'incl "sub/deep/materials.mpm"'; sed -n '21,$p' "$base"; } >right_include_nested.mpm
add right_include_nested 0 "" ""
sed 's/elas/eals/' sub/materials.mpm >sub/wrong.mpm
{ sed -n 1,17p "$base"; echo 'incl "sub/wrong.mpm"'; sed -n '21,$p' "$base"; } >include_wrong.mpm
add include_wrong 2 sub/wrong.mpm:2:3:error "unknown law 'eals'"
sed -n '18,19p' "$base" >sub/cut.mpm
{ sed -n 1,17p "$base"; echo 'incl "sub/cut.mpm"'; sed -n '21,$p' "$base"; } >include_cut.mpm
add include_cut 2 include_cut.mpm:19:1:error "'part' inside the block 'mate'; expected material 2 of 2"
{ sed -n 1,17p "$base"; echo 'incl "nowhere.mpm"'; sed -n '21,$p' "$base"; } >include_missing.mpm
add include_missing 2 include_missing.mpm:18:6:error "cannot include 'nowhere.mpm': No such file"
{ sed -n 1,17p "$base"; echo 'incl "sub"'; sed -n '21,$p' "$base"; } >include_folder.mpm
add include_folder 2 include_folder.mpm:18:6:error "cannot include 'sub'"
{ sed -n 1,17p "$base"; echo 'incl ""'; sed -n '21,$p' "$base"; } >include_empty.mpm
add include_empty 2 include_empty.mpm:18:6:error "a file name is missing"
{ sed -n 1,17p "$base"; echo 'incl -'; sed -n '21,$p' "$base"; } >include_standard_input.mpm
add include_standard_input 2 include_standard_input.mpm:18:6:error "standard input can't be included"
{ sed -n 1,17p "$base"; echo 'incl "sub/materials.mpm'; sed -n '21,$p' "$base"; } >include_quote.mpm
add include_quote 2 include_quote.mpm:18:6:error "quotation mark is not closed"
{ sed -n 1,17p "$base"; echo 'incl "include_itself.mpm"'; sed -n '18,$p' "$base"; } >include_itself.mpm
add include_itself 2 include_itself.mpm:18:6:error "the file includes itself"
{ sed -n 1,17p "$base"; echo 'incl "sub/loop.mpm"'; sed -n '18,$p' "$base"; } >include_loop.mpm
echo 'incl "../include_loop.mpm"' >sub/loop.mpm
add include_loop 2 sub/loop.mpm:1:6:error "the file includes itself"
{ sed -n 1,17p "$base"; printf 'bulk 1 1\000' >sub/nul.mpm; echo 'incl "sub/nul.mpm"'; sed -n '21,$p' "$base"; } >include_nul.mpm
add include_nul 2 sub/nul.mpm:1:9:error "NUL byte"
{ sed -n 1,17p "$base"; echo 'inlcude "sub/materials.mpm"'; sed -n '21,$p' "$base"; } >include_misspelt.mpm
add include_misspelt 2 include_misspelt.mpm:18:1:error "unknown keyword 'inlcude'; did you mean 'include'?"
echo 'grav 2 0 0 -9.8' >sub/gravity.mpm
{ sed -n 1,31p "$base"; echo 'incl "sub/gravity.mpm"'; sed -n '33,$p' "$base"; } >include_in_load.mpm
add include_in_load 2 include_in_load.mpm:32:1:error "'incl' inside the block 'load'; expected 'endl' first"
if [ "$(id -u)" -ne 0 ]; then
    : >sub/locked.mpm; chmod 000 sub/locked.mpm
    { sed -n 1,17p "$base"; echo 'incl "sub/locked.mpm"'; sed -n '21,$p' "$base"; } >include_unreadable.mpm
    add include_unreadable 2 include_unreadable.mpm:18:6:error "Permission denied"
fi
# Surfaces of part solid; their path is seen from the deck that names them.
# box_stl LEFT_OUT: a box from 1 to 3, without one of its twelve triangles where LEFT_OUT is 1 to 12
box_stl() {
    awk -v without="$1" 'BEGIN {
        split("000 010 110 000 110 100 001 101 111 001 111 011 000 100 101 000 101 001 010 011 111 010 111 110 " \
              "000 001 011 000 011 010 100 110 111 100 111 101", corner, " ")
        print "solid box"
        for (t = 1; t <= 12; t++) {
            if (t == without) continue
            print "facet normal 0 0 0\nouter loop"
            for (c = 3 * t - 2; c <= 3 * t; c++) print "vertex", 1 + 2 * substr(corner[c], 1, 1), 1 + 2 * substr(corner[c], 2, 1), 1 + 2 * substr(corner[c], 3)
            print "endloop\nendfacet"
        }
        print "endsolid box"
    }'
}
# solid_deck STEP: the block of the base deck as a solid
solid_deck() { sed -n 1,20p "$base"; printf 'part solid 1\n1 7.8e-3 0.5 0 0 0\n%s\nendp\n' "$1"; sed -n '23,$p' "$base"; }
box_stl 0 >sub/box.stl
box_stl 0 >"sub/two words.stl"
solid_deck 'add stl sub/box.stl' >right_stl.mpm
add right_stl 0 "" ""
solid_deck 'add stl "sub/two words.stl" move 0 0 0 scale 1 cut box 5 6 5 6 5 6' >right_stl_blank.mpm
add right_stl_blank 0 "" ""
printf 'part solid 1\n1 7.8e-3 0.5 0 0 0\nadd stl box.stl\nendp\n' >sub/solid.mpm
{ sed -n 1,20p "$base"; echo 'incl sub/solid.mpm'; sed -n '23,$p' "$base"; } >right_stl_of_include.mpm
add right_stl_of_include 0 "" ""
box_stl 7 >sub/open.stl
solid_deck 'add stl sub/open.stl' >stl_open.mpm
add stl_open 2 stl_open.mpm:23:9:error "the surface of 'sub/open.stl' is not closed: 3 edges do not have two triangles of opposite direction, the first from 3 3 3 to 1 3 3 has 1"
sed -n 1,40p sub/box.stl >sub/cut.stl
solid_deck 'add stl sub/cut.stl' >stl_cut.mpm
add stl_cut 2 stl_cut.mpm:23:9:error "cannot use 'sub/cut.stl': line 41: the file ends here, it is cut; expected "
solid_deck 'add stl right_stl.mpm' >stl_is_deck.mpm
add stl_is_deck 2 stl_is_deck.mpm:23:9:error "cannot use 'right_stl.mpm': "
solid_deck 'add stl sub' >stl_folder.mpm
add stl_folder 2 stl_folder.mpm:23:9:error "cannot read 'sub'"
solid_deck 'add stl -' >stl_standard_input.mpm
add stl_standard_input 2 stl_standard_input.mpm:23:9:error "standard input can't be a shape's file"
solid_deck 'add stl sub/box.stl scale 1e7' >stl_scale.mpm
add stl_scale 2 stl_scale.mpm:23:9:error "the surface of 'sub/box.stl' reaches more than a million spacings"
{ box_stl 0; box_stl 0 | sed 's/vertex 1/vertex 2/; s/vertex 3/vertex 4/'; } >sub/overlap.stl
solid_deck 'add stl sub/overlap.stl' >stl_overlap.mpm
add stl_overlap 0 stl_overlap.mpm:23:9:warning "shells that overlap: the 32 points inside two of them are outside"
add directory 4 "" "cannot read 'directory.mpm'"
add not_there 4 "" "cannot read 'not_there.mpm': No such file"

# Nodes of rkpm from a file: their path is seen from the deck that names them. nodes_deck NAME [ANOTHER WORD]
nodes_deck() {
    printf 'meth rkpm\nrkpm\nnode box 0 1 0 1 4 4\nsupp 2\nprob elastic\nmodu 1 0.3\nfunc patch\ncons nits\nfile %s\n%s\nends\nendi\n' "$1" "${2:-dime 2}"
}
# four_nodes [LINE]: lines of a file of nodes, and one more
four_nodes() { printf '# corners\n0 0\n1, 0 ! the second\n\n0\t1\r\n1 1\n'; [ -z "$1" ] || printf '%s\n' "$1"; }
four_nodes >sub/corners.nodes
nodes_deck sub/corners.nodes >right_nodes.mpm
add right_nodes 0 "" ""
# wrong_nodes NAME LINE MESSAGE: a file with a fifth line that is wrong
wrong_nodes() {
    four_nodes "$2" >"sub/$1.nodes"
    nodes_deck "sub/$1.nodes" >"$1.mpm"
    add "$1" 2 "$1.mpm:9:1:error" "$3"
}
wrong_nodes nodes_word '0.5 half' "line 7 of 'sub/nodes_word.nodes' has no 2 coordinates"
wrong_nodes nodes_short '0.5' "line 7 of 'sub/nodes_short.nodes' has no 2 coordinates"
wrong_nodes nodes_long '0.5 0.5 0.5' "line 7 of 'sub/nodes_long.nodes' has no 2 coordinates"
wrong_nodes nodes_large '0.5 1e999' "line 7 of 'sub/nodes_large.nodes' has no 2 coordinates"
wrong_nodes nodes_nan '0.5 nan' "line 7 of 'sub/nodes_nan.nodes' has no 2 coordinates"
wrong_nodes nodes_outside '0.5 1.25' "node 5 of 'sub/nodes_outside.nodes' is outside the box: its y is 1.25"
wrong_nodes nodes_twice '1 0' "'sub/nodes_twice.nodes' has two nodes at (1, 0, 0)"
printf '0 0\n1 1\n' >sub/few.nodes
nodes_deck sub/few.nodes >nodes_few.mpm
add nodes_few 2 nodes_few.mpm:9:1:error "'sub/few.nodes' has 2 nodes; expected more than 2"
: >sub/empty.nodes
nodes_deck sub/empty.nodes >nodes_empty.mpm
add nodes_empty 2 nodes_empty.mpm:9:1:error "'sub/empty.nodes' has 0 nodes; expected more than 2"
nodes_deck sub >nodes_folder.mpm
add nodes_folder 2 nodes_folder.mpm:9:1:error "cannot read 'sub'"
nodes_deck sub/box.stl >nodes_of_surface.mpm
add nodes_of_surface 2 nodes_of_surface.mpm:9:1:error "line 1 of 'sub/box.stl' has no 2 coordinates"
nodes_deck sub/corners.nodes 'cons lagr' >nodes_hats.mpm
add nodes_hats 2 nodes_hats.mpm:9:1:error "hats need the box's lattice; expected 'cons nits'"
nodes_deck sub/corners.nodes 'pert 0.1 1' >nodes_moved.mpm
add nodes_moved 2 nodes_moved.mpm:9:1:error "nodes of a file stay where they are; leave 'pert' out"

# --- running, in two rows: a deck is short, starting the program is not ---
limit=
command -v timeout >/dev/null && limit='timeout 30'
cut -f 1 cases | awk '{ print >("names" NR % 2) }'
run_row() {
    while read -r name; do
        $limit "$program" --threads 1 --check "$name.mpm" >"$name.out" 2>"$name.err" </dev/null
        echo "$name $?"
    done <"names$1" >"statuses$1"
}
run_row 0 & run_row 1; wait

# --- judging: every message has its line and caret, and there are no others ---
awk '
    function fail(why) { if (!reason) reason = why }
    # Takes the messages apart; the places found go to found[1 ... messages].
    function read_messages(file,    text, at, kind, place, shown) {
        messages = lines = 0
        while ((getline text <file) > 0) {
            lines++
            if (text ~ /^mpm3d: / || text ~ /^\.\.\. and more/) {
                first = first text
            } else if (match(text, /: (error|warning): /)) {
                place = substr(text, 1, RSTART - 1)
                kind = substr(text, RSTART + 2, RLENGTH - 4)
                found[++messages] = place ":" kind
                if (messages == 1) first = text
                else if (messages < 6) first = first "\n" text
                if ((getline shown <file) < 1 || shown !~ /^    /) fail("the line of the deck is not shown")
                if ((getline shown <file) < 1 || shown !~ /^ +\^$/) fail("no caret")
                at = place; sub(/.*:/, "", at); at += 0
                if (at <= 50 && !wide[name] && length(shown) != 4 + at) fail("the caret is not below column " at)
            } else {
                fail("neither error nor warning: " text)
            }
        }
        close(file)
    }
    BEGIN {
        wide["utf8_word"] = wide["utf8_mark"] = 1
        for (i = 0; i < 2; i++)
            while ((getline text <("statuses" i)) > 0) { split(text, word, " "); status[word[1]] = word[2] }
        while ((getline text <"cases") > 0) {
            split(text, field, "\t")
            name = field[1]; fragment = field[4]; reason = first = ""
            expected = split(field[3], place, " ")
            read_messages(name ".err")
            if (status[name] == 124) fail("more than 30 seconds")
            if (status[name] != field[2]) fail("exit status " status[name] " instead of " field[2])
            if (index(first, fragment) == 0) fail("no message with: " fragment)
            if (place[1] != "*") {
                for (i = 1; i <= expected && i <= messages; i++)
                    if (place[i] != found[i]) fail("expected " place[i] ", found " found[i])
                if (messages != expected) fail(messages " messages instead of " expected)
            }
            if (field[2] != 0 && (getline text <(name ".out")) > 0) fail("output: " text)
            close(name ".out")
            if (reason) { failed++; print "FAIL " name ": " reason (first ? "\n     " first : "") }
            else { passed++; print "ok " name }
        }
        printf "%d passed, %d failed\n", passed, failed
        exit (failed > 0 || passed == 0)
    }'
status=$?
[ -s complaints ] && status=1
exit $status
