#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Checkpoints under bad conditions: signals, kill -9, full disk, folders that vanish, damaged and wrong
# checkpoints. Nothing that was whole before may be lost. sh tests/cli/restart.sh BUILD
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")" && pwd) || exit 2
mpm3d=$build/mpm3d
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
failures=0

. "$here/expect.inc"

# deck POINTS_ALONG_AN_EDGE END_TIME LINES...: an elastic cube; a unit of time is 1.1 steps
deck() {
    cat <<END
mpm3d cube
nbco 1, nbbo 1
nbmp $(($1 * $1 * $1))
nmat 1
grid 0 40 0 40 0 40
dcell 1
endt $2
outt 100
mate
1 elas 1 1 0.3
part bloc 1
1 1 0.5 2 2 2 $1 $1 $1
tecp
outr velx
curv velx 1
velo
body 1 0.001 0 0
endv
END
    shift 2
    printf '%s\n' "$@" endi
}

# --- damaged and wrong checkpoints ---

deck 3 20 "rest every 10 steps" >small.mpm
expect "a run with checkpoints" 0 "finished after" "$mpm3d" -o s small.mpm
check "a checkpoint and the one before" test -s s/small.rest -a -s s/small.rest.old
check "nothing half-written is left" test ! -e s/small.rest.part
cp -r s kept
size=$(wc -c <s/small.rest)
wrong=0 tried=0

# refused WHAT PATTERN: the file `bad` is refused with status 4 and a message
refused() {
    "$mpm3d" --check --restart bad small.mpm >printed 2>&1
    found=$? tried=$((tried + 1))
    if [ $found -ne 4 ] || ! grep -q "^mpm3d: error: 'bad' $2" printed; then
        echo "FAIL $1: exit status $found"; head -n 5 printed; wrong=1; failures=1
    fi
}
length=0
while [ $length -lt "$size" ]; do
    head -c $length s/small.rest >bad
    refused "cut off at $length" "is "
    length=$((length + 1000))
done
head -c $((size - 1)) s/small.rest >bad
refused "without the last byte" "is not whole: its end is missing"
{ cat s/small.rest; echo; } >bad
refused "a byte more" "is not whole: its end is missing"
[ $wrong = 0 ] && echo "ok $tried checkpoints that are cut off are refused"
wrong=0 tried=0

# flip PLACE: one bit of a byte, another one in each
flip() {
    byte=$(od -An -tu1 -j "$1" -N 1 s/small.rest | tr -d ' ')
    bit=$(($1 / 7 % 8))
    cp s/small.rest bad
    # shellcheck disable=SC2059 # an octal escape
    printf "\\$(printf %o $((byte ^ (1 << bit))))" | dd of=bad bs=1 seek="$1" conv=notrunc 2>/dev/null
}
place=0
while [ $place -lt "$size" ]; do
    flip $place
    refused "a bit of byte $place" "is "
    place=$((place + size / 40 + 1))
done
for place in 16 20 $((size - 32)) $((size - 10)) $((size - 1)); do
    flip "$place"
    refused "a bit of byte $place" "is "
done
[ $wrong = 0 ] && echo "ok $tried checkpoints with a flipped bit are refused"
flip 16
expect "another version" 4 "is a checkpoint of version [0-9]*; this program reads version 2" "$mpm3d" --restart bad small.mpm
expect "no checkpoint" 4 "'small.mpm' is no checkpoint of mpm3d" "$mpm3d" --restart small.mpm small.mpm
: >bad
expect "an empty file" 4 "'bad' is no checkpoint of mpm3d" "$mpm3d" --restart bad small.mpm
expect "no file" 4 "cannot read the checkpoint 'none.rest': No such file" "$mpm3d" --restart none.rest small.mpm
expect "a folder" 4 "cannot read the checkpoint 's': Is a directory" "$mpm3d" --restart s small.mpm
expect "no name of a checkpoint" 1 "has to follow '--restart'" "$mpm3d" small.mpm --restart
expect "a whole checkpoint" 0 "27 particles" "$mpm3d" --check --restart s/small.rest small.mpm

