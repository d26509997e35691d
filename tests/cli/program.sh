#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The program as a user runs it: exit codes, messages, files. sh tests/cli/program.sh BUILD
build=$(cd "$1" && pwd) || exit 2
root=$(cd "$(dirname "$0")/../.." && pwd) || exit 2
mpm3d=$build/mpm3d
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
failures=0

. "$root/tests/cli/expect.inc"

# deck END_TIME EXTRA...: an elastic block of 64 points; the extra lines go before the end
deck() {
    cat <<END
mpm3d block
nbco 1, nbbo 1
nbmp 64
nmat 1
grid 0 8 0 8 0 8
dcell 1
endt $1
mate
1 elas 1 1 0.3
part bloc 1
1 1 0.5 2 2 2 4 4 4
tecp
outr velx
curv velx 1
velo
body 1 0.01 0 0
endv
END
    shift
    for line in "$@"; do printf '%s\n' "$line"; done
    echo endi
}

deck 1 >good.mpm
expect "no deck" 1 "no deck given" "$mpm3d"
expect "unknown option" 1 "unknown option '--fast'" "$mpm3d" --fast good.mpm
expect "two decks" 1 "more than one deck" "$mpm3d" good.mpm good.mpm
expect "no number of threads" 1 "not a number of threads" "$mpm3d" --threads none good.mpm
expect "zero threads" 1 "not a number of threads" "$mpm3d" --threads 0 good.mpm
expect "option without value" 1 "has to follow '-o'" "$mpm3d" good.mpm -o
expect "version" 0 "^mpm3d [0-9]" "$mpm3d" --version
expect "help" 0 "Background grid" "$mpm3d" --help
expect "help of a word" 0 "boundary codes" "$mpm3d" --help fixed
expect "help of a law" 0 "tangent *number, stress, 0 or more" "$mpm3d" --help pla2
expect "help of a result" 0 "von Mises" "$mpm3d" --help seqv
expect "help of a generator" 0 "radius *number, length, greater than 0" "$mpm3d" --help cyli
expect "help of a misspelt word" 1 "did you mean 'dcel'" "$mpm3d" --help dcll
expect "missing deck" 4 "cannot read 'none.mpm': No such file" "$mpm3d" none.mpm
expect "folder as deck" 4 "cannot read '.': Is a directory" "$mpm3d" .
expect "check" 0 "64 particles in 1 bodies" "$mpm3d" --check good.mpm
check "check writes no file" test ! -e good.out
expect "run" 0 "no particle lost" "$mpm3d" good.mpm
for file in good.out good_anim.dat good_curv.dat good_energy.dat good_momentum.dat; do
    check "writes $file" test -s "$file"
done
expect "deck name without .mpm" 0 "no particle lost" "$mpm3d" good
check "quiet run" sh -c '"$1" --quiet good.mpm >said 2>&1 && ! test -s said' - "$mpm3d"
check "data does not go to the terminal" sh -c '"$1" good.mpm 2>/dev/null >said && ! test -s said' - "$mpm3d"
expect "deck in a folder with a dot" 0 "no particle lost" sh -c 'mkdir -p a.b && cp good.mpm a.b/x.y.mpm && "$1" ./a.b/x.y.mpm && test -s x.y_anim.dat' - "$mpm3d"
expect "standard input" 0 "no particle lost" sh -c '"$1" - <good.mpm && cmp stdin_anim.dat good_anim.dat' - "$mpm3d"
expect "output folder" 0 "no particle lost" sh -c '"$1" -o new good.mpm && cmp new/good_anim.dat good_anim.dat' - "$mpm3d"
expect "output folder in a missing one" 4 "cannot create the folder" "$mpm3d" -o none/new good.mpm
expect "output folder that is a file" 4 "cannot create" "$mpm3d" -o good.mpm good.mpm

# the log starts with a deck that gives the same run
sed -n '2,/^endi/p' good.out >again.mpm
expect "the log's deck can be run" 0 "no particle lost" "$mpm3d" again.mpm
check "the log's deck gives the same" cmp again_anim.dat good_anim.dat

# a solid too, with its file, from another folder
expect "solids" 0 "no particle lost" "$mpm3d" -o solid "$root/tests/decks/coverage/solid_shapes.mpm"
sed -n '2,/^endi/p' solid/solid_shapes.out >solid_again.mpm
expect "the log's solids can be run" 0 "no particle lost" "$mpm3d" solid_again.mpm
check "the log's solids are the same" cmp solid_again_anim.dat solid/solid_shapes_anim.dat
expect "help of a solid" 0 "cut   takes the points inside a shape away" "$mpm3d" --help solid

