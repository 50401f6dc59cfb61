#!/usr/bin/env bash
# SECONDS (10) of each fuzz target, two at a time, for CI: tests/fuzz/smoke.sh [SECONDS]
# Needs clang-14 and libclang-rt-14-dev; exits with 77, which ctest takes for skipped, without them.
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' > "$folder/a.cpp"
if ! clang++-14 -fsanitize=fuzzer,address "$folder/a.cpp" -o "$folder/a" 2> /dev/null; then
    echo "skipped: clang++-14 with libFuzzer is absent (clang-14, libclang-rt-14-dev)"
    exit 77
fi
cmake --preset fuzz > /dev/null
cmake --build --preset fuzz
export FUZZ_BIN=build/fuzz/tests FUZZ_SEED=1
bash tests/fuzz/targets.sh | xargs -n 1 -P 2 bash tests/fuzz/run.sh "${1:-10}"
