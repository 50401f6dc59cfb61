#!/usr/bin/env bash
# Installs what is missing, builds, runs ten seconds of each fuzz target and then every test.
# --sanitizers: before that all but the slow tests with clang under ASan and UBSan, and what runs on many
# threads under TSan. --quick: the tests alone.
set -euo pipefail
cd "$(dirname "$0")/.."
bash examples/install_packages.sh
bash examples/install_packages.sh tests/packages.txt
# A browser and npm packages for the page's tests; without them these are skipped.
browser=()
command -v chromium > /dev/null || browser+=(chromium)
command -v node > /dev/null || browser+=(nodejs)
command -v npm > /dev/null || browser+=(npm)
if [ ${#browser[@]} -gt 0 ]; then
    bash examples/install_packages.sh <(printf '%s\n' "${browser[@]}") || echo "no ${browser[*]}: the page's tests are skipped"
fi
(cd tests/page && npm ci --silent) || echo "no npm packages: the page's tests are skipped"
# Tests write stacks of thousands of small files; memory is kinder to them than a disk.
if [ -w /dev/shm ]; then export TMPDIR=${TMPDIR:-/dev/shm}; fi
suite() { # suite PRESET BUILD-PRESET
    echo "== $1"
    cmake --preset "$1" > /dev/null
    cmake --build --preset "$2"
    ctest --preset "$1" -j"$(nproc)"
}
can_fuzz() {
    echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
        clang++-14 -fsanitize=fuzzer,address,undefined -x c++ - -o /dev/null
}
if [ "${1:-}" = --quick ]; then
    echo "== without fuzzing"
elif ! can_fuzz; then
    echo "== SKIPPED: fuzzing, for clang++-14 and its libFuzzer are absent (clang-14, libclang-rt-14-dev)" >&2
    if [ "${1:-}" = --sanitizers ]; then suite asan asan; fi
elif [ "${1:-}" = --sanitizers ]; then
    suite fuzz fuzz-all
else
    echo "== fuzz"
    cmake --preset fuzz > /dev/null
    cmake --build --preset fuzz
    ctest --preset fuzz -L fuzz
fi
if [ "${1:-}" = --sanitizers ]; then suite tsan tsan; fi
suite release release
