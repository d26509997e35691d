#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a deck of each chapter of the thesis and draws the von Mises stress of its last state on the part and on a
# section, into FOLDER: sh tools/pictures.sh BUILD FOLDER
build=$1 folder=$2
mkdir -p "$folder" || exit 4
while read -r deck section; do
    "$build/mpm3d" --quiet -o "$folder" "decks/thesis/$deck.mpm" || exit
    "$build/tecview" points "$folder/${deck}_anim.dat" --of seqv --label "von Mises stress" --unit MPa --length-unit mm \
        --both --section "$section" --out "$folder/$deck.png" || exit
    echo "$folder/$deck.png"
done <<END
tensile x=7.25
compression_coarse z=1.9
compression_fine z=1.9
residual_bottom_0 y=0
residual_bottom_coupled y=0
residual_box_0 z=1.9
residual_relaxed_free y=0
residual_groove_coupled z=2.8
phase_free y=0
thermal_sphere y=2.8025
overhang_arch y=1.5
END
