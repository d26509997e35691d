#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# N + M steps are N steps, a restart and M steps, byte for byte in all files: every deck of tests/decks/reference and
# tests/decks/coverage for about forty steps, and a few more for words that these lack. In the end every law, equation of state
# and word that changes the course of a run has to have been in some deck. sh tests/property/restart_words.sh BUILD
build=$(cd "$1" && pwd) || exit 2
here=$(cd "$(dirname "$0")/.." && pwd)
mpm3d=$build/mpm3d
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT INT TERM
cp -r "$here/decks/coverage" "$here/decks/reference" "$folder" && cd "$folder" || exit 2
failed=0 steps=40
: >seen

# deck FILE END_TIME INTERVAL LINES: beside FILE, so that what it includes is found; with another end
deck() {
    { grep -viE '^ *(endi|endt|outt|rptt|rest|open settle)' "$1"; printf '%s\n' "endt $2 outt $3" "$4" endi; } >"$(dirname "$1")/job.mpm"
}

# same NAME: all files but the log and checkpoints
same() {
    for file in whole/*; do
        case $file in *.out | *.rest | *.rest.old) continue ;; esac
        cmp "$file" "part/$(basename "$file")" >&2 || { echo "FAIL $1: ${file#whole/} differs"; failed=1; return 1; }
    done
    echo "ok $1"
}

# compare NAME FILE LINES
compare() {
    name=$1 file=$2 lines=$3
    job=$(dirname "$file")/job.mpm
    rm -rf whole part
    deck "$file" 1e30 1e30 "$lines"
    step=$("$mpm3d" --check "$job" 2>/dev/null | sed -n 's/^first time step \([-+.0-9E]*\),.*/\1/p')
    [ "$step" ] || { echo "FAIL $name: no time step"; failed=1; return; }
    set -- $(echo "$step $steps" | awk '{ printf "%.9e %.9e %.9e", $1 * $2 * 0.5, $1 * $2, $1 * $2 * 0.3 }')
    deck "$file" "$2" "$3" "$lines"
    "$mpm3d" --quiet --threads 1 -o whole "$job" 2>said || { echo "FAIL $name: exit status $?"; head -n 3 said; failed=1; return; }
    deck "$file" "$1" "$3" "$lines
rest every 1000000 steps"
    "$mpm3d" --quiet --threads 2 -o part "$job" 2>said || { echo "FAIL $name: exit status $? of the first half"; failed=1; return; }
    deck "$file" "$2" "$3" "$lines"
    "$mpm3d" --quiet --threads 1 --restart part/job.rest "$job" 2>said || { echo "FAIL $name: exit status $? of the restart"; head -n 3 said; failed=1; return; }
    same "$name" && sed 's/!.*//' "$job" | tr -s ' \t,' '\n' | tr A-Z a-z | cut -c1-4 >>seen
}

# Equilibria have no time: they go on from the one before the last. Those of one equilibrium have nothing to go on to.
for file in coverage/*.mpm reference/*.mpm; do
    case $file in
    */job.mpm | */quas_*) continue ;;
    */generators.mpm | */solid_shapes.mpm) continue ;; # shapes only, no motion
    esac
    compare "$file" "$file" ""
done

