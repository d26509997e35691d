#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_tools.sh: tests of tecdiff, tecstat and tecview as a user runs them.
#
# usage: test_tools.sh FOLDER_WITH_THE_TOOLS
#
# Builds nothing. Prints "ok NAME" or "FAIL NAME: reason" per test and a last line
# "N passed, N failed"; exit status 1 when any failed, 2 when the tools are not there.

LC_ALL=C
export LC_ALL
# a sanitizer's report must not look like one of the tools' own exit statuses
ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}exitcode=99"
UBSAN_OPTIONS="${UBSAN_OPTIONS:+$UBSAN_OPTIONS:}halt_on_error=1:exitcode=99"
export ASAN_OPTIONS UBSAN_OPTIONS

if [ $# -ne 1 ]; then
    echo "usage: test_tools.sh FOLDER_WITH_THE_TOOLS" >&2
    exit 2
fi
tools=$(cd "$1" 2>/dev/null && pwd)
for tool in tecdiff tecstat tecview; do
    if [ ! -x "$tools/$tool" ]; then
        echo "test_tools.sh: no program $1/$tool" >&2
        exit 2
    fi
done

work=$(mktemp -d "${TMPDIR:-/tmp}/test_tools.XXXXXX") || exit 2
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
cd "$work" || exit 2

passed=0
failed=0

pass() {
    echo "ok $1"
    passed=$((passed + 1))
}

reject() {
    echo "FAIL $1: $2"
    failed=$((failed + 1))
}

# expect NAME STATUS OUTPUT ERROR TOOL ARGUMENT...
# OUTPUT: the exact standard output with lines joined by " / ", or "*" for anything.
# ERROR: a text that standard error must contain, or "" when it must be empty.
expect() {
    name=$1
    status=$2
    output=$3
    error=$4
    tool=$5
    shift 5
    "$tools/$tool" "$@" >out 2>err </dev/null
    found_status=$?
    found_output=$(awk 'NR > 1 { printf " / " } { printf "%s", $0 }' out)
    if [ "$found_status" -ne "$status" ]; then
        reject "$name" "exit status $found_status instead of $status: $(head -n 1 err)"
    elif [ "$output" != "*" ] && [ "$found_output" != "$output" ]; then
        reject "$name" "printed '$found_output' instead of '$output'"
    elif [ -z "$error" ] && [ -s err ]; then
        reject "$name" "unexpected message: $(head -n 1 err)"
    elif [ -n "$error" ] && ! grep -F -e "$error" err >/dev/null; then
        reject "$name" "the message '$(head -n 1 err)' lacks '$error'"
    else
        pass "$name"
    fi
}

# contains NAME TEXT: the last tool's output has the text
contains() {
    if grep -F -e "$2" out >/dev/null; then
        pass "$1"
    else
        reject "$1" "the output lacks '$2'"
    fi
}

# ---- files ----

cat >full.dat <<'END'
TITLE = "a bar # with a sign"
VARIABLES = "X" "Y" "Z"
"mat " "disx"
DATASETAUXDATA Common.x="a b"
ZONE T="time 0.000E+00" I=2, F=POINT
STRANDID=1, SOLUTIONTIME=0.0
0 0 0 1 0
1 0 0 1 0

ZONE T="time 1.000E-03" I=     4, F=POINT, STRANDID=1
AUXDATA step = "17"
SOLUTIONTIME=1.0000001E-03 DT=(SINGLE SINGLE SINGLE
 SINGLE SINGLE)
# four rows
0.0 0.0 0.0 1 0.00
0.5 0.0 0.0 1 0.10
1.0 1.0 0.0 2 0.20
3.0 2.0 0.0 2 0.60 # the end
END

cat >bare.dat <<'END'
TITLE = "Taylor bar                                                  "
VARIABLES= "X"   "Y"   "Z"   "mat " "disx"
ZONE T="time 0.000E+00"
  0.0000E+00  0.0000E+00 -0.0000E+00  1  0.0000E+00
  0.1000E+01  0.0000E+00  0.0000E+00  1  0.0000E+00
ZONE T="time 0.100E-02"
  0.0000E+00  0.0000E+00  0.0000E+00  1  0.0000E+00
  0.5000E+00  0.0000E+00  0.0000E+00  1  0.1000E+00
  0.1000E+01  0.1000E+01  0.0000E+00  2  0.2000E+00
  0.3000E+01  0.2000E+01  0.0000E+00  2  0.6000E+00
END

printf 'Time engk1       engi1       \n 0.0 1.0 2.0\n 0.5 3.0 4.0\n' >curve.dat
printf '0.1234-104 1.0D-3 -.5e+1 +0.2E+02\n' >fortran.dat
printf 'a b c\nNaN -Infinity 1\nnan -inf 2\n' >nan.dat
printf 'a b c\nNaN -Infinity 1\n7 -inf 2\n' >nan2.dat
printf 'a b c\nNaN -Infinity 1\nnan inf 2\n' >inf2.dat
printf 't v\n1 0.1\n2 100\n' >one.dat
printf 't v\n1 0.10000000000000002\n2 100\n' >ulp.dat
printf 't v\n1 0.11\n2 100\n' >off.dat
printf 't w\n1 0.1\n2 100\n' >renamed.dat
printf 't v\n1 0.1\n' >short.dat
printf 'Disx\tX\r\n0.2,1.2\r\n' >commas.dat

# ---- tecdiff ----

expect diff_equal_files 0 "" "" tecdiff full.dat full.dat
expect diff_bare_header_and_layout 0 "" "" tecdiff full.dat bare.dat
expect diff_one_ulp 1 "*" "" tecdiff one.dat ulp.dat
contains diff_one_ulp_entry "zone 1 row 1 v: 0.10000000000000001 in A, 0.10000000000000002 in B"
expect diff_absolute_tolerance 0 "" "" tecdiff -a 1e-16 one.dat ulp.dat
expect diff_relative_tolerance 0 "" "" tecdiff -r 0.1 one.dat off.dat
expect diff_relative_too_small 1 "*" "" tecdiff -r 0.05 one.dat off.dat
expect diff_scale_of_column 0 "" "" tecdiff -r 1e-3 --scale one.dat off.dat
expect diff_quiet 1 "" "" tecdiff -q one.dat off.dat
expect diff_nan_equals_nan 0 "" "" tecdiff nan.dat nan.dat
expect diff_nan_and_number 1 "*" "" tecdiff -a 1e300 -r 1 nan.dat nan2.dat
contains diff_nan_named "zone 1 row 2 a: nan in A, 7 in B"
expect diff_infinities 1 "*" "" tecdiff -r 1 --scale nan.dat inf2.dat
expect diff_minus_zero 0 "" "" tecdiff bare.dat full.dat
expect diff_rows 1 "zone 1: 2 rows in A, 1 rows in B" "" tecdiff one.dat short.dat
expect diff_names 1 "variable 2: 'v' in A, 'w' in B (not compared)" "" tecdiff one.dat renamed.dat
expect diff_ignore_names 0 "" "" tecdiff --ignore-names one.dat renamed.dat
expect diff_variable_count 1 "*" "" tecdiff --ignore-names one.dat curve.dat
contains diff_variable_count_stated "variables: 2 in A, 3 in B"

sed '/time 0.100E-02/,$d' bare.dat >one_zone.dat
expect diff_zone_count 1 "zones: 2 in A, 1 in B" "" tecdiff bare.dat one_zone.dat
sed 's/0.100E-02/0.200E-02/' bare.dat >later.dat
expect diff_solution_time 1 "*" "" tecdiff bare.dat later.dat
contains diff_solution_time_stated "zone 2: solution time 0.001"

awk 'BEGIN { for (i = 1; i <= 30; ++i) print i, 2 * i }' >count_a.dat
awk 'BEGIN { for (i = 1; i <= 30; ++i) print i, 2 * i + i / 1000 }' >count_b.dat
expect diff_many 1 "*" "" tecdiff -n 3 count_a.dat count_b.dat
contains diff_many_table "c2                   30  3.000000e-02      1        30"
contains diff_many_counted "3 of 30 differing entries shown"
if [ "$(grep -c '^zone' out)" -eq 3 ]; then pass diff_count_option; else
    reject diff_count_option "-n 3 printed $(grep -c '^zone' out) entries"
fi
expect diff_standard_input_empty 2 "" "-: error: the file is empty" tecdiff - one.dat
expect diff_no_files 2 "" "usage: tecdiff" tecdiff
expect diff_negative_tolerance 2 "" "tolerance" tecdiff -a -1 one.dat one.dat
expect diff_unknown_option 2 "" "unknown option '--scales'" tecdiff --scales one.dat one.dat
expect diff_help 0 "*" "" tecdiff --help
contains diff_help_example "example: tecdiff"

# ---- tecstat ----

expect stat_several_variables 0 "3 / 0.6" "" tecstat full.dat max X disx --zone last
expect stat_max_case_insensitive 0 "3" "" tecstat full.dat max x
expect stat_mean 0 "0.225" "" tecstat full.dat mean disx
expect stat_range 0 "3" "" tecstat full.dat range X
expect stat_sum 0 "4.5" "" tecstat full.dat sum X
expect stat_rms 0 "1.60078105936" "" tecstat full.dat rms X
expect stat_absmax 0 "5" "" tecstat fortran.dat absmax c3
expect stat_first_and_zone 0 "1" "" tecstat full.dat --zone first last X
expect stat_zone_number 0 "2" "" tecstat full.dat --zone 1 count
expect stat_row 0 "1 / 0.2" "" tecstat full.dat row 3 X disx
expect stat_where 0 "2" "" tecstat full.dat --where MAT 2 2 --where X -1e0 2.9 max mat
expect stat_where_last 0 "1" "" tecstat full.dat max X --where mat 2 2 --where X -1e0 2.9
expect stat_no_rows 1 "" "no rows are left of 4" tecstat full.dat --where mat 7 8 max X
expect stat_count_zero 1 "0" "no rows are left" tecstat full.dat --where mat 7 8 count
expect stat_bare_words 0 "3 / 4" "" tecstat curve.dat last engk1 engi1
expect stat_fortran_exponents 0 "1.234e-105 / 0.001 / -5 / 20" "" \
    tecstat fortran.dat first c1 c2 c3 c4
expect stat_nan_propagates 0 "nan / -inf / 2" "" tecstat nan.dat max a b c
expect stat_commas_and_carriage_returns 0 "0.2" "" tecstat commas.dat max disx
# initial X of the rows: 0, 0.4, 0.8, 2.4; (0.6 - 0)/2.4
expect stat_strain 0 "0.25" "" tecstat full.dat strain disx X
# ends with two rows each: displacements 0.1 and 0.3 at 0, -0.2 and 0 at 2: (-0.1 - 0.2)/2
printf 'x u\n.1 .1\n.3 .3\n1.8 -.2\n2 0\n1 0\n' >ends.dat
expect stat_strain_mean_at_ends 0 "-0.15" "" tecstat ends.dat strain u x
# the same everywhere; then a plane with one row of a square of nine, the middle, off by 9: a fit takes 1 of its 9
awk 'BEGIN { print "VARIABLES = \"X\" \"Y\" \"Z\" \"p\" \"q\""; print "ZONE T=\"z\" F=POINT"
    for (j = 0; j < 3; j++) for (i = 0; i < 3; i++) print i, j, 5, 7, 1 + 2 * i - 3 * j + (i == 1 && j == 1 ? 9 : 0) }' >plane.dat
