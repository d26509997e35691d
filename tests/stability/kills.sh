#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs that are killed at random moments, most of them near a checkpoint, and go on: in the end all files have to be those of
# a run that nobody disturbed, byte for byte. Then disks of 2 MB that fill up. sh tests/stability/kills.sh BUILD
#   KILLS=300   how many kills          SEED=1   of their moments
# In memory (/dev/shm) where there is one: a checkpoint is brought to the disk before it gets its name.
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")/.." && pwd)
mpm3d=$build/mpm3d
kills=${KILLS:-300} seed=${SEED:-1}
folder=$(TMPDIR=$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}") mktemp -d) || exit 2
disk=$folder/disk
tidy() {
    mountpoint -q "$disk" 2>/dev/null && umount "$disk"
    rm -rf "$folder"
}
trap tidy EXIT
trap 'exit 1' INT TERM
cd "$folder" || exit 2
failed=0 hits=0 in_write=0 from_old=0 from_start=0 identical=0 rounds=0

# A new random number from 0 to $1 - 1 in $random; the same ones for the same SEED.
draw() {
    seed=$(((seed * 1103515245 + 12345) % 2147483648))
    random=$((seed / 65536 % $1))
}

# deck DECK LINES: job.mpm with a checkpoint every two steps
deck() {
    sed 's/^\(endi\)/rest every 2 steps '"$2"'\n\1/I' "$here/$1" >job.mpm
}

# A run in the background, killed after $1 ms unless it ended before; its status in $status.
run_and_kill() {
    delay=$1; shift
    "$mpm3d" --quiet --threads 1 "$@" job.mpm 2>said &
    process=$!
    sleep "$(echo "$delay" | awk '{ printf "%.3f", $1 / 1000 }')"
    kill -KILL $process 2>/dev/null && { wait $process 2>/dev/null; status=137; return; }
    wait $process
    status=$?
}

run_and_wait() { "$mpm3d" --quiet --threads 1 "$@" job.mpm 2>said; status=$?; }

# Where to go on from: the checkpoint that is whole, or the one before; nothing: from the start.
choose() {
    from=
    for file in part/job.rest part/job.rest.old; do
        [ -f $file ] || continue
        if "$mpm3d" --check --restart $file job.mpm >said 2>&1; then from=$file; break; fi
        echo "FAIL $file is there and is not whole"; head -n 3 said; failed=1
    done
    case $from in *.old) from_old=$((from_old + 1)) ;; '') from_start=$((from_start + 1)) ;; esac
}

# same NAME FOLDER: all files but the log, and checkpoints
same() {
    for file in whole/*; do
        case $file in *.out | *.rest | *.old) continue ;; esac
        cmp "$file" "$2/$(basename "$file")" || { echo "FAIL $1: ${file#whole/} differs"; failed=1; return 1; }
    done
    identical=$((identical + 1))
}

# round: a run that is killed once or several times, to its end
round() {
    rm -rf part
    from=
    while :; do
        if [ $hits -lt "$kills" ] && [ $((hits - started)) -lt 4 ]; then
            draw "$milliseconds"
            if [ "$from" ]; then run_and_kill "$random" --restart $from; else rm -rf part; run_and_kill "$random" -o part; fi
        else
            if [ "$from" ]; then run_and_wait --restart $from; else rm -rf part; run_and_wait -o part; fi
        fi
        [ $status -eq 0 ] && break
        if [ $status -ne 137 ]; then echo "FAIL $1: exit status $status"; head -n 3 said; failed=1; return; fi
        hits=$((hits + 1))
        [ -e part/job.rest.part ] && in_write=$((in_write + 1))
        choose
    done
    same "$1" part
}

# study DECK LINES: rounds until the share of this deck is killed
study() {
    deck "$1" "$2"
    rm -rf whole
    start=$(date +%s%N)
    "$mpm3d" --quiet --threads 1 -o whole job.mpm 2>said || { echo "FAIL $1: exit status $?"; failed=1; return; }
    milliseconds=$((($(date +%s%N) - start) / 1000000 + 1))
    share=$(((hits * decks_left + kills - hits) / decks_left)) decks_left=$((decks_left - 1)) before=$hits
    while [ $hits -lt $share ]; do
        rounds=$((rounds + 1)) started=$hits
        round "$1 round $rounds"
    done
    echo "$1: $((hits - before)) kills, $milliseconds ms undisturbed"
}

decks_left=6
study decks/reference/contact_friction.mpm "para"
study decks/reference/bar_gimp.mpm ""
study decks/coverage/build_points.mpm ""
study property/equilibria.mpm "smal"
study decks/reference/taylor_pla2.mpm "para binary"
study property/restart.mpm ""
echo "$hits kills in $rounds runs, $in_write of them while a checkpoint was being written; gone on from the start $from_start times, from the checkpoint before the last $from_old times"
if [ $identical -eq $rounds ]; then echo "ok $identical of $rounds runs ended with the files of an undisturbed one"; else echo "FAIL $identical of $rounds runs"; failed=1; fi

# --- disks of 2 MB: what is there first takes from some bytes to nearly all ---

mkdir "$disk"
if ! mount -t tmpfs -o size=2m tmpfs "$disk" 2>/dev/null; then
    echo "skip disks of 2 MB: no right to mount one here"
    exit $failed
fi
full=0 identical=0 rounds=0
for name in decks/reference/contact_friction.mpm decks/reference/taylor_pla2.mpm decks/reference/column_dpm.mpm; do
    deck $name "outr seqv outr velx para"
    rm -rf whole
    run_and_wait -o whole
    for taken in 0 400 800 1200 1400 1600 1700 1800 1900 2000; do
        rm -rf "${disk:?}"/* part
        [ $taken -eq 0 ] || dd if=/dev/zero of="$disk/ballast" bs=1k count=$taken 2>/dev/null
        rounds=$((rounds + 1))
        run_and_wait -o "$disk/part"
        if [ $status -eq 4 ]; then
            full=$((full + 1))
            grep -q '^mpm3d: error: .*No space left' said || { echo "FAIL $name, $taken kB taken: no word of the disk"; cat said; failed=1; }
        elif [ $status -ne 0 ]; then
            echo "FAIL $name, $taken kB taken: exit status $status"; failed=1
        fi
        mkdir -p part
        cp -r "$disk/part/." part 2>/dev/null # a larger disk; then it goes on
        if [ $status -ne 0 ]; then
            rm -f part/job.rest.part
            choose
            if [ "$from" ]; then run_and_wait --restart $from; else rm -rf part; run_and_wait -o part; fi
            [ $status -eq 0 ] || { echo "FAIL $name, $taken kB taken: it does not go on, status $status"; cat said; failed=1; continue; }
        fi
        same "$name, $taken kB taken" part
    done
done
echo "$full of $rounds runs filled their disk"
if [ $full -gt 0 ] && [ $identical -eq $rounds ]; then echo "ok $identical of $rounds runs on disks of 2 MB ended, some after a move, with the files of an undisturbed one"; else echo "FAIL $identical of $rounds runs on small disks"; failed=1; fi
exit $failed
