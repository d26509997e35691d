#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A few steps of a small deck of every method under valgrind: no wrong access, no uninitialised value, no leak.
# sh tests/check/memcheck.sh BUILD
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")/.." && pwd)
if ! command -v valgrind >/dev/null; then
    echo "skip memcheck: no valgrind here"
    exit 0
fi
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 2
# the program would start itself anew to set these, and valgrind would lose it
GOMP_SPINCOUNT=1000 KMP_BLOCKTIME=0; export GOMP_SPINCOUNT KMP_BLOCKTIME
failed=0

grind() { valgrind -q --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite,indirect "$build/mpm3d" --quiet --threads 1 "$@" 2>said; }

# check NAME DECK STEPS LINES: so many steps, a checkpoint, and as many from it
check() {
    { grep -viE '^ *(endi|endt|outt|rptt|rest|open settle)' "$here/$2"; printf '%s\n' "$4" "endt 1e30 outt 1e30" endi; } >job.mpm
    step=$("$build/mpm3d" --check job.mpm 2>/dev/null | sed -n 's/^first time step \([-+.0-9E]*\),.*/\1/p')
    end=$(echo "${step:-1} $3" | awk '{ print $1 * $2 }')
    sed -i "s/^endt 1e30 outt 1e30/endt $end outt $end rest every 2 steps/" job.mpm
    rm -rf out
    grind -o out job.mpm && sed -i "s/^endt [^ ]*/endt $(echo "$end" | awk '{ print 2 * $1 }')/" job.mpm &&
        grind --restart out/job.rest job.mpm || { echo "FAIL $1"; head -n 12 said; failed=1; return; }
    echo "ok $1"
}

check "musl, linear" decks/reference/bar_musl.mpm 4 "para binary"
check "usf, gimp" decks/reference/bar_gimp.mpm 4 "usf on para ascii"
check "usl, lite" decks/reference/bar_usl.mpm 4 "lite 0.01"
check "bimp, apic's blend" decks/reference/bar_usf.mpm 4 "bimp xfer blend 0.5"
check "staggered, total" decks/reference/beam_sgtl.mpm 2 "para"
check "contact" decks/reference/contact_friction.mpm 3 "cont lagr 0.2 0 join"
check "bbar" decks/coverage/bbar.mpm 3 ""
check "openings, hot zone" decks/coverage/build_points.mpm 25 ""
check "layers, residual stress" decks/coverage/build_layers.mpm 45 ""
check "explosive" decks/reference/deto_1d.mpm 3 ""
check "Johnson-Cook" decks/coverage/law_jcf_failure.mpm 3 ""
check "smoothed particles: flow that leaves the grid" decks/coverage/sph_lost.mpm 8 ""
check "smoothed particles: surface tension" ../decks/sph/laplace_2d.mpm 2 ""
check "smoothed particles: heat, beam, a scene that repeats" decks/coverage/sph_beam.mpm 4 ""
check "generators" decks/reference/generators.mpm 2 ""
# the problems of a deck of reproducing kernel particles, up to 6 nodes along x
problem() {
    sed 's/^  refi .*/  refi 3 6/' "$here/../decks/rkpm/$1.mpm" >job.mpm
    if grind -o out job.mpm; then echo "ok $1"; else echo "FAIL $1"; head -n 12 said; failed=1; fi
}
for deck in sine_1d_quad_25 sine_2d_30 helmholtz_2 poisson_lagrange poisson_nitsche poisson_transformation; do problem $deck; done
check "nodes in motion: springs" decks/coverage/rkpm_spring.mpm 4 ""
check "nodes in motion: nodes of a wall" decks/coverage/rkpm_natural.mpm 4 ""
check "nodes in motion: a ball" decks/coverage/rkpm_ball.mpm 2 ""
cp "$here/property/equilibria.mpm" job.mpm
if grind -o out job.mpm; then echo "ok equilibria"; else echo "FAIL equilibria"; head -n 12 said; failed=1; fi
printf 'mpm3d wrong\nnbco 0 nbo 1\nmate\n1 elas x\n' >job.mpm
grind job.mpm
if [ $? -eq 2 ]; then echo "ok a wrong deck"; else echo "FAIL a wrong deck"; head -n 12 said; failed=1; fi
exit $failed