deck 1 "names mpm3d" "head mpm3d" "digits 4" >bare.mpm
expect "bare names" 0 "no particle lost" "$mpm3d" bare.mpm
check "EnergyPlot.dat" test -s EnergyPlot.dat
check "MomentumPlot.dat" test -s MomentumPlot.dat
check "ContforcPlot.dat is there, empty" sh -c 'test -e ContforcPlot.dat && ! test -s ContforcPlot.dat'
check "E12.4 numbers" grep -q '^  0.2250E+01  0.2250E+01  0.2250E+01  1  0.1000E-01$' bare_anim.dat
check "bare zone" grep -q '^ZONE T="time  0.000E+00"$' bare_anim.dat
check "bare curve header" grep -q '^Time engk1       engi1       velx1       $' bare_curv.dat
check "tecdiff reads both styles" "$build/tecdiff" -r 1e-3 bare_anim.dat good_anim.dat

# --error: the last state against a file of the program's own
cp good_anim.dat same.dat
expect "error against itself" 0 "velx  *0.000000E+00  0.000000E+00" "$mpm3d" --quiet --error same.dat good.mpm
check "the log has it too" grep -q "error against the last zone of same.dat, 64 rows" good.out
check "beside its run time" grep -q "^run time [0-9.]* s, [0-9]* steps, [0-9.]* ns per particle-step" good.out
# velx of the reference: 0.01 in one half, 0.03 in the other; the run has 0.01 in all: L2 0.02 sqrt(1/2), max 0.02, of 0.02
awk '/^ZONE/ { n = 0; print; next } /^[A-Z]/ { print; next } { n++; print $1, $2, $3, $4, (n > 32 ? 0.03 : 0.01) }' same.dat >half.dat
sed 's/^1 elas 1 1/1 elas 1 1e-3/' good.mpm >soft.mpm
expect "error in parts of the range" 0 "velx  *7.07106.E-01  1.000000E+00  2.000000E-02" "$mpm3d" --error half.dat soft.mpm
expect "a reference of the other style" 0 "velx" "$mpm3d" --error bare_anim.dat good.mpm
sed '$d' same.dat >cut.dat
expect "cut reference" 4 "'cut.dat' is cut: its last zone has 63 rows of 64" "$mpm3d" --error cut.dat good.mpm
sed '7s/.*/1 2 3/' same.dat >damaged.dat
expect "damaged reference" 4 "damaged.dat:7: not a line" "$mpm3d" --error damaged.dat good.mpm
expect "missing reference" 4 "cannot read 'none.dat'" "$mpm3d" --error none.dat good.mpm
sed 's/I=64, //; $d' same.dat >fewer.dat
expect "reference of fewer particles" 1 "the run ends with 64 particles to show, the last zone of 'fewer.dat' has 63" "$mpm3d" --error fewer.dat good.mpm
{ sed 's/I=64, //' same.dat; tail -n 1 same.dat; } >more.dat
expect "reference of more particles" 1 "'more.dat' has 65 rows, the deck only 64" "$mpm3d" --error more.dat good.mpm
sed 's/"X" "Y" "Z" "mat" "velx"/"A" "B" "C" "D" "E"/' same.dat >names.dat
expect "reference of other names" 1 "no variable of the deck's outr" "$mpm3d" --error names.dat good.mpm
grep -v tecp good.mpm >silent.mpm
expect "error without tecp" 1 "the deck has no tecp" "$mpm3d" --error same.dat silent.mpm
expect "error without a file" 1 "has to follow '--error'" "$mpm3d" good.mpm --error

# a full disk, a folder that can't be written
mkdir -p full && ln -sf /dev/full full/good_anim.dat
if [ -e /dev/full ]; then
    expect "full disk" 4 "cannot write 'full/good_anim.dat': No space" "$mpm3d" -o full good.mpm
    mkdir -p full2 && ln -sf /dev/full full2/good_energy.dat
    expect "full disk, energies" 4 "cannot write 'full2/good_energy.dat': No space" "$mpm3d" -o full2 good.mpm
fi

# signals: the run ends after its step, with a summary
deck 1e9 "outt 1e8" "sort off" >long.mpm
sh -c '"$1" long.mpm 2>said & pid=$!; sleep 1; kill -INT $pid; wait $pid; echo $? >status' - "$mpm3d"
check "SIGINT ends with status 130" sh -c 'cat status said; test "$(cat status)" = 130'
check "SIGINT leaves a summary" grep -q "interrupted after [0-9]* steps" said
check "SIGINT leaves whole files" "$build/tecstat" long_energy.dat count
sh -c '"$1" long.mpm 2>said & pid=$!; sleep 1; kill -TERM $pid; wait $pid; echo $? >status' - "$mpm3d"
check "SIGTERM ends with status 130" sh -c 'test "$(cat status)" = 130'