expect stat_rough_level 0 "0" "" tecstat plane.dat rough 9 p
expect stat_rough_middle 0 "2.82842712475" "" tecstat plane.dat rough 9 q
expect stat_rough_several 0 "0 / 2.82842712475" "" tecstat plane.dat rough 9 p q
expect stat_rough_too_few 0 "nan" "" tecstat plane.dat rough 0.5 p
expect stat_rough_reach 2 "" "REACH must be a number above 0, not" tecstat plane.dat rough 0 p
expect stat_rough_no_variable 2 "" "a distance and a variable are needed" tecstat plane.dat rough 1
expect stat_strain_no_length 2 "" "same initial coordinate" tecstat full.dat strain Z Z
# values 1, 2 and 6 at 0, 1 and 2: products -1 0 1 with -2 -1 3
printf 'x v\n0 1\n1 2\n2 6\n' >line.dat
expect stat_slope 0 "2.5" "" tecstat line.dat slope v x
expect stat_slope_of_one_place 2 "" "slope: all rows have the same value" tecstat full.dat slope disx Z
expect stat_slope_of_one_variable 2 "" "two variables are needed after 'slope'" tecstat line.dat slope v
# 3 exp(-0.2 t) cos(2 pi t/0.7) on a slow drift and below quick ripples, at uneven times
awk 'BEGIN { print "t v"; for (i = 0; i <= 1000; ++i) { t = 0.01 * i + 0.003 * sin(i)
    printf "%.9f %.9f\n", t, 3 * exp(-0.2 * t) * cos(8.975979011 * t) + 5 + 0.1 * t + 0.3 * sin(90 * t) } }' >swing.dat