# Words that the decks above lack, on small decks of theirs.
compare "usl, lite" reference/bar_usl.mpm "lite 0.01"
compare "bimp, blend" reference/bar_usf.mpm "bimp xfer blend 0.9"
compare "gimp cp, jaum exact, dtmi" reference/bar_musl.mpm "gimp cp jaum exact dtmi 1e-12"
compare "maxw, particles out of order" coverage/law_maxw_turn.mpm "sort off jaum on"
compare "join" reference/contact_friction.mpm "cont lagr 0.2 0 join"
compare "smal" reference/bar_musl.mpm "smal"
compare "drda, mscl, dtfx" reference/bar_musl.mpm "drda mscl 25 dtfx 1e-7"
sed 's/^open group.*/open group 5 every 3/; s/^ther.*/ther 1 1e-5 300 0.25 cool/' coverage/build_points.mpm >coverage/groups.mpm
compare "groups, cooling" coverage/groups.mpm ""
sed '/^open until/d; /^ther/d; s/^open group.*/open all/' coverage/build_points.mpm >coverage/all.mpm
compare "all at once" coverage/all.mpm ""
sed 's/^open group.*/open point every 2/' coverage/build_points.mpm >coverage/one_by_one.mpm
compare "one by one" coverage/one_by_one.mpm ""
compare "layers, raster" coverage/build_layers.mpm "scan raster 0 45 90"
compare "held nodes" coverage/build_layers.mpm "fixn -9 9 -9 9 -9 9 1 0 1"
cp "$here/property/restart.mpm" coverage/falling.mpm
compare "lost drop, kinetic damping" coverage/falling.mpm ""
cp "$here/../decks/sph/laplace_2d.mpm" coverage/drop.mpm
compare "smoothed particles: a drop" coverage/drop.mpm ""
sed "s/^outr cels/outr cels curv wflu 2000/" "$here/../decks/sph/heat_plates.mpm" >coverage/plates.mpm
compare "smoothed particles: heat" coverage/plates.mpm ""
sed '/^dtfx/d; s/^sph/sph hrat 1.3 hsra 1.9 cfl 0.3 delt 0.1 grad jitt 0.02 7 vsmo on shif 0.2 csfe 0.2 latc on vhea on powe 1e9 redu 6800 \
    swel 1 cycl 0.01 1e4 stre 1 1 1 0.98/' coverage/sph_beam.mpm >coverage/beam.mpm
compare "smoothed particles: a beam, and what goes with it" coverage/beam.mpm ""
sed '/^dtfx/d; s/^sph/sph pgra shep visc morr inte thes tens on/; s/csf bala/csf thes dept off film off expa off ejec 5000 thru/; s/heat enth/heat appa/; s/rela on/mref start mcfa 0.2/' \
    coverage/sph_beam.mpm >coverage/thesis.mpm
compare "smoothed particles: a beam, of the dissertation" coverage/thesis.mpm ""
sed '/^dtfx/d; s/^sph/sph pgra sym visc mg swel 1 rate 1e3/; s/c0 10/c0 auto/; s/wall 3 temp 1600/wall 3 velo 1 0 0 adia nost/; s/beam 50 1e-4 0.3/beam 50 1e-4 0 alpha 2e4 slic bins 1.5/
    s/^prop 1 surf.*/prop 1 sahu 1.943 5e-4 1723 1.3e-5 3.2e-3 0.0022 -166000/; s/^prop 1 melt/prop 1 abso 2 1700 0.3 3000 0.4\
&/' coverage/sph_beam.mpm >coverage/values.mpm
compare "smoothed particles: a beam, values of words" coverage/values.mpm ""

# compared in restart.sh, to their end
sed 's/!.*//' "$here/property/equilibria.mpm" "$here/property/identity.mpm" "$here/decks/coverage/build_points.mpm" |
    tr -s ' \t,' '\n' | tr A-Z a-z | cut -c1-4 >>seen

# --- was everything there? ---

laws=$("$mpm3d" --help | sed -n '/^Laws/,/^$/p' | awk 'NR > 1 && NF { print substr($1, 1, 4) }')
[ "$laws" ] || laws=$(grep -o '^extern const struct law .*;' "$here/../src/material/law.h" | tr -d ';,' | tr ' ' '\n' | sed -n 's/^law_//p')
words=$("$mpm3d" --help sph | sed -n 's/^  \([a-z][a-z0-9]*\) .*/\1/p' | grep -v '^word$')
[ "$words" ] || { echo "FAIL --help sph lists no words"; failed=1; missing=1; }
for word in $laws $words usl usf musl gimp cp bimp sgmp tlmp uvfp smal jaum exac xfer pic apic blen bbar cont lagr othe join lite drda ndam damp \
    mscl dtfx dtmi qulo quli lost drop keep ghos open poin grou laye all sett buil scan rast resi phas ther cool fixn quas seos deto load \
    grav face velo para smoo curx sym shep mg morr stag thes bala appa enth star auto grad soli nost adia temp cycl rate alph slic line bins \
    dens capa cond surf sahu abso extr melt boil; do
    grep -qx "$word" seen || { echo "FAIL no deck with '$word' was compared"; failed=1; missing=1; }
done
[ "$missing" ] || echo "ok every law and word was compared"
exit $failed
