#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The accuracy studies: sh tests/report/report.sh BUILD FOLDER [smoke|quick|full]
# Runs every case of cases.table at its resolutions, schemes and time steps, one run after another on one thread, and
# writes FOLDER/table.txt (a row a run), charts FOLDER/*.svg and the page FOLDER/index.html. Every number is of these runs.
# A run that fails stays in the table with its exit status.
build=$(cd "$1" && pwd) && here=$(cd "$(dirname "$0")" && pwd) && mkdir -p "$2/work" && folder=$(cd "$2" && pwd) || exit 4
size=${3:-full}
case $size in smoke) column=1 ;; quick) column=2 ;; full) column=3 ;; *) echo "report: smoke, quick or full, not $size" >&2; exit 1 ;; esac
work=$folder/work runs=$folder/work/runs.txt
started=$(date +%s)

trim() { echo "$1" | sed 's/^ *//; s/ *$//'; }

# The words of a deck for a scheme; fails for one that is in no row of schemes.table.
words_of() {
    awk -F'|' -v scheme="$1" '
        /^#/ { next }
        { word = $1; gsub(/ /, "", word); text = $2; sub(/^ */, "", text); sub(/ *$/, "", text); words[word] = text }
        END {
            n = split(scheme, part, "+")
            for (i = 1; i <= n; i++) {
                if (!(part[i] in words)) { print "report: no scheme " part[i] >"/dev/stderr"; exit 1 }
                if (words[part[i]] != "") line = line words[part[i]] " "
            }
            print line
        }' "$here/schemes.table"
}

# case_program WHAT FILE...: the program of the case with its variables
case_program() {
    what=$1; shift
    awk -v what="$what" -v scheme="$scheme" -v words="$words" -v cells="$cells" -v dtsc="$dtsc" -v step="${step:-0}" "$@"
}

# The value measured of the run just done, or nan.
measure() {
    case $measured in measure*)
        ending=${measured#measure} ending=${ending# }
        case $program+$scheme in *+rkpm* | rkpm_*) ;; *) ending= ;; esac # material points beside them write none such
        case_program measure $assignments -f "$here/common.awk" -f "$here/$program.awk" "$work/$job${ending:-_anim.dat}"
        return ;;
    esac
    set -- $measured
    ending=$1; shift
    for word in "$@"; do shift; set -- "$@" "$(echo "$word" | tr '~' ' ')"; done
    "$build/tecstat" "$work/$job$ending" "$@"
}

# Seconds, particle-steps (of quas: applications of the stiffness to the particles; of reproducing kernel particles nodes times
# problems or steps) and bytes (of those: columns and matrix), from the log of the run.
read_log() {
    awk '/bytes per particle/ { bytes = $2 }
        /^[0-9]+ nodes[:,]/ { particles = $1 }
        / matrix of [0-9]+ bytes/ { line = $0; sub(/.* matrix of /, "", line); matrix = line + 0 }
        /^columns in use/ { is_column = particles > 0; next }
        is_column && NF == 3 { columns += $3 }
        NF != 3 { is_column = 0 }
        /^finished after/ { steps = $3 }
        /^finished at step/ { steps = $4 + 0 }
        / particles in .* bodies/ && !particles { particles = $1 }
        $1 == "total" && NF > 5 { seconds = $2 }
        /the stiffness was applied/ { applied = $5 }
        / after [0-9]* steps at time/ { for (i = 1; i < NF; i++) if ($i == "after") steps = $(i + 1) }
        / DT=/ { line = $0; sub(/.*DT= */, "", line); split(line, part, " "); step = part[1] }
        END {
            if (seconds < 0.001) seconds = 0.001
            printf "%s %.0f %.0f %s\n", seconds, particles * (applied ? applied : steps), particles * bytes + columns + matrix, step ? step : 0
        }' "$work/$job.out"
}

