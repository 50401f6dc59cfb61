#!/usr/bin/env bash
# Installs what is missing, builds and runs every test; before that all but the slow ones and the jobs on whole maps
# under ASan and UBSan, with ten seconds of each fuzz target, and what runs on many threads under TSan.
# --sanitizers: these jobs too, some ten minutes more. --quick: without sanitizers.
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
suite() { # suite PRESET BUILD-PRESET [OPTION OF CTEST...]
    echo "== $1, from $((SECONDS / 60)) minutes on"
    cmake --preset "$1" > /dev/null
    cmake --build --preset "$2"
    ctest --preset "$1" -j"$(nproc)" "${@:3}"
}
can_fuzz() {
    echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
        clang++-14 -fsanitize=fuzzer,address,undefined -x c++ - -o /dev/null
}
can_find_races() { # Some kernels place memory where TSan of g++ 12 wants its own.
    local program
    program=$(mktemp)
    echo 'int main() {}' | g++ -fsanitize=thread -x c++ - -o "$program" && "$program"
    local status=$?
    rm -f "$program"
    return $status
}
if [ "${1:-}" != --quick ]; then
    some=(-E "^pipeline:")
    if [ "${1:-}" = --sanitizers ]; then some=(); fi
    if can_fuzz; then
        suite fuzz fuzz-tests "${some[@]}"
    else
        echo "== SKIPPED: fuzzing, for clang++-14 and its libFuzzer are absent (clang-14, libclang-rt-14-dev)" >&2
        suite asan asan "${some[@]}"
    fi
    if can_find_races; then
        suite tsan tsan
    else
        echo "== SKIPPED: TSan, for its programs do not run on this system" >&2
    fi
fi
suite release release
