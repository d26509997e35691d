#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What a scene does not need costs it nearly nothing: the instructions of a plain run, counted by source file; those in the files of
# features which it does not use, as a part of all. What is not counted: a feature's code inside the files of the loop itself, such as
# a test whether it is on; `make bench` measures what features cost in time. sh tests/check/leave_out.sh BUILD
build=$(cd "$1" && pwd) || exit 2
if ! command -v callgrind_annotate >/dev/null; then
    echo "skip leave_out: no valgrind here"
    exit 0
fi
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
GOMP_SPINCOUNT=1000 KMP_BLOCKTIME=0; export GOMP_SPINCOUNT KMP_BLOCKTIME
cat >job.mpm <<END
mpm3d an elastic block that flies
nbco 1 nbbo 1 nbmp 8000 nmat 1
grid 0 24 0 24 0 24
dcell 1
endt 0.004 dtscale 0.5 bulk 0 0 jaum off
mate
1 elas 7.85e-3 210e3 0.3
part bloc 1
1 7.85e-3 0.5 5 5 5 20 20 20
velo
body 1 10 20 30
endv
endi
END
valgrind -q --tool=callgrind --callgrind-out-file=counts "$build/mpm3d" --quiet --threads 1 job.mpm || { echo "FAIL it does not run"; exit 1; }
callgrind_annotate --auto=no --threshold=100 counts | awk '
    BEGIN {
        n = split("contact faces smoothing smooth staggered equilibrium multigrid stiffness rigid light_nodes building schedule transformation rotation vtk animation", name, " ")
        for (i = 1; i <= n; i++) unused[name[i] ".c"]
    }
    / PROGRAM TOTALS/ { gsub(/,/, "", $1); all = $1 }
    match($0, /[a-z_]+\.[ch]:/) {
        file = substr($0, RSTART, RLENGTH - 1); count = $1; gsub(/,/, "", count)
        if (file in unused) { sum += count; if (count > worst) { worst = count; where = file } }
        if (file ~ /^(linear\.h|motion\.c|grid\.c|stress_update\.c|elastic\.c)$/) used += count
    }
    END {
        printf "%.0f instructions, %.4f of them in linear.h, motion.c, grid.c, stress_update.c, elastic.c; %.6f in files of features that are off (most in %s)\n", all, used / all, sum / all, where
        if (all > 0 && used / all > 0.5 && sum / all < 0.001) print "ok files of features that are off take less than a thousandth of the instructions"
        else print "FAIL files of features that are off take instructions"
    }' >result
cat result
! grep -q FAIL result
