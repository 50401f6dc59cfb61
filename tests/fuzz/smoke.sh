#!/usr/bin/env bash
# SECONDS (10) of each fuzz target, two at a time, as CI runs it: tests/fuzz/smoke.sh [SECONDS [PROGRAMS]]
# PROGRAMS: the folder of fuzz_target, which is built if it is not given. Begins from the corpus in
# tests/fuzz, the same each time, and leaves the campaign in build/fuzz/{corpus,log} alone.
set -euo pipefail
cd "$(dirname "$0")/../.."
if [ -n "${2:-}" ]; then
    FUZZ_BIN=$(realpath "$2")
else
    cmake --preset fuzz > /dev/null
    cmake --build --preset fuzz
    FUZZ_BIN=$PWD/build/fuzz/tests
fi
export FUZZ_BIN FUZZ_SEED=1 FUZZ_WORK=$PWD/build/fuzz/smoke
rm -rf "$FUZZ_WORK"
targets=$(bash tests/fuzz/targets.sh)
[ -n "$targets" ]  # Without any, nothing would be fuzzed, and nothing found.
echo "$targets" | xargs -n 1 -P 2 bash tests/fuzz/run.sh "${1:-10}"