"$tools/tecstat" swing.dat period v t >out 2>err
if awk '{ exit !($1 > 0.6993 && $1 < 0.7007) }' out; then pass stat_period; else reject stat_period "printed $(cat out err)"; fi
"$tools/tecstat" swing.dat decay v t >out 2>err
if awk '{ exit !($1 > 0.198 && $1 < 0.202) }' out; then pass stat_decay; else reject stat_decay "printed $(cat out err)"; fi
expect stat_period_of_few_rows 2 "" "period: needs 8 rows or more whose times grow" tecstat line.dat period v x
expect stat_decay_of_no_time 2 "" "decay: needs 8 rows or more whose times grow" tecstat swing.dat decay t v
expect stat_unknown_variable 2 "" "no variable 'pres'; the file has: X Y Z mat disx" \
    tecstat full.dat max X pres
expect stat_no_such_zone 2 "" "no zone 3, the file has 2" tecstat full.dat --zone 3 max X
expect stat_no_such_row 2 "" "no row 5, there are 4" tecstat full.dat row 5 X
expect stat_unknown_statistic 2 "" "unknown statistic" tecstat full.dat median X
expect stat_help 0 "*" "" tecstat --help
contains stat_help_example "example: tecstat"

# ---- damaged files: a message with the line, never a crash ----

