#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Pictures of reproducing kernel particles, into FOLDER: a drop on a wall at seven times, its width against that of finite
# elements, the creep of a cantilever against Euler and Bernoulli's beam, the stress in layers laid one on another:
# sh tools/pictures_rkpm.sh BUILD FOLDER
build=$1 folder=$2
mkdir -p "$folder" || exit 4

# run DECK
run() { "$build/mpm3d" --quiet -o "$folder" "decks/rkpm/$1.mpm" || exit; }

# chart NAME FILE OPTION...
chart() {
    name=$1 file=$2
    shift 2
    "$build/tecview" curve "$file" --out "$folder/$name.svg" "$@" || exit
    echo "$folder/$name.svg"
}

# output every 0.004: zone 9 is 0.032, zone 15 0.056
run drop_nsni_half
zone=9
for time in 0.032 0.036 0.040 0.044 0.048 0.052 0.056; do
    "$build/tecview" points "$folder/drop_nsni_half_anim.dat" --zone $zone --from top --of vely --label "velocity along y, t = $time" --unit m/s \
        --length-unit m --range -1 1 --size 800x700 --out "$folder/drop_$time.png" || exit
    echo "$folder/drop_$time.png"
    zone=$((zone + 1))
done

# finite elements: spec rkpm 11.4 G2, in diameters of 0.02
table=$folder/drop_width.dat
echo 'VARIABLES = "t" "nodes" "finite elements"' >"$table"
while read -r time width; do
    found=$("$build/tecstat" "$folder/drop_nsni_half_curv.dat" --where Time "$(awk "BEGIN { print $time - 3e-6 }")" "$(awk "BEGIN { print $time + 3e-6 }")" last widt | tail -n 1)
    awk "BEGIN { print $time, $found / 0.02, $width }" >>"$table"
done <<END
0.032 1.257
0.036 1.480
0.040 1.256
0.044 0.909
0.048 1.001
0.052 1.215
0.056 1.273
END
chart drop_width "$table" --x t --y "nodes,finite elements" --points --title "Drop: width over diameter" --xlabel time --ylabel width --unit s,1

# spec rkpm 11.3 M8: w = 4 L^3/(E h^3) (1 - 0.8 exp(-t/5)), and from 10 on less what would have come of the load since
run creep_beam
run creep_beam_quad
table=$folder/creep.dat
echo 'VARIABLES = "t" "linear" "quadratic" "Euler and Bernoulli"' >"$table"
paste "$folder/creep_beam_error.dat" "$folder/creep_beam_quad_error.dat" | awk '
    function creep(t) { return t < 0 ? 0 : 0.32 * (1 - 0.8 * exp(-t / 5)) }
    NR > 1 { print $1, $3, $6, creep($1) - ($2 == 0 ? creep($1 - 10) : 0) }' >>"$table"
chart creep "$table" --x t --y "linear,quadratic,Euler and Bernoulli" --title "Creep of a cantilever" --xlabel time --ylabel "tip" --unit 1,length

run deposition
"$build/tecview" points "$folder/deposition_anim.dat" --from top --of stsy --label "stress along y" --unit Pa --length-unit m --size 700x700 \
    --out "$folder/deposition.png" || exit
echo "$folder/deposition.png"
