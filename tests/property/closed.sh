#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Closed particles take part in nothing: all files of a run with them are those of the run without them,
# byte for byte, for each scheme, shape function and what else goes over particles. sh tests/property/closed.sh BUILD
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
failed=0

# compare NAME SED-SCRIPT: runs the deck so changed with and without closed particles
compare() {
    bad=
    sed "$2" "$here/closed.mpm" >all.mpm
    mkdir -p with without
    sed '/! alone/d; s/!.*//' all.mpm >with/job.mpm
    sed '/! closed/d; s/!.*//' all.mpm >without/job.mpm
    for side in with without; do
        "$build/mpm3d" --quiet --threads 2 -o $side $side/job.mpm 2>$side/messages || bad="$bad ($side: status $?)"
        rm -f $side/job.out $side/job.mpm $side/messages
    done
    for file in without/*; do
        [ -f "$file" ] && cmp -s "$file" with/"${file#without/}" || bad="$bad ${file#without/}"
    done
    [ -s without/job_energy.dat ] || bad="$bad no-output"
    if [ -z "$bad" ]; then echo "ok $1"; else echo "FAIL $1 differs with closed points:$bad"; failed=1; fi
    rm -rf with without
}

for scheme in usl musl usf; do
    compare "$scheme linear" "s/^musl/$scheme/"
    for shape in gimp 'gimp cp' bimp sgmp; do
        compare "$scheme $shape" "s/^musl on/$scheme on $shape/; /! face/d; /! closed face/d"
    done
    compare "$scheme contact" "s/^endt 0.012 .*/endt 0.001 outt 0.0005/; s/^musl on/$scheme on cont lagr 0.2 0/"
    compare "$scheme drda" "s/^musl on/$scheme on drda/"
done
compare "smoothed pressure" 's/^tecp/para ascii smoo/'
compare "smoothed pressure sgmp" 's/^tecp/para ascii smoo sgmp/; /! face/d; /! closed face/d'
compare "bbar" 's/^tecp/tecp bbar/'
compare "apic" 's/^tecp/tecp xfer apic/'
compare "ndam and mscl" 's/^tecp/tecp ndam 0.5 mscl 4/'
compare "lost drop" 's/^tecp/tecp lost drop/; s/^body 1 30/body 1 -300/'
exit $failed