# wrong_deck NAME EDIT PATTERN
wrong_deck() {
    sed "$2" small.mpm >s/small.mpm
    expect "$1" 4 "$3" "$mpm3d" --restart s/small.rest s/small.mpm
    rm s/small.mpm
}
wrong_deck "another law" 's/1 elas 1 1/1 elas 1 1.5/' "of another deck: there it says '  1 elas 1 1 0.3', here '  1 elas 1 1.5 0.3'"
wrong_deck "another velocity" 's/body 1 0.001/body 1 0.002/' "there it says '  body 1 0.001 0 0', here '  body 1 0.002 0 0'"
wrong_deck "one result more" 's/^tecp/tecp outr seqv/' "of another deck: there it says .*, here 'outr seqv'"
check "a refused restart changes nothing" diff -r s kept
mkdir other && cp s/small.rest other
expect "tables that are not there" 4 "cannot continue 'other/small.out': No such file" "$mpm3d" --restart other/small.rest small.mpm
cp s/* other && sed 's/E-0/E-1/' s/small_energy.dat >other/small_energy.dat && cp -r other other2
expect "a table of another run" 4 "cannot continue 'other/small_energy.dat': it is not the file that the checkpoint goes with" \
    "$mpm3d" --restart other/small.rest small.mpm
check "it changes nothing" diff -r other other2
head -n 3 s/small_energy.dat >other/small_energy.dat
expect "a table that was cut off" 4 "not the file that the checkpoint goes with, or was cut off" "$mpm3d" --restart other/small.rest small.mpm
expect "a finished run is finished" 0 "finished after" "$mpm3d" --restart s/small.rest small.mpm
deck 3 40 "rest every 10 steps" >longer.mpm && mv longer.mpm small.mpm
expect "a later end time" 0 "finished after" "$mpm3d" --restart s/small.rest small.mpm
"$mpm3d" --quiet -o whole small.mpm
check "is as if it had been there from the start" cmp whole/small_energy.dat s/small_energy.dat

# --- disks and folders ---

deck 10 20 "rest every 1000000 steps" >disk.mpm
expect "a run before the disk is full" 0 "finished after" "$mpm3d" -o d disk.mpm
cp d/disk.rest before.rest
sed 's/^endt.*/endt 40/; s/^outt.*/outt 100/' disk.mpm >disk2.mpm && mv disk2.mpm disk.mpm
if [ -e /dev/full ]; then
    ln -s /dev/full d/disk.rest.part
    expect "a full disk" 4 "cannot write the checkpoint 'd/disk.rest': No space left" "$mpm3d" --restart d/disk.rest disk.mpm
    check "leaves the checkpoint before" cmp d/disk.rest before.rest
fi
expect "a file that is too large" 4 "cannot write the checkpoint 'd/disk.rest': File too large" \
    sh -c 'ulimit -f 100; "$1" --restart d/disk.rest disk.mpm' - "$mpm3d"
check "leaves the checkpoint before it" cmp d/disk.rest before.rest
check "leaves nothing half-written" test ! -e d/disk.rest.part
mkdir d/disk.rest.part
expect "a name that is taken" 4 "cannot write the checkpoint 'd/disk.rest': Is a directory" "$mpm3d" --restart d/disk.rest disk.mpm
rmdir d/disk.rest.part
echo "half of a checkpoint" >d/disk.rest.part
expect "a half-written one does no harm" 0 "finished after" "$mpm3d" --restart d/disk.rest disk.mpm
check "the one before is kept" cmp d/disk.rest.old before.rest
"$mpm3d" --quiet -o dw disk.mpm
check "after all that the tables are whole" cmp dw/disk_energy.dat d/disk_energy.dat
chmod 555 d
if [ ! -w d ]; then
    sed 's/^endt.*/endt 60/' disk.mpm >disk2.mpm && mv disk2.mpm disk.mpm
    expect "a read-only folder" 4 "cannot write the checkpoint 'd/disk.rest': Permission denied" "$mpm3d" --restart d/disk.rest disk.mpm