# extreme scenes: right, or stopped with step, time and particle
deck 100 "dtsc 2.5" "velo" "node 1 0.1 0.05 0" "endv" >unstable.mpm
expect "dtsc 2.5" 3 "is stopped at step [0-9]*, time [0-9.E+-]*: " "$mpm3d" unstable.mpm
expect "dtsc 2.5 names the particle" 3 "particle [0-9]* of body 1, law elas, at .*, cell [0-9]* [0-9]* [0-9]*$" "$mpm3d" unstable.mpm
check "the last good output is kept" "$build/tecstat" unstable_anim.dat max velx
deck 200 "velo" "body 1 0.5 0.3 0.2" "endv" >leaves.mpm
expect "body leaves the grid" 0 "64 particles left the grid and are frozen (first ids:" "$mpm3d" leaves.mpm

# points FILE LINES...: a deck of single points of mass 1/8
points() {
    n=$(($#))
    printf 'mpm3d points\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\ngrid 0 4 0 4 0 4\ndcell 1\nendt 1\nfixe 2 2 2 2 2 2\nmate\n1 elas 1 1 0.3\n' $n
    printf 'part poin 1 %d\n' $n
    i=0
    for point in "$@"; do i=$((i + 1)); echo "$i 1 0.125 $point"; done
    printf 'tecp\noutr velx outr vely\nvelo\nbody 1 0.125 0.0625 0\nendv\nendi\n'
}
points "1.5 1.5 1.5" >one.mpm
expect "a body of one point" 0 "no particle lost" "$mpm3d" one.mpm
check "it keeps its velocity" sh -c 'test "$("$1/tecstat" one_anim.dat first velx)" = 0.125' - "$build"
points "2 1.5 1.5" "2 2 1.5" "2 2 2" >nodes.mpm
expect "points on a face, an edge, a node" 0 "no particle lost" "$mpm3d" nodes.mpm
points "4 1.5 1.5" "1 1 1" >upper.mpm
expect "a point on the upper face of the grid" 0 "no particle lost" "$mpm3d" upper.mpm
check "it is held by the face" sh -c 'test "$("$1/tecstat" upper_anim.dat first X)" = 4' - "$build"
points "9 9 9" "1.5 1.5 1.5" >outside.mpm
expect "a point outside the grid" 0 "1 particles left the grid and are frozen (first ids: 1; the first at 9 9 9)" "$mpm3d" outside.mpm
check "it is not in later output" sh -c 'test "$("$1/tecstat" outside_anim.dat count)" = 1' - "$build"
points "9 9 9" >nothing.mpm
expect "no point in the grid" 0 "1 particles left the grid" "$mpm3d" nothing.mpm
# a point that leaves in the step before a dump had a cell in it and is shown once more
points "3.99 1.5 1.5" "1.5 1.5 1.5" | sed 's/^fixe.*/fixe 0 0 0 0 0 0 outt 0.1/; s/^body 1.*/body 1 0.25 0 0/' >leaving.mpm
expect "a point that leaves" 0 "1 particles left the grid" "$mpm3d" leaving.mpm
check "it is shown at the end of its last step" sh -c 'test "$("$1/tecstat" leaving_anim.dat --zone 2 count)" = 2' - "$build"
check "it is not shown later" sh -c 'test "$("$1/tecstat" leaving_anim.dat --zone 3 count)" = 1' - "$build"
# as in the reference, outr adds its column to the first ones, also mat
sed 's/^outr .*/outr mat outr velx outr mat/' one.mpm >columns.mpm
expect "mat twice" 0 "no particle lost" "$mpm3d" columns.mpm
check "each has its column" sh -c 'test "$(tail -n 1 columns_anim.dat | wc -w)" = 7' -
# gimp and smoo near a face: what would go to nodes outside the grid is dropped (spec 7.2, 9.6)
points "3.9 1.5 1.5" "3.9 1.5 1.5" |
    sed 's/^1 elas.*/1 sjc 1 1 0.3 1 0 1 0 1\nseos 1 1 2 0 0 0 0 0 0 0/; s/^tecp/gimp para ascii smoo dtsc 1e-6 endt 0 tecp/; s/^body 1.*/body 1 0 0 0/' >smoothed.mpm
expect "smoothed pressure at a face" 0 "no particle lost" "$mpm3d" smoothed.mpm
check "weights inside the grid times pressure: 2 (0.855 + 0.1225)" awk '/<DataArray/ { wait = /"Smoothpressure"/ } wait && /^[0-9]/ { n++; if ($1 < 1.95499 || $1 > 1.95501) exit 1 } END { if (n != 2) exit 1 }' smoothed_anim_2.vtu
points "1.0000000000001 1.5 1.5" "0.9999999999999 1.5 1.5" >tiny.mpm
expect "nodes of nearly no mass" 0 "no particle lost" "$mpm3d" tiny.mpm
exit $failures
