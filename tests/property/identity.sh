#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The same bits on any number of threads and with sorting on or off: all files of a run with 1, 2, 3,
# 7 threads must agree byte for byte, for each scheme and for the wide shape functions. sh tests/property/identity.sh BUILD
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
failed=0
for scheme in usf usl musl gimp bimp; do
    # usl is unstable at the nodes of small mass that points leave behind: fewer steps
    end="s/^endt.*/endt 0.03 outt 0.015/"
    [ $scheme = usl ] && end="s/^endt.*/endt 0.003 outt 0.0015/"
    words="s/^musl on/$scheme on/"
    case $scheme in
    gimp | bimp) words="s/^musl on/musl on $scheme/; /^face/d" ;; # tractions don't go with them
    esac
    sed "$words; $end" "$here/identity.mpm" >job.mpm
    sed 's/^tecp/sort off\ntecp/' job.mpm >unsorted.mpm
    "$build/mpm3d" --quiet --threads 1 -o one job.mpm || { echo "FAIL $scheme: exit status $?"; failed=1; continue; }
    for threads in 2 3 7; do
        "$build/mpm3d" --quiet --threads $threads -o many job.mpm
        for file in job_anim.dat job_curv.dat job_energy.dat job_momentum.dat; do
            if "$build/tecdiff" one/$file many/$file && cmp -s one/$file many/$file; then
                echo "ok $scheme $file with $threads threads"
            else
                echo "FAIL $scheme $file differs with $threads threads"; failed=1
            fi
        done
    done
    for threads in 1 3; do
        "$build/mpm3d" --quiet --threads $threads -o unsorted unsorted.mpm
        for ending in anim curv energy momentum; do
            if cmp -s one/job_$ending.dat unsorted/unsorted_$ending.dat; then
                echo "ok $scheme $ending unsorted with $threads threads"
            else
                echo "FAIL $scheme $ending differs unsorted with $threads threads"; failed=1
            fi
        done
    done
done
exit $failed
