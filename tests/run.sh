#!/usr/bin/env bash
# Installs what is missing, builds, runs every test. --sanitizers: under ASan+UBSan and TSan as well.
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
if [ "${1:-}" = --sanitizers ]; then
    for preset in asan tsan; do
        echo "== $preset"
        cmake --preset "$preset" > /dev/null
        cmake --build --preset "$preset"
        ctest --preset "$preset" -j"$(nproc)"
    done
fi
echo "== release"
cmake --preset release > /dev/null
cmake --build --preset release
ctest --preset release -j"$(nproc)"
