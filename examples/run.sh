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
echo "1/5  a virtual cloth, 64 x 64 texels, 81 lights x 81 views: $out/cloth.zip"
"$abrdf" demo "$out/cloth.zip"
echo "2/5  its atlas, reconstructed from eight slices: $out/cloth.exr (training once, a quarter of a minute)"
"$abrdf" convert "$out/cloth.zip" -o "$out/cloth.exr" --report "$out/cloth.json"
echo "3/5  the reconstruction beside the full measurement: $out/cloth.png"
"$abrdf" evaluate "$out/cloth.zip" --method published,prior --sheet "$out/cloth.png" --report "$out/evaluate.json"
echo "4/5  the cloth, draped, under a clear sky: $out/drape.png"
"$abrdf" convert "$out/cloth.zip" -o "$out/map.exr" --texels full -q
"$abrdf" preview "$out/map.exr" --kind drape --environment sky --exposure 1.6 -o "$out/drape.png"
echo "5/5  a page to turn it on: $out/cloth.html"
"$abrdf" convert "$out/cloth.zip" -o "$out/measured.exr" --method measured -q
"$abrdf" report "$out" -o "$out/cloth.html" --title "A virtual cloth"
echo
echo "Look at $root/$out/cloth.png and drape.png, and open cloth.html in a browser"
