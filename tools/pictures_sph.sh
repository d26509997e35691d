#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Pictures of smoothed particles, into FOLDER: temperature, state and speed of a track at three times, the zone of a spot weld
# that has been melt, and the pressure in drops against their curvature: sh tools/pictures_sph.sh BUILD FOLDER
build=$1 folder=$2
mkdir -p "$folder" || exit 4

# draw NAME DECK OPTION...: of a deck that has run
draw() {
    name=$1 deck=$2
    shift 2
    "$build/tecview" points "$folder/${deck}_anim.dat" --out "$folder/$name.png" "$@" || exit
    echo "$folder/$name.png"
}

for deck in track_150 spot_full; do
    "$build/mpm3d" --quiet -o "$folder" "decks/sph/$deck.mpm" || exit
done
for zone in 4 8 last; do
    draw "track_150_temperature_$zone" track_150 --zone $zone --from top --of cels --label temperature --unit K --length-unit m --range 293 5000 --size 1600x500
    draw "track_150_state_$zone" track_150 --zone $zone --from top --of liqu --label "liquid fraction" --length-unit m --size 1600x500
    draw "track_150_speed_$zone" track_150 --zone $zone --from top --of spee --label speed --unit m/s --length-unit m --range 0 5 --size 1600x500
done
draw spot_full_zone spot_full --of fuse --label "has been melt" --length-unit m --section y=2e-5 --both
draw spot_full_temperature spot_full --of cels --label temperature --unit K --length-unit m --section y=2e-5

# drops of tension 10: the pressure in the middle, less than half a radius from it along x and y
table=$folder/laplace.dat
echo 'VARIABLES = "1/R" "measured" "sigma/R"' >"$table"
for radius in 0.4 0.5 0.7 1 1.4; do
    sed "s/z 0 0 -0.025 1 0.05/z 0 0 -0.025 $radius 0.05/; /^nbmp/s/.*/nbmp 3000/" decks/sph/laplace_2d.mpm >"$folder/laplace.mpm"
    "$build/mpm3d" --quiet -o "$folder" "$folder/laplace.mpm" 2>/dev/null || exit
    near=$(awk "BEGIN { print 0.35 * $radius }")
    pressure=$("$build/tecstat" "$folder/laplace_anim.dat" --where X -"$near" "$near" --where Y -"$near" "$near" mean pres | tail -n 1)
    awk "BEGIN { print 1 / $radius, $pressure, 10 / $radius }" >>"$table"
done
"$build/tecview" curve "$table" --y measured,sigma/R --points --title "Pressure in drops of surface tension 10" --xlabel "1/R (1/length)" \
    --ylabel "pressure (stress)" --out "$folder/laplace.svg" || exit
echo "$folder/laplace.svg"
