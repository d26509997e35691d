#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs all tests with the programs in a build folder: sh tests/run.sh BUILD
# Every test prints `ok NAME` or `FAIL NAME: why` lines, or `skip NAME: why` where something is missing
# on this machine; the last line here counts them. A test that ends badly without a FAIL line counts
# as one failure, and so does one without any of these lines.
build=$(cd "$1" && pwd) || exit 2
cd "$(dirname "$0")/.." || exit 2
ASAN_OPTIONS=exitcode=99:${ASAN_OPTIONS:-}; export ASAN_OPTIONS
UBSAN_OPTIONS=exitcode=99:print_stacktrace=1:${UBSAN_OPTIONS:-}; export UBSAN_OPTIONS
# threads that wait go to sleep soon, as mpm3d itself sees to
GOMP_SPINCOUNT=${GOMP_SPINCOUNT:-1000} KMP_BLOCKTIME=${KMP_BLOCKTIME:-0}; export GOMP_SPINCOUNT KMP_BLOCKTIME
log=$(mktemp) || exit 2
all=$(mktemp) || exit 2
trap 'rm -f "$log" "$all"' EXIT INT TERM

# run NAME COMMAND...: keeps the FAIL lines and the messages visible, counts the rest
run() {
    name=$1; shift
    start=$(date +%s)
    "$@" >"$log" 2>&1
    status=$?
    failed=$(grep -c '^FAIL ' "$log")
    passed=$(grep -c '^ok ' "$log")
    skipped=$(grep -c '^skip ' "$log")
    if [ "$status" -ne 0 ] && [ "$failed" -eq 0 ]; then
        echo "FAIL $name: exit status $status" >>"$log"
        tail -n 20 "$log"
        failed=1
    elif [ "$failed" -gt 0 ]; then
        grep -v '^ok ' "$log"
    elif [ "$passed" -eq 0 ] && [ "$skipped" -eq 0 ]; then
        echo "FAIL $name: no check was run" | tee -a "$log"
        failed=1
    fi
    [ "$failed" -gt 0 ] || grep '^skip ' "$log"
    printf '%-28s %4d passed  %d failed  %d s\n' "$name" "$passed" "$failed" $(($(date +%s) - start))
    cat "$log" >>"$all"
}

for program in "$build"/tests/test_*; do
    case $program in *.d) continue ;; esac
    run "unit/$(basename "$program")" "$program"
done
run tools/test_tools sh tools/test_tools.sh "$build"
for script in tests/decks/*.sh tests/property/*.sh tests/cli/*.sh; do
    [ -f "$script" ] && run "${script#tests/}" sh "$script" "$build"
done
for reader in deck checkpoint stl; do
    run "fuzz/$reader" "$build/fuzz_replay_$reader" tests/fuzz/seeds_"$reader"/*
done
passed=$(grep -c '^ok ' "$all")
failed=$(grep -c '^FAIL ' "$all")
skipped=$(grep -c '^skip ' "$all")
[ "$skipped" -eq 0 ] || echo "$skipped skipped"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