fi
chmod 755 d
[ -d /proc/self ] && expect "a folder where nothing can be made" 4 "cannot create '/proc/disk.out'" "$mpm3d" -o /proc disk.mpm

# --- signals: the run goes on afterwards, and all is as if nothing had happened ---

deck 8 900 "rest every 50 steps" >job.mpm
"$mpm3d" --quiet --threads 1 -o w job.mpm || { echo "FAIL the run without a break"; failures=1; }

# until_there PATH PROCESS: until the file is there, or the process is not
until_there() {
    while [ ! -e "$1" ] && kill -0 "$2" 2>/dev/null; do sleep 0.02; done
}

# broken SIGNAL SECONDS STATUS: a run that the signal ends that long after its first checkpoint
broken() {
    rm -rf b
    "$mpm3d" --quiet --threads 1 -o b job.mpm 2>said &
    process=$!
    until_there b/job.rest $process
    sleep "$2"
    kill "-$1" $process 2>/dev/null
    wait $process 2>/dev/null
    found=$?
    [ $found -eq 0 ] && { echo "ok $1 after $2 s: it had finished"; return; }
    check "$1 after $2 s: status $3" test $found -eq "$3"
    check "$1 after $2 s: energies can be read" "$build/tecstat" b/job_energy.dat count
    check "$1 after $2 s: curves can be read" "$build/tecstat" b/job_curv.dat count
    rows=$("$build/tecstat" b/job_energy.dat count)
    expect "$1 after $2 s: it goes on" 0 "finished after" "$mpm3d" --restart b/job.rest job.mpm
    step=$(sed -n 's/^Restarted from .* at step \([0-9]*\),.*/\1/p' b/job.out)
    [ "$1" = KILL ] && most=51 || most=0
    check "$1 after $2 s: at most $most of $rows steps are lost, from $step" test $((rows - step)) -le $most
    for file in job_anim.dat job_curv.dat job_energy.dat job_momentum.dat; do
        check "$1 after $2 s: $file is whole" cmp w/$file b/$file
    done
}
broken INT 0.05 130
broken TERM 0.2 130
for seconds in 0.03 0.11 0.24; do broken KILL $seconds 137; done

deck 8 1e9 >long.mpm
"$mpm3d" -o "l" --threads 1 long.mpm 2>said & process=$!
until_there l/long_energy.dat $process; sleep 0.3; kill -INT $process; wait $process
check "without rest an interrupted run writes a checkpoint too" test $? = 130 -a -s l/long.rest
check "and says how to go on" grep -q "^to go on: mpm3d --restart l/long.rest long.mpm$" said
"$mpm3d" --threads 1 --restart l/long.rest long.mpm 2>said & process=$!
sleep 0.5; mv l gone; kill -INT $process; wait $process
check "a folder that vanished: status 4" test $? = 4
check "a folder that vanished: a message" grep -q "cannot write the checkpoint 'l/long.rest': No such file or directory" said
expect "the checkpoint is whole" 0 "512 particles" "$mpm3d" --check --restart gone/long.rest long.mpm

# a step takes a tenth of a second or so: the second signal comes before its end
deck 60 1e9 >slow.mpm
"$mpm3d" --threads 1 -o slow slow.mpm 2>said & process=$!
until_there slow/slow_curv.dat $process; sleep 1; kill -INT $process; kill -TERM $process; wait $process
check "a second signal: status 130" test $? = 130
check "a second signal ends the run at once" sh -c 'test ! -e slow/slow.rest && ! grep -q interrupted said'
exit $failures
