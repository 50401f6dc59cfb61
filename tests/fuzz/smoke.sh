#!/usr/bin/env bash
# Ten seconds of each fuzz target, for CI. Needs clang-14 and libclang-rt-14-dev; exits with 77,
# which ctest takes for skipped, where they are absent.
set -euo pipefail
source=$(mktemp -d)
trap 'rm -rf "$source"' EXIT
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' > "$source/a.cpp"
if ! clang++-14 -fsanitize=fuzzer,address "$source/a.cpp" -o "$source/a" 2> /dev/null; then
    echo "skipped: clang++-14 with libFuzzer is absent (clang-14, libclang-rt-14-dev)"
    exit 77
fi
FUZZ_SEED=1 bash "$(dirname "$0")/run.sh" "${1:-10}"
