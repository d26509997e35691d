#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The same bits with 1, 2 and 5 threads, and unsorted, for every deck of tests/decks/reference, which
# between them use every law, shape function and feature: sh tests/property/reference_identity.sh BUILD
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")/../decks/reference" && pwd)
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
failed=0
for deck in "$here"/*.mpm; do
    job=$(basename "$deck" .mpm)
    # the slow one is long enough after a tenth of its time
    sed 's/^endt 0.001205/endt 0.0001/; s/^outt 0.001205.*/outt 0.0001/' "$deck" >"$job.mpm"
    "$build/mpm3d" --quiet --threads 1 -o one "$job.mpm" || { echo "FAIL $job: exit status $?"; failed=1; continue; }
    for threads in 2 5; do
        "$build/mpm3d" --quiet --threads $threads -o many "$job.mpm"
        for file in one/"$job"_*; do
            name=$(basename "$file")
            cmp -s "$file" "many/$name" || { echo "FAIL $name differs with $threads threads"; failed=1; }
        done
    done
    sed 's/^sort on.*/sort off/' "$job.mpm" >"$job.unsorted" && mv "$job.unsorted" "$job.mpm"
    "$build/mpm3d" --quiet --threads 2 -o unsorted "$job.mpm"
    for file in one/"$job"_*; do
        name=$(basename "$file")
        cmp -s "$file" "unsorted/$name" || { echo "FAIL $name differs unsorted"; failed=1; }
    done
    echo "ok $job"
done
exit $failed
