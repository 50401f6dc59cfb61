#!/usr/bin/env bash
# The names of all fuzz targets, as tests/CMakeLists.txt has them.
sed -n '/^set(fuzz_targets/,/)/p' "$(dirname "$0")/../CMakeLists.txt" |
    sed 's/set(fuzz_targets//; s/)//' | tr -s ' \n' '\n' | sed '/^$/d'