printf '1 2 3\n4 5\n' >columns.dat
expect bad_column_count 2 "" "columns.dat:2: error: the row has 2 columns instead of 3" \
    tecstat columns.dat max c1
printf '1 2 3\n4 5*6 7\n' >token.dat
expect bad_number 2 "" "token.dat:2: error: column 2: '5*6' is not a number" \
    tecstat token.dat max c1
printf '1 1e999\n' >huge.dat
expect bad_number_too_large 2 "" "huge.dat:1: error: column 2: '1e999' is too large" \
    tecstat huge.dat max c1
sed 's/I=     4/I=5/' full.dat >announced.dat
expect bad_announced_rows 2 "" "zone 2 ends after 4 rows, but its header says I=5" \
    tecstat announced.dat max X
sed 's/I=     4/I=3/' full.dat >more.dat
expect bad_more_rows 2 "" "more.dat:18: error: zone 2 has more rows" tecstat more.dat max X
sed '$d' full.dat >cut_row.dat
expect bad_cut_between_rows 2 "" "cut_row.dat:17: error: zone 2 ends after 3 rows" \
    tecstat cut_row.dat max X
printf '1 2\n3 0.1234E+0' >cut_number.dat
expect bad_cut_in_number 2 "" "cut_number.dat:2: error: the last row does not end" \
    tecstat cut_number.dat max c1
