#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Parts that are built up: the same bits with 1, 2 and 5 threads, unsorted, and from the deck in the log, which
# can be run again. Closed particles are in no file unless `ghos show` is given. sh tests/property/building.sh BUILD
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
failed=0

# report NAME BAD: ok when BAD is empty
report() { if [ -z "$2" ]; then echo "ok $1"; else echo "FAIL $1:$2"; failed=1; fi; }

# differing FOLDER: the files of a run in FOLDER that are not those of the run in `one`
differing() {
    for file in one/*; do
        case $file in *.out) continue ;; esac
        cmp -s "$file" "$1/${file#one/}" || printf ' %s' "${file#one/}"
    done
}

# run FOLDER THREADS DECK: a run into FOLDER; its exit status when it is bad
run() { rm -rf "$1"; mkdir "$1"; "$build/mpm3d" --quiet --threads "$2" -o "$1" "$3" 2>messages || printf ' status %s' $?; }

# all_ways NAME: the deck job.mpm in every way
all_ways() {
    report "$1 runs" "$(run one 1 job.mpm)"
    for threads in 2 5; do
        report "$1 with $threads threads" "$(run many $threads job.mpm; differing many)"
    done
    mkdir -p unsorted_deck again_deck
    sed 's/^endi/sort off endi/' job.mpm >unsorted_deck/job.mpm
    report "$1 unsorted" "$(run unsorted 2 unsorted_deck/job.mpm; differing unsorted)"
    sed -n '2,/^endi/p' one/job.out >again_deck/job.mpm
    report "$1 from its log" "$(run again 2 again_deck/job.mpm; differing again)"
}

# --- by points, with everything that comes along; several blocks, fast enough to be sorted ---
cat >job.mpm <<'END'
mpm3d points
nbco 1
nbbo 2
nbmp 864
nmat 2
grid -0.4 2.4 -0.4 2.4 -0.4 2.4
dcel 0.2
musl on
digits 17
jaum off
mate
1 elas 4.5e-3 115000 0.34
2 pla2 6.0e-3 80000 0.30 300 1000
part bloc 1
1 4.5e-3 0.1 0 0 0 12 12 3
part bloc 1
2 6.0e-3 0.1 0 0 0.3 12 12 3
Ghost
GPD 1 200 1
GPD 14 0
GPD 860 0
endG
scan raster serpentine 0 45 30
resi 1 -500 -200 10
resi 2 -300 0 0
phas 2 0.995 1
ther 1 1e-5 1200 0.25 cool
ther 2 2e-5 900 0.31
mscl 25
ndam 0.5
open group 23 every 3
open until 855
open settle 40
velo
body 1 300 100 0
body 2 300 100 0
endv
endt 1 outt 1e-3
tecp
para ascii
outr seqv outr seqt outr laye outr ghos outr stsx outr stxy outr stsz outr disx
curv seqv 500
endi
END
all_ways "points"
sed 's/^musl on/usf on gimp/' job.mpm >next.mpm && mv next.mpm job.mpm
all_ways "points, usf, gimp"

# --- by layers along x between held nodes, with contact and smoothed pressure, all particles written ---
cat >job.mpm <<'END'
mpm3d layers
nbco 2
nbbo 2
nbmp 486
nmat 2
grid -0.4 2.4 -0.4 2.4 -0.4 2.4
dcel 0.2
usf on
digits 17
mate
1 elas 4.5e-3 115000 0.34
2 elas 6.0e-3 80000 0.30
part bloc 1
1 4.5e-3 0.1 0 0 0 9 9 3
part bloc 2
2 6.0e-3 0.1 0 0 0.3 9 9 3
cont lagr 0.1 0
Ghost endG
ghos show
buil x 0.3
open layer every 7
open settle 20
scan 10 100
resi 1 -500 -200 0
fixn -9 9 -9 9 0 0 0 0 1
fixn cyli z 0.4 0.4 0 0.21 1 1 0
dtfx 4e-6
ndam 2
drda
endt 1 outt 2e-5
tecp
para ascii
smoo
outr seqv outr seqt outr laye outr ghos outr stsx outr velx
endi
END
all_ways "layers"
sed 's/^usf on/usl on/; s/^cont.*/sgmp/; s/^open layer.*/open all/; s/^scan.*//' job.mpm >next.mpm && mv next.mpm job.mpm
all_ways "all at once, usl, sgmp"

# --- in balance after each opening ---
cp "$here/equilibria.mpm" job.mpm
all_ways "quas by layers"
sed 's/^endi/smal endi/' job.mpm >next.mpm && mv next.mpm job.mpm
all_ways "quas by layers, small displacements"
sed 's/^open layer.*/open group 144 every 1 ther 1 1e-5 300 0.25/' job.mpm >next.mpm && mv next.mpm job.mpm
all_ways "quas by groups, hot zone"

# --- what files show ---
cat >job.mpm <<'END'
mpm3d shown
nbco 1
nbbo 1
nbmp 27
nmat 1
grid -0.4 1 -0.4 1 -0.4 1
dcel 0.2
mate
1 elas 4.5e-3 115000 0.34
part bloc 1
1 4.5e-3 0.1 0 0 0 3 3 3
Ghost
GPD 2 1
GPD 5 6 1
endG
open group 4 every 2
open settle 0
open until 9
dtfx 1e-6
outt 1e-6
tecp
para ascii
outr ghos outr laye
endi
END
run one 1 job.mpm
rows=$(awk '/^ZONE/ { if (z++) printf "%d ", n; n = 0; next } z { n++ } END { printf "%d", n }' one/job_anim.dat)
report "rows of the animation file" "$([ "$rows" = "3 7 7 9" ] || echo " $rows")"
points=$(sed -n 's/.*NumberOfPoints="\([0-9]*\)".*/\1/p' one/job_anim_*.vtu | tr '\n' ' ')
report "points of the vtk files" "$([ "$points" = "3 7 7 9 " ] || echo " $points")"
sed -i.bak 's/^endi/ghos show endi/' job.mpm
run one 1 job.mpm
open=$(awk '/^ZONE/ { if (z++) printf "%d ", n; n = 0; next } z { n += $5 } END { printf "%d", n }' one/job_anim.dat)
report "closed particles are written with ghos show" "$([ "$open $(grep -c '^ZONE.*I=27' one/job_anim.dat)" = "3 7 7 9 4" ] || echo " $open")"
points=$(sed -n 's/.*NumberOfPoints="\([0-9]*\)".*/\1/p' one/job_anim_*.vtu | tr '\n' ' ')
report "and in vtk files" "$([ "$points" = "27 27 27 27 " ] || echo " $points")"
exit $failed
