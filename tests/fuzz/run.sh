#!/usr/bin/env bash
# Fuzzes each target for SECONDS (60), or some: tests/fuzz/run.sh [SECONDS] [TARGET...]
# Prints executions, coverage and findings of each, and fails where anything was found. Crashing
# inputs are left in build/fuzz/found; put them into tests/fuzz/corpus/TARGET when mended. Logs, to
# which each run adds, are in build/fuzz/log, what was learned in build/fuzz/corpus.
# Both seconds of the clock and of a core are counted: other work on the machine takes some of the former.
# FUZZ_SEED=1: the same inputs each time, as far as the machine is as fast. FUZZ_BIN: programs that
# are built already, instead of build/fuzz/tests. FUZZ_WORK: instead of build/fuzz.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-60}
shift || true
targets=${*:-$(bash tests/fuzz/targets.sh)}
if [ -z "${FUZZ_BIN:-}" ]; then
    cmake --preset fuzz > /dev/null
    cmake --build --preset fuzz
fi
bin=$(realpath "${FUZZ_BIN:-build/fuzz/tests}")
export FUZZ_WORK=${FUZZ_WORK:-$PWD/build/fuzz}
mkdir -p "$FUZZ_WORK/found" "$FUZZ_WORK/log"
failed=0
for target in $targets; do
    corpus=$FUZZ_WORK/corpus/$target
    log=$FUZZ_WORK/log/$target.txt
    mkdir -p "$corpus"
    "$bin/fuzz_replay" "$target" --seeds "$corpus"
    if [ -d "tests/fuzz/corpus/$target" ]; then cp tests/fuzz/corpus/"$target"/* "$corpus"/; fi
    # libpng leaks a string where it stops at a fault, through OpenImageIO: not ours to mend.
    leaks=1
    case $target in image | zip | environment) leaks=0 ;; esac
    begin=$SECONDS
    core=0
    # A finding ends the program: what is left of the time is a new run's.
    for ((run = 0; run < 20 && SECONDS < begin + seconds; ++run)); do
        good=1
        # OpenImageIO takes 64 MB at once for any image; twice that is 8192 times the longest input.
        used=$( { TIMEFORMAT=%U; time ABRDF_FUZZ_TARGET=$target ASAN_OPTIONS=detect_leaks=$leaks \
            "$bin/fuzz_target" "$corpus" -max_len=16384 \
            -max_total_time=$((begin + seconds - SECONDS)) -malloc_limit_mb=128 -timeout=20 \
            -detect_leaks=$leaks -rss_limit_mb=4096 -print_final_stats=1 \
            -seed="${FUZZ_SEED:-0}" -artifact_prefix="$FUZZ_WORK/found/$target-" \
            > "$log.run" 2>&1; } 2>&1 ) || good=0
        used=${used##*$'\n'}
        core=$((core + ${used%.*}))
        # One that was killed has no figures of its own but those of its last line.
        if ! grep -aq '^stat::number_of_executed_units' "$log.run"; then
            sed -n 's/^#\([0-9]*\)\t.*/stat::number_of_executed_units: \1/p' "$log.run" | tail -n 1 >> "$log"
            grep -a 'cov: ' "$log.run" | tail -n 1 >> "$log" || true
        fi
        grep -avE '	(NEW|REDUCE|RELOAD|pulse) |NEW_FUNC' "$log.run" >> "$log" || true
        [ $good = 1 ] && break
        failed=1
    done
    rm -f "$log.run"
    printf 'seconds: %d\ncore: %d\n' $((SECONDS - begin)) "$core" >> "$log"
    bash tests/fuzz/table.sh "$target"
done
exit $failed
