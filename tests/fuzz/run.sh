#!/usr/bin/env bash
# Fuzzes each target for SECONDS (60), or some: tests/fuzz/run.sh [SECONDS] [TARGET...]
# Prints executions, coverage and findings of each, and fails where anything was found. Crashing
# inputs are left in build/fuzz/found; put them into tests/fuzz/corpus/TARGET when mended. Logs, to
# which each run adds, are in build/fuzz/log, what was learned in build/fuzz/corpus.
# FUZZ_SEED=1: the same inputs each time, as far as the machine is as fast. FUZZ_BIN: programs that
# are built already, instead of build/fuzz/tests.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-60}
shift || true
targets=${*:-$(sed -n '/^set(fuzz_targets/,/)/p' tests/CMakeLists.txt | sed 's/set(fuzz_targets//; s/)//')}
if [ -z "${FUZZ_BIN:-}" ]; then
    cmake --preset fuzz > /dev/null
    cmake --build --preset fuzz
fi
bin=$(realpath "${FUZZ_BIN:-build/fuzz/tests}")
mkdir -p build/fuzz/found build/fuzz/log
failed=0
for target in $targets; do
    corpus=$PWD/build/fuzz/corpus/$target
    log=build/fuzz/log/$target.txt
    mkdir -p "$corpus"
    "$bin/fuzz_replay" "$target" --seeds "$corpus"
    if [ -d "tests/fuzz/corpus/$target" ]; then cp tests/fuzz/corpus/"$target"/* "$corpus"/; fi
    # libpng leaks a string where it stops at a fault, through OpenImageIO: not ours to mend.
    leaks=1
    case $target in image | zip | environment) leaks=0 ;; esac
    begin=$SECONDS
    end=$((SECONDS + seconds))
    # A finding ends the program: what is left of the time is a new run's.
    while [ $((end - SECONDS)) -gt 0 ]; do
        # OpenImageIO takes 64 MB at once for any image; twice that is 8192 times the longest input.
        if ABRDF_FUZZ_TARGET=$target "$bin/fuzz_target" "$corpus" -max_total_time=$((end - SECONDS)) -max_len=16384 \
            -malloc_limit_mb=128 -detect_leaks=$leaks -timeout=20 -rss_limit_mb=4096 \
            -print_final_stats=1 -seed="${FUZZ_SEED:-0}" \
            -artifact_prefix="$PWD/build/fuzz/found/$target-" > "$log.run" 2>&1; then
            done=1
        else
            done=0
            failed=1
        fi
        grep -vE '	(NEW|REDUCE|RELOAD|pulse) ' "$log.run" >> "$log" || true
        [ $done = 1 ] && break
        [ $((end - SECONDS)) -gt $((seconds / 2)) ] || break
    done
    rm -f "$log.run"
    echo "seconds: $((SECONDS - begin))" >> "$log"
    bash tests/fuzz/table.sh "$target"
done
exit $failed
