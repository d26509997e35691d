# SPDX-License-Identifier: GPL-3.0-or-later
# What the cases share. A case is an awk program; with what = "deck" it prints the deck of a run, with what =
# "measure" it reads the run's animation file and prints one number. Variables given to it:
#   scheme  words joined by +, such as musl+bimp       words  the same as words of a deck
#   cells   resolution                                 dtsc   part of the stable time step; of smoothed particles: cfl
#   step    last time step of the run (measure only)

# Whether a word is part of the scheme.
function has(word) { return index("+" scheme "+", "+" word "+") > 0 }

# By how much the grid goes on behind a wall: supports that are wider than a cell need one more.
function beyond(size) { return has("gimp") || has("bimp") ? size : 0 }

# The first lines of a deck.
function head(title, points) {
    printf "mpm3d %s, %s, %d cells, dtsc %s\nnbco 1\nnbbo 1\nnbmp %d\nnmat 1\n", title, scheme, cells, dtsc, points
}

# The same for smoothed particles; the words of the scheme, and `more`, stand in their block.
function sph_head(title, bodies, points, more) {
    printf "mpm3d %s, %s, %d cells, dtsc %s\nmeth sph\nnbbo %d\nnbmp %d\nnmat 1\ndigits 12\n", title, scheme, cells, dtsc, bodies, points
    printf "sph\ndime 2\n%s\n%s\nends\n", words, more
}

# The first lines of a deck of reproducing kernel particles, up to the plane in their block; `more` stands before it.
function rkpm_head(title, more) {
    printf "mpm3d %s, %s, %d cells\nmeth rkpm\ndigits 12\n%s\nrkpm\ndime 2\n", title, scheme, cells, more
}

function absolute(x) { return x < 0 ? -x : x }

# Reads a Tecplot file: n rows of the present zone in value[row, name], those of the first zone in first[row, name]. A file
# without zones, of a row a step or problem, is one zone.
what == "measure" && FNR == 1 && /^VARIABLES/ { zones = 1 }
what == "measure" && /^VARIABLES/ {
    n_names = split($0, part, "\"")
    for (i = 2; i <= n_names; i += 2) name[i / 2] = part[i]
    next
}
what == "measure" && /^ZONE/ {
    zones++
    n = 0
    time = $0
    sub(/.*SOLUTIONTIME=/, "", time)
    time += 0
    next
}
what == "measure" && zones > 0 && NF > 2 {
    n++
    for (i = 1; i <= NF; i++) {
        value[n, name[i]] = $i
        if (zones == 1) first[n, name[i]] = $i
    }
}