# One run: a row of runs.txt: case scheme cells dtsc status value seconds particle_steps bytes
one_run() {
    job=$(echo "$case_name-$scheme-$cells-$dtsc" | tr '+.' '__')
    case_program deck $assignments -f "$here/common.awk" -f "$here/$program.awk" >"$work/$job.mpm" || exit 4
    rm -f "$work/$job.out"
    "$build/mpm3d" --quiet --threads 1 -o "$work" "$work/$job.mpm" >"$work/$job.said" 2>&1
    status=$?
    numbers="nan nan nan 0" found=nan
    [ -f "$work/$job.out" ] && numbers=$(read_log)
    for repetition in 2 3; do # short times scatter: the least of three
        [ "$status" -eq 0 ] && echo "$numbers" | awk '{ exit $1 > 0.1 }' || break
        "$build/mpm3d" --quiet --threads 1 -o "$work" "$work/$job.mpm" >"$work/$job.said" 2>&1
        numbers=$({ echo "$numbers"; read_log; } | sort -n | head -n 1)
    done
    step=${numbers##* }
    [ "$status" -eq 0 ] && found=$(measure 2>>"$work/$job.said")
    echo "$case_name $scheme $cells $dtsc $status ${found:-nan} ${numbers% *}" | tee -a "$runs"
    rm -f "$work/${job}_anim.dat" "$work/${job}_energy.dat" "$work/${job}_momentum.dat" "$work/${job}_curv.dat" "$work/${job}_error.dat"
}

: >"$runs"
grep -v '^#' "$here/cases.table" >"$work/cases" || exit 4
while IFS='|' read -r name program schemes steps sizes measured answer good_to <&3; do
    case_name=$(trim "$name") measured=$(trim "$measured")
    set -- $program
    program=$1; shift
    assignments=
    for assignment in "$@"; do assignments="$assignments -v $assignment"; done
    [ "$size" = full ] || steps=$(echo $steps | cut -d' ' -f1)
    for cells in $(echo "$sizes" | cut -d';' -f$column); do
        for scheme in $schemes; do
            words=$(words_of "$scheme") || exit 4
            for dtsc in $steps; do
                one_run
                case +$scheme+ in *+quas+* | *+rkpm+*) break ;; esac # have no dtsc
            done
        done
    done
done 3<"$work/cases"

awk -f "$here/table.awk" "$work/cases" "$runs" >"$folder/table.txt" || exit 4
rm -f "$folder"/*.svg
for case_name in $(awk 'NR > 1 && !seen[$1]++ { print $1 }' "$folder/table.txt"); do
    good_to=$(awk -F'|' -v c="$case_name" '{ gsub(/ /, ""); if ($1 == c) print $8 }' "$work/cases")
    least= # what the label says of errors that count as that of the answer
    [ "$good_to" = 0 ] || least=", at least $good_to"
    awk -v c="$case_name" -v good_to="$good_to" 'NR > 1 && $5 != "nan" && $5 + 0 < good_to + 0 { $5 = good_to }
        NR == 1 || $1 == c' "$folder/table.txt" >"$work/$case_name.chart"
    first=$(awk 'NR == 2 { print $4 }' "$work/$case_name.chart")
    awk -v d="$first" 'NR == 1 || $4 == d || $4 == "-"' "$work/$case_name.chart" >"$work/$case_name.order"
    "$build/tecview" curve "$work/$case_name.chart" --x seconds --y error --group scheme --pareto --log xy \
        --xlabel "run time" --ylabel "relative error$least" --unit s,1 --title "$case_name: error against run time" \
        --out "$folder/$case_name-time.svg" 2>>"$work/tecview.said"
    "$build/tecview" curve "$work/$case_name.order" --x cells --y error --group scheme --points --log xy \
        --xlabel "resolution, cells" --ylabel "relative error$least" --unit 1,1 --title "$case_name: error against resolution" \
        --out "$folder/$case_name-order.svg" 2>>"$work/tecview.said"
done
awk -v size="$size" -v folder="$folder" -v here="$here" -v version="$("$build/mpm3d" --version)" -v machine="$(uname -sm)" \
    -v seconds_all=$(($(date +%s) - started)) -f "$here/page.awk" "$work/cases" "$folder/table.txt" >"$folder/index.html" || exit 4
echo "$folder/index.html: $(($(wc -l <"$folder/table.txt") - 1)) runs in $(($(date +%s) - started)) s"
