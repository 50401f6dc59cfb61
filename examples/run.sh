#!/usr/bin/env bash
# Builds abrdf, makes a virtual cloth, reconstructs it from some 200 samples, and shows it beside the
# full measurement. Everything goes to examples/out.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
bash examples/install_packages.sh
cmake --preset release -DBUILD_TESTING=OFF -B build/run > /dev/null
cmake --build build/run

abrdf=build/run/abrdf
out=examples/out
mkdir -p "$out"
echo "1/3  a virtual cloth, 64 x 64 texels, 81 lights x 81 views: $out/cloth.zip"
"$abrdf" demo "$out/cloth.zip"
echo "2/3  its atlas, reconstructed from eight slices: $out/cloth.exr (training once, a quarter of a minute)"
"$abrdf" convert "$out/cloth.zip" -o "$out/cloth.exr" --report "$out/cloth.json"
echo "3/3  the reconstruction beside the full measurement: $out/cloth.png"
"$abrdf" evaluate "$out/cloth.zip" --method published,prior --sheet "$out/cloth.png"
echo
echo "Look at $root/$out/cloth.png"