sed '/time 0.100E-02/q' bare.dat >cut_zone.dat
expect bad_cut_after_zone 2 "" "cut_zone.dat:6: error: zone 2 has no rows" \
    tecstat cut_zone.dat max X
printf 'VARIABLES= "X"   "Y"   "Z"   "m"pre"s\n1 2 3 4 5\n' >mangled.dat
expect bad_mangled_names 2 "" "mangled.dat:1: error:" tecstat mangled.dat max X
printf 'VARIABLES = X\nZONE I=1, F=BLOCK\n1\n' >block.dat
expect bad_block_form 2 "" "block.dat:2: error: the data must be in POINT form" \
    tecstat block.dat max X
: >empty.dat
expect bad_empty_file 2 "" "empty.dat: error: the file is empty" tecstat empty.dat max X
expect bad_missing_file 2 "" "missing.dat: error: cannot be opened" tecdiff missing.dat one.dat
expect bad_directory 2 "" "error: cannot be read" tecstat . max X
awk 'BEGIN { for (i = 1; i < 4096; ++i) printf "%c%c", (i * 7919) % 251 + 1, i % 256 }' >garbage.dat
expect bad_garbage 2 "" "garbage.dat:1: error:" tecstat garbage.dat max X
printf '\001\002\003\377\000\nabc\n' >binary.dat
expect bad_binary 2 "" "binary.dat:1: error: a zero byte" tecdiff binary.dat binary.dat

# a line far longer than any buffer
awk 'BEGIN { for (i = 0; i < 20000; ++i) printf "%d ", i; print "" }' >long.dat
expect long_line 0 "19999" "" tecstat long.dat max c20000

# every beginning of a file: an answer or an error, no other exit status
size=$(wc -c <full.dat)
length=0
strange=
while [ "$length" -lt "$size" ]; do
    dd if=full.dat of=beginning.dat bs=1 count="$length" 2>/dev/null
    "$tools/tecstat" beginning.dat sum X >out 2>err </dev/null
    status=$?
    if [ "$status" -ne 0 ] && [ "$status" -ne 2 ]; then strange="$strange $length"; fi
    length=$((length + 7))
done
if [ -z "$strange" ]; then pass every_beginning; else
    reject every_beginning "strange exit status for the first$strange bytes"
fi

# ---- tecview: pictures of points ----

# point NAME FILE X Y EXPECTED: the size of a PNG file and the colour of a point
point() {
    found=$("$tools/tests/test_draw" "$2" "$3" "$4" 2>&1)
    if [ "$found" = "$5" ]; then pass "$1"; else
        reject "$1" "point $3 $4 is '$found' instead of '$5'"
    fi
}

printf 'VARIABLES = X Y Z v\nZONE I=1\n1 2 3 5\n' >single.dat
expect view_single 0 "" "" tecview points single.dat --of v --range 0 20 --from top --out single.png
printf 'VARIABLES = X Y Z v\nZONE I=2\n0 0 0 nan\n1 0 0 2\n' >nan.dat
expect view_nan 0 "" "" tecview points nan.dat --of V --from front --out nan.png
expect view_size 0 "" "" tecview points nan.dat --of v --section y=0 --both --size 500x400 \
    --out small.png
if [ -x "$tools/tests/test_draw" ]; then
    # the bar of colours reaches from row 164 (20) to 664 (0): 5 is at 539
    bar=$("$tools/tests/test_draw" single.png 1134 538)
    point view_value_has_the_bar_s_colour single.png 560 370 "$bar"
    point view_margin_is_white single.png 5 5 "1200x800 ffffff"
    case $bar in *ffffff) reject view_bar "the bar is not at 1134 538" ;; *) pass view_bar ;; esac
    # two cubes side by side in the middle of the picture, the left one without a value
    point view_nan_is_grey nan.png 400 370 "1200x800 a5a5a5"
    point view_small small.png 499 399 "500x400 ffffff"
else
    echo "no tests/test_draw beside the tools: points of pictures are not looked at"
