#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Reproducing kernel particles in motion: the same bits on 1, 2 and 5 threads, with both kernels, in two and three dimensions, in flight
# and in contact; and a run that goes on from a checkpoint, before and after a wall has let the body go, is the same as the whole one.
# sh tests/property/rkpm.sh BUILD
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
failed=0

# same NAME FOLDER FOLDER: all tables, byte for byte, and that there is contact: some force of the wall
same() {
    for ending in anim curv energy momentum; do
        cmp -s "$2/job_$ending.dat" "$3/job_$ending.dat" || { echo "FAIL $1: job_$ending.dat differs"; failed=1; return; }
    done
    echo "ok $1"
}

# touches NAME: a test that never meets the wall would show nothing
touches() {
    force=$("$build/tecstat" one/job_curv.dat max wall)
    echo "$force" | awk -v name="$1" '{ if ($1 > 0) print "ok " name ": the wall is met"; else { print "FAIL " name ": no force of the wall"; exit 1 } }' || failed=1
}

# The drop stands just above the wall, with enough nodes for several threads; few steps.
for deck in drop_nsni_half oldroyd_half contact_half oldroyd_ball_1mm; do
    sed 's/disc 0 0.04 /disc 0 0.0106 /; s/sphere 0 0.04 /sphere 0 0.0106 /; s/^endt.*/endt 1.0e-3/; s/^dtfx.*/dtfx 2.5e-5/; s/^outtime.*/outt 5e-4/' \
        "$here/../decks/rkpm/$deck.mpm" >job.mpm
    "$build/mpm3d" --quiet --threads 1 -o one job.mpm || { echo "FAIL $deck: exit status $?"; failed=1; continue; }
    touches "$deck"
    for threads in 2 5; do
        "$build/mpm3d" --quiet --threads $threads -o many job.mpm
        same "$deck with $threads threads" one many
    done
done

# goes_on NAME TIME: whole.mpm, stopped then and taken up from the checkpoint, is the run `one`
goes_on() {
    sed "s/^endt.*/endt $2/; s/^endi/rest every 100000 steps\nendi/" whole.mpm >job.mpm
    rm -rf part
    "$build/mpm3d" --quiet -o part job.mpm
    cp whole.mpm job.mpm
    "$build/mpm3d" --quiet --restart part/job.rest job.mpm
    same "$1" one part
}

# Contact from 0.0262 on; the wall lets go before 0.036, and the drop flies off.
sed 's/^dtfx.*/dtfx 1e-4/; s/^outtime.*/outt 2e-3/' "$here/../decks/rkpm/contact_2mm.mpm" >whole.mpm
cp whole.mpm job.mpm
"$build/mpm3d" --quiet --threads 1 -o one job.mpm || { echo "FAIL contact_2mm: exit status $?"; failed=1; }
for time in 0.027 0.0345 0.04; do
    goes_on "restart at $time" "$time"
done
touches contact_2mm
# after 0.045 the wall has let go: no force at all, though the supports still reach it
"$build/tecstat" one/job_curv.dat --where Time 0.045 1 absmax wall |
    awk '{ if ($1 == 0) print "ok the wall has let go"; else { print "FAIL the wall has not let go: " $1; exit 1 } }' || failed=1

# Layers: the second is there from the first step on, the third opens in step 21; restart before and after it.
sed 's/^endt.*/endt 0.0015/; s/^outtime.*/outt 5e-4/; s/^open.*/open layer every 20/' "$here/../decks/rkpm/deposition.mpm" >whole.mpm
cp whole.mpm job.mpm
"$build/mpm3d" --quiet --threads 1 -o one job.mpm || { echo "FAIL deposition: exit status $?"; failed=1; }
touches deposition
for threads in 2 5; do
    "$build/mpm3d" --quiet --threads $threads -o many job.mpm
    same "deposition with $threads threads" one many
done
for time in 3e-4 9e-4; do
    goes_on "deposition: restart at $time" "$time"
done
grep -c . one/job_anim.dat | awk '{ if ($1 == 2 + 3 * 1 + 32 + 64 + 96) print "ok layers opened"; else { print "FAIL layers did not open: " $1; exit 1 } }' || failed=1
exit $failed
