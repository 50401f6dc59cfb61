#!/usr/bin/env bash
# Fuzzes each reader for SECONDS (60), or one target: tests/fuzz/run.sh [SECONDS] [TARGET...]
# Crashing inputs are left in build/fuzz/found; put them into tests/fuzz/corpus/TARGET when mended.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-60}
shift || true
targets=${*:-btf rgl mbsdf merl utia_bin exr image zip manifest names}
cmake --preset fuzz > /dev/null
cmake --build --preset fuzz
mkdir -p build/fuzz/found
for target in $targets; do
    corpus=build/fuzz/corpus/$target
    mkdir -p "$corpus"
    build/fuzz/tests/fuzz_replay "$target" --seeds "$corpus"
    if [ -d "tests/fuzz/corpus/$target" ]; then cp tests/fuzz/corpus/"$target"/* "$corpus"/; fi
    echo "== $target"
    # libpng leaks a string where it stops at a fault, through OpenImageIO: not ours to mend.
    leaks=1
    if [ "$target" = image ] || [ "$target" = zip ]; then leaks=0; fi
    # OpenImageIO takes 64 MB at once for any image; twice that is 8192 times the longest input.
    build/fuzz/tests/fuzz_"$target" "$corpus" -max_total_time="$seconds" -max_len=16384 \
        -malloc_limit_mb=128 -detect_leaks=$leaks -timeout=20 -rss_limit_mb=4096 -print_final_stats=0 -verbosity=0 \
        -artifact_prefix=build/fuzz/found/"$target"-
done