fi
if command -v python3 >/dev/null && python3 -c 'import zlib' 2>/dev/null; then
    if python3 - single.png <<'END'
import struct, sys, zlib
data, place, packed, names = open(sys.argv[1], "rb").read(), 8, b"", []
while place < len(data):
    (length,), name = struct.unpack(">I", data[place:place + 4]), data[place + 4:place + 8]
    body = data[place + 8:place + 8 + length]
    assert zlib.crc32(name + body) == struct.unpack(">I", data[place + 8 + length:place + 12 + length])[0]
    names.append(name)
    packed += body if name == b"IDAT" else b""
    place += 12 + length
assert names == [b"IHDR", b"IDAT", b"IEND"] and len(zlib.decompress(packed)) == 800 * (1 + 3 * 1200)
END
    then pass view_png_by_zlib; else reject view_png_by_zlib "python3's zlib does not read it"; fi
else
    echo "no python3: the picture is not read by another program"
fi
expect view_deform 0 "" "" tecview points full.dat --of mat --deform disx,0,0 auto --zone 2 --out deform.png
expect view_where 0 "" "" tecview points full.dat --of disx --where mat 2 2 --out where.png
cmp -s deform.png where.png && reject view_options_matter "two pictures are the same" ||
    pass view_options_matter
expect view_missing_file 2 "" "missing.dat: error: cannot be opened" \
    tecview points missing.dat --of v --out no.png
expect view_unknown_variable 2 "" "no variable 'dixx'; the file has: X Y Z mat disx (nearest: 'disx')" \
    tecview points full.dat --of dixx --out no.png
expect view_no_coordinates 2 "" "no variable 'X'; the file has: t v" \
    tecview points one.dat --of v --out no.png
printf 'VARIABLES = X Y Z v\nZONE I=0\n' >no_rows.dat
expect view_empty_zone 2 "" "no point to draw: the zone has 0 rows" \
    tecview points no_rows.dat --of v --out no.png
expect view_where_nothing 2 "" "no point to draw: the zone has 4 rows" \
    tecview points full.dat --of disx --where mat 7 8 --out no.png
expect view_section_beside 2 "" "no point in the section x=9: the points reach from 0.5 to 1.5" \
    tecview points single.dat --of v --section x=9 --out no.png
expect view_bad_section 2 "" "--section must be like x=0" tecview points single.dat --of v --section q=1 --out no.png
expect view_bad_direction 2 "" "--from must be iso, front" tecview points single.dat --of v --from 0,0,0 --out no.png
expect view_bad_range 2 "" "--range: 3 must be less than 2" tecview points single.dat --of v --range 3 2 --out no.png
expect view_bad_size 2 "" "--size must be like 1200x800" tecview points single.dat --of v --size 10x10 --out no.png
expect view_bad_kind 2 "" "is a .png file, not 'no.svg'" tecview points single.dat --of v --out no.svg
expect view_bad_folder 2 "" "missing/no.png: error: cannot be written" \
    tecview points single.dat --of v --out missing/no.png
expect view_foreign_option 2 "" "'points' has no option '--log'" tecview points single.dat --log x
expect view_missing_operand 2 "" "--range needs LO HI" tecview points single.dat --range 1
expect view_bad_command 2 "" "must be points or curve, not 'draw'" tecview draw single.dat
if [ -e no.png ]; then reject view_no_picture "a picture after a message"; else pass view_no_picture; fi
expect view_help 0 "*" "" tecview --help
contains view_help_example "tecview points"

# ---- tecview: charts ----

