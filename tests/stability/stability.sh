#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# How far the time step goes, and how extreme scenes end: sh tests/stability/stability.sh BUILD REPORT
# QUICK=1: fewer steps and without three points a cell and direction. The report is REPORT/stability.txt.
#
# The map: for each scheme, shape function and number of points the largest dtsc at which a bar and a block,
# struck at one point, do not blow up. A run is stable when it comes to its end and its energy never is twice
# that of the start. The theory: a wave of two cells swings with omega = 2 c/h, c the speed of compression waves, and
# central differences bear 2/omega = h/c, which is dtsc 1. Wider shapes see short waves less and bear more.
build=$(cd "$1" && pwd) || exit 2
report=${2:-report}
mkdir -p "$report" && report=$(cd "$report" && pwd) || exit 4
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
if [ "$QUICK" ]; then steps=300 halvings=5 points="1 2"; else steps=1000 halvings=7 points="1 2 3"; fi

# deck BODY SCHEME SHAPE POINTS DTSC: a bar of 16 cells, or a block of 4 x 4 x 4 cells, with points in whole
# cells or all of it moved by a tenth of a cell (nodes with little mass beyond its faces)
deck() {
    awk -v body="$1" -v scheme="$2" -v shape="$3" -v points="$4" -v scale="$5" -v steps="$steps" 'BEGIN {
        nx = (body == "bar" ? 16 : 4) * points; across = body == "bar" ? 1 : nx
        poisson = body == "bar" ? 0 : 0.3
        speed = sqrt((1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)))
        x = 4 + (body == "moved" ? 0.1 : 0); y = body == "bar" ? 4.5 - 0.5 / points : x
        print "mpm3d stability\nnbco 1\nnbbo 1\nnmat 1\nnbmp " nx * across * across
        print "grid 0 24 0 12 0 12\ndcell 1\nendtime " steps * scale / speed "\ndtscale " scale
        print scheme " on\nbulk 0 0\ndigits 9"
        if (shape != "linear") print shape
        print "material\n1 elas 1 1 " poisson "\nparticle block 1\n1 1 " 1 / points " " x " " y " " y " " nx " " across " " across
        print "velo\nnode " int(nx / 2) " 1e-5 " (body == "bar" ? 0 : 5e-6) " 0\nendv\nendinput"
    }'
}

# is_stable BODY SCHEME SHAPE POINTS DTSC
is_stable() {
    deck "$@" >map.mpm
    timeout 300 "$build/mpm3d" --quiet --threads 1 -o . map.mpm >message 2>&1
    status=$?
    [ $status -eq 3 ] && return 1
    [ $status -eq 0 ] || { echo "FAIL map, $*: exit status $status"; cat message; exit 1; } >&2
    { "$build/tecstat" map_energy.dat first total; "$build/tecstat" map_energy.dat max total; } |
        awk 'NR == 1 { first = $1 } END { exit !($1 < 2 * first) }'
}

# largest BODY SCHEME SHAPE POINTS: by bisection between 0 and 2.5
largest() {
    low=0 high=2.5 left=$halvings
    is_stable "$@" $high && { echo ">2.5"; return; }
    while [ "$left" -gt 0 ]; do
        middle=$(echo "$low $high" | awk '{ print ($1 + $2) / 2 }')
        if is_stable "$@" "$middle"; then low=$middle; else high=$middle; fi
        left=$((left - 1))
    done
    echo "$low" | awk '{ printf "%.2f\n", $1 }'
}

{
    echo "The largest stable dtsc, by bisection in steps of $(echo "$halvings" | awk '{ printf "%.2g", 2.5 / 2 ^ $1 }'), $steps steps each; the theory for a bar with linear shapes: 1."
    echo "One point a cell and direction, 2 x 2 x 2 and 3 x 3 x 3; a bar (one row of points), a block of 4 x 4 x 4 cells, the"
    echo "block moved by a tenth of a cell. The default is musl, linear, 0.9."
    echo
    printf '%-7s %-7s %-7s %8s %8s %8s\n' scheme shape points bar block moved
    for scheme in usf usl musl; do
        for shape in linear gimp bimp sgmp; do
            for n in $points; do
                printf '%-7s %-7s %-7s %8s %8s %8s\n' $scheme $shape $n "$(largest bar $scheme $shape $n)" \
                    "$(largest block $scheme $shape $n)" "$(largest moved $scheme $shape $n)"
            done
        done
    done
    echo
    echo "Extreme scenes (decks/extreme), and what those say that must stop:"
    sh "$here/../decks/endings.sh" "$build" all || touch failed
} >"$report/stability.txt"
cat "$report/stability.txt"
[ ! -e failed ]
