#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The ParaView files, text and binary, opened with VTK's own reader and compared with the animation
# file. Skipped where no python3 has VTK (Debian: python3-vtk9). sh tests/cli/vtk.sh BUILD
build=$(cd "$1" && pwd) || exit 2
tool=$(cd "$(dirname "$0")/../../tools" && pwd)/check_vtk.py
bed=$(cd "$(dirname "$0")/../decks/coverage" && pwd)/sph_bed.mpm
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
python=
for name in python3 /usr/bin/python3; do
    [ "$python" ] || ! $name -c 'import vtkmodules.vtkIOXML' 2>/dev/null || python=$name
done
[ "$python" ] || { echo "skip ParaView files in VTK's reader: no python3 with VTK here"; exit 0; }
failed=0

# check NAME COMMAND...: the command must succeed
check() {
    name=$1; shift
    if "$@" >printed 2>&1; then echo "ok $name"; else echo "FAIL $name"; sed 's/^/    /' printed | head -n 20; failed=1; fi
}

for form in ascii binary; do
    cat >$form.mpm <<END
mpm3d two bodies for ParaView, $form
nbco 1, nbbo 2
nbmp 72
nmat 2
grid 0 4 0 3 0 2
dcell 1
fixe 2 0 2 0 2 0
endt 0.004 outt 0.001
digits 12
mate
1 pla2 4.0e-3 2.0e4 0.25 10 200
2 neoh 2.0e-3 4.0e3 0.3
part bloc 1
1 4.0e-3 0.5 0 0 0 4 4 4
part bloc 1
2 2.0e-3 0.5 2.5 1 0 2 2 2
velo
body 1 30 20 10
body 2 -20 0 5
endv
tecp
outr seqv outr epef outr pres outr volu outr velx outr vely outr velz outr disx outr disy outr disz
outr cels outr damg outr stsx outr stsy outr stsz outr styz outr stxz outr stxy
smoo
para $form
endi
END
    check "$form: runs" "$build/mpm3d" --quiet $form.mpm
    check "$form: all values as in the animation file" "$python" "$tool" ${form}_anim.pvd ${form}_anim.dat
    check "$form: 72 points, 72 cells, 27 arrays" "$python" "$tool" ${form}_anim_2.vtu 72 72 27
    check "$form: grid of 60 nodes and 24 cells" "$python" "$tool" ${form}_Grid.vtu 60 24 0
done
for form in ascii binary; do
    { grep -v endinput "$bed"; printf 'outr stat outr pres outr liqu\npara %s\nendi\n' $form; } >bed.mpm
    check "smoothed particles, $form: runs" "$build/mpm3d" --quiet bed.mpm
    check "smoothed particles, $form: all values as in the animation file" "$python" "$tool" bed_anim.pvd bed_anim.dat
    check "smoothed particles, $form: 16 arrays, eight particles removed" "$python" "$tool" bed_anim_2.vtu 872 872 16
done
check "smoothed particles have no background grid" [ ! -e bed_Grid.vtu ]
check "binary data is appended" grep -q '<AppendedData' binary_anim_1.vtu
check "text data is not" sh -c '! grep -q "<AppendedData" ascii_anim_1.vtu'
sed 's/Name="vx"/Name="vy"/' ascii_anim_1.vtu >twice.vtu
check "an array that stands twice is found" sh -c '! "$1" "$2" twice.vtu 72 72 27' - "$python" "$tool"
awk '/<DataArray.*"pressure"/ { wait = 1 } wait && /^[-0-9]/ { $0 = "9"; wait = 0 } { print }' ascii_anim_5.vtu >changed.vtu
cp changed.vtu ascii_anim_5.vtu
check "a changed value is found" sh -c '! "$1" "$2" ascii_anim.pvd ascii_anim.dat && grep -q "array pressure" printed' - "$python" "$tool"
exit $failed
