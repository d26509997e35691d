#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints the result of decks/thesis/tensile.mpm beside the theory: sh tools/show_tensile.sh TECSTAT FILE
tecstat=$1 file=$2
ex=$("$tecstat" "$file" strain disx X) && ey=$("$tecstat" "$file" strain disy Y) || exit 4
middle=$("$tecstat" "$file" --where X 4 11 mean seqv) && end=$("$tecstat" "$file" --where X 14.5 15 mean stsx) || exit 4
echo "$ex $ey $middle $end" | awk '{
    printf "\n%-44s %14s %14s %10s\n", "tensile test, 25 MPa on 15 x 5 x 5 mm", "computed", "theory", "difference"
    printf "%-44s %14.6e %14.6e %9.2f %%\n", "strain along the bar", $1, 25/120e3, ($1/(25/120e3) - 1)*100
    printf "%-44s %14.6e %14.6e %9.2f %%\n", "strain across the bar", $2, -0.33*25/120e3, ($2/(-0.33*25/120e3) - 1)*100
    printf "%-44s %14.6f %14.6f %9.2f %%\n", "von Mises stress in the middle, MPa", $3, 25, ($3/25 - 1)*100
    printf "%-44s %14.6f\n", "stress in the loaded layer, MPa", $4
    print "The loaded layer carries half the stress: its load goes half to each side of its cells."
    print "The head of decks/thesis/tensile.mpm explains the difference; tensile_face.mpm is without it."
}'
