#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs with quas as a user sees them: sh tests/cli/quas.sh BUILD
# What is said of bodies that float, the end of runs without equilibrium, the state that is always written, a log that
# is a deck, and the same bits on any number of threads.
build=$(cd "$1" && pwd) || exit 2
decks=$(cd "$(dirname "$0")/../decks/coverage" && pwd) || exit 2
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
failed=0

# check NAME COMMAND...: the command has to succeed
check() {
    name=$1; shift
    if "$@" >/dev/null; then echo "ok $name"; else echo "FAIL $name"; failed=1; fi
}

"$build/mpm3d" --quiet -o free "$decks/quas_free.mpm" 2>free.err
check "a free body with loads in balance" [ $? -eq 0 ]
check "floating is told on the terminal" grep -q 'warning: body 1 floats freely: 6 rigid motions are taken out' free.err
check "floating is told in the log" grep -q 'body 1 floats freely' free/quas_free.out
check "the equilibrium is told in the log" grep -q '^equilibrium found at time 1.* Newton steps' free/quas_free.out
check "start and equilibrium are written" [ "$(grep -c ZONE free/quas_free_anim.dat)" -eq 2 ]
cp free/quas_free.out again.mpm
"$build/mpm3d" --quiet -o again again.mpm 2>again.err
check "the log is a deck that gives the same" cmp free/quas_free_anim.dat again/again_anim.dat

sed 's/^  face x- 1 .*//' "$decks/quas_free.mpm" >pulled.mpm
"$build/mpm3d" --quiet -o pulled pulled.mpm 2>pulled.err
check "a free body that is pulled ends with 3" [ $? -eq 3 ]
check "and the reason is told" grep -q 'no equilibrium found: body 1 floats freely and its loads have a resultant' pulled.err
check "its start is kept" [ "$(grep -c ZONE pulled/pulled_anim.dat)" -eq 1 ]

# perfectly plastic beyond its limit: (yield 0.1) there is nothing that Newton's method or motion could find
sed -e 's/pla2/pla1/; s/0.33 0.1 20.0e3/0.33 0.1/; s/^lost.*//; s/^spx.*/spx 0.0 10.5/; s/^quas.*/lost stop\nquas 1e-7 2/' \
    "$decks/quas_plastic.mpm" >collapse.mpm
"$build/mpm3d" --quiet -o collapse collapse.mpm 2>collapse.err
check "a bar beyond its limit load ends with 3" [ $? -eq 3 ]
check "and a particle and advice are told" grep -q 'particle [0-9]* of body 1' collapse.err

for job in quas_bend quas_plastic quas_damped; do
    "$build/mpm3d" --quiet --threads 1 -o one "$decks/$job.mpm"
    for threads in 2 5; do
        "$build/mpm3d" --quiet --threads $threads -o many "$decks/$job.mpm"
        for ending in _anim.dat _curv.dat _energy.dat; do
            check "$job$ending with $threads threads" cmp "one/$job$ending" "many/$job$ending"
        done
    done
done
exit $failed