# places NAME FILE EXPECTED: the points of the one curve, as parts of its frame from the lower left
places() {
    found=$(tr '\n' ' ' <"$2" | sed 's/<polyline/\n&/g' | awk '
        function read(line, x, y,    n, i, pair, list) {
            sub(/.*points="/, "", line); sub(/".*/, "", line)
            n = split(line, list, " ")
            for (i = 1; i <= n; i++) { split(list[i], pair, ","); x[i] = pair[1]; y[i] = pair[2] }
            return n
        }
        /stroke-width="1.2"/ { read($0, fx, fy) }
        /stroke-width="1.8"/ { n = read($0, x, y) }
        END {
            for (i = 1; i <= n; i++)
                printf "%s%.2f,%.2f", (i > 1 ? " " : ""), (x[i] - fx[1]) / (fx[2] - fx[1]), (fy[3] - y[i]) / (fy[3] - fy[2])
        }')
    if [ "$found" = "$3" ]; then pass "$1"; else
        reject "$1" "'$found' instead of '$3'"
    fi
}

printf 't u\n0 0\n1 30\n4 60\n10 90\n' >line.dat
expect curve_linear 0 "" "" tecview curve line.dat --x t --y u --xrange 0 10 --range 0 120 --out line.svg
places curve_linear_scale line.svg "0.00,0.00 0.10,0.25 0.40,0.50 1.00,0.75"
printf 't u\n1 1000\n10 100\n1000 1\n' >powers.dat
expect curve_log 0 "" "" tecview curve powers.dat --y u --log xy --xrange 1 1e4 --range 0.1 1e4 --out powers.svg
places curve_log_scale powers.svg "0.00,0.80 0.25,0.60 0.75,0.20"
expect curve_log_x 0 "" "" tecview curve powers.dat --y u --log x --xrange 1 1e4 --range 0 1000 --out half.svg
places curve_log_x_scale half.svg "0.00,1.00 0.25,0.10 0.75,0.00"
printf 'scheme time error\napic 1 0.5\n"a & b" 2 0.1\napic 3 0.3\npic 4 nan\npic 5 -1\n' >study.dat
expect curve_pareto 0 "" "tecview: warning: 1 point without a number left out, 1 point not above zero left out" \
    tecview curve study.dat --x time --y error --group scheme --pareto --log xy --unit 's,' --title '<T> m^{2}' --out pareto.svg
for text in '>a &amp; b<' '>apic<' '>Pareto front<' '>time (s)<' '&lt;T&gt; m' '>0.1<' '>1 point without a number'; do
    if grep -F -e "$text" pareto.svg >/dev/null; then pass "curve_text_$text"; else
        reject "curve_text_$text" "not in pareto.svg"
    fi
done
expect curve_two_files 0 "" "" tecview curve line.dat powers.dat --y u --out two.svg
if grep -F -e '>line.dat<' two.svg >/dev/null && grep -F -e '>powers.dat<' two.svg >/dev/null; then
    pass curve_file_names
else
    reject curve_file_names "the legend lacks the files' names"
fi
expect curve_png 0 "" "" tecview curve line.dat --y u --points --out line.png
if [ -x "$tools/tests/test_draw" ]; then point curve_png_margin line.png 3 3 "900x560 ffffff"; fi
if command -v xmllint >/dev/null; then
    for picture in line powers pareto two; do
        if xmllint --noout $picture.svg 2>err; then pass "curve_xml_$picture"; else
            reject "curve_xml_$picture" "$(head -n 1 err)"
        fi
    done
else
    echo "no xmllint: charts are not checked as XML"
fi
expect curve_unknown_variable 2 "" "no variable 'w'; the file has: t u" tecview curve line.dat --y u,w --out no.svg
expect curve_unknown_group 2 "" "no variable 'sceme'; the file has: scheme time error (nearest: 'scheme')" \
    tecview curve study.dat --x time --y error --group sceme --out no.svg
expect curve_nothing 2 "" "no point to draw of 'scheme'" tecview curve study.dat --x time --y scheme --out no.svg
expect curve_bad_log 2 "" "--log must be x, y or xy, not 'z'" tecview curve line.dat --y u --log z --out no.svg
expect curve_bad_range 2 "" "a logarithmic scale begins above 0" tecview curve line.dat --y u --log y --range 0 1 --out no.svg
expect curve_bad_kind 2 "" "--out must end in .png or .svg" tecview curve line.dat --y u --out no.pdf
if [ -e no.svg ]; then reject curve_no_picture "a chart after a message"; else pass curve_no_picture; fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
