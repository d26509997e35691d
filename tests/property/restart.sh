#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A run that goes on from a checkpoint writes the same files, byte for byte, as one without a break: decks that
# between them have all kinds of state, at three points, with other numbers of threads, sorted and not.
# sh tests/property/restart.sh BUILD
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")/.." && pwd)
mpm3d=$build/mpm3d
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
failed=0

# deck END_TIME SORT LINES...: job.mpm from `base`, with another end and sorting, and lines before its end
deck() {
    grep -viE '^(endi|sort|rptt|outt|endt|rest|open settle)' base >job.mpm
    printf '%s\n' "endt $1 outt $interval" "sort $2" >>job.mpm
    shift 2
    printf '%s\n' "$@" endi >>job.mpm
}

# same NAME FOLDER: all files but the log
same() {
    for file in whole/*; do
        case $file in
        *.out) ;;
        *) cmp "$file" "$2/$(basename "$file")" >&2 || { echo "FAIL $1: ${file#whole/} differs"; failed=1; return 1; } ;;
        esac
    done
    echo "ok $1"
}

# stop NAME END THREADS SORT THREADS SORT: a run that ends early with a checkpoint, and one that goes on from there
stop() {
    rm -rf part
    deck "$2" "$4" "$extra" "rest every 1000000 steps"
    "$mpm3d" --quiet --threads "$3" -o part job.mpm || { echo "FAIL $1: exit status $?"; failed=1; return; }
    deck "$end_time" "$6" "$extra"
    "$mpm3d" --quiet --threads "$5" --restart part/job.rest job.mpm || { echo "FAIL $1: restart has exit status $?"; failed=1; return; }
    grep -q "^Restarted from 'part/job.rest' at step" part/job.out || { echo "FAIL $1: the log is silent"; failed=1; return; }
    same "$1" part
}

# check DECK END_TIME INTERVAL EXTRA
check() {
    name=$(basename "$1" .mpm) end_time=$2 interval=$3 extra=$4
    cp "$here/$1" base
    rm -rf whole
    deck "$end_time" on "$extra"
    "$mpm3d" --quiet --threads 1 -o whole job.mpm || { echo "FAIL $name: exit status $?"; failed=1; return; }
    stop "$name early" "$(echo "$end_time" | awk '{ print $1 * 0.17 }')" 1 on 2 off
    stop "$name in the middle" "$(echo "$end_time" | awk '{ print $1 * 0.5 }')" 2 off 1 on
    stop "$name late" "$(echo "$end_time" | awk '{ print $1 * 0.83 }')" 3 on 2 on
}

check property/identity.mpm 0.02 0.01 "lost keep write"
check decks/reference/contact_friction.mpm 0.2 0.03 "para binary smoo"
check decks/coverage/lost_keep.mpm 0.2 0.03 "gimp"
check decks/reference/beam_sgtl.mpm 0.08 0.03 "para"
check decks/reference/deto_1d.mpm 1e-4 2e-5 ""
check decks/coverage/build_points.mpm 0.04 0.01 "drda"
check decks/coverage/build_layers.mpm 0.04 0.01 "para"
check property/restart.mpm 0.06 0.01 ""

# the checkpoint before the last one; of a run that ends by its schedule
cp "$here/decks/coverage/build_points.mpm" job.mpm
rm -rf whole part
"$mpm3d" --quiet -o whole job.mpm && "$mpm3d" --quiet -o part job.mpm
"$mpm3d" --quiet --restart part/job.rest.old job.mpm || { echo "FAIL the one before: exit status $?"; failed=1; }
rm -f whole/job.rest* part/job.rest*
same "the checkpoint before the last" part

# static equilibrium, which takes no notice of endt: from the checkpoint before the last one
sed 's/^endi/rest every 2 steps endi/' "$here/property/equilibria.mpm" >job.mpm
for extra in "" smal "open group 144 every 1 ther 1 1e-5 300 0.25"; do
    if [ "${extra#open}" != "$extra" ]; then sed -i 's/^open layer.*//' job.mpm; fi
    sed -i "s/endi\$/$extra endi/" job.mpm
    rm -rf whole part
    "$mpm3d" --quiet --threads 1 -o whole job.mpm 2>/dev/null && "$mpm3d" --quiet --threads 1 -o part job.mpm 2>/dev/null
    "$mpm3d" --quiet --threads 2 --restart part/job.rest.old job.mpm 2>/dev/null || { echo "FAIL quas $extra: exit status $?"; failed=1; }
    rm -f whole/job.rest* part/job.rest*
    same "equilibria $extra from the checkpoint before the last" part
done
exit $failed
