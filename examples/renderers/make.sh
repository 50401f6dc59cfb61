#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# One material in four renderers: scenes for all, pictures by those that are installed.
#   bash examples/renderers/make.sh [ATLAS.exr [FOLDER]]
set -euo pipefail
abrdf=$(command -v abrdf || echo "$(dirname "$0")/../../build/run/abrdf")
folder=${2:-renderers}
mkdir -p "$folder"
atlas=${1:-$folder/cloth.exr}
if [ ! -e "$atlas" ]; then
    [ -e "$folder/cloth" ] || "$abrdf" demo "$folder/cloth"
    "$abrdf" convert "$folder/cloth" -o "$atlas" --texels 32x32
fi
render() { # PROGRAM COMMAND
    "$abrdf" export "$atlas" --scene "$1" -o "$folder/$1"
    if command -v "${2%% *}" >/dev/null; then
        (cd "$folder/$1" && bash -c "$2")
    else
        echo "$1: not rendered, ${2%% *} is not installed"
    fi
}
render mitsuba "mitsuba -m scalar_spectral scene.xml -o picture.exr"
render pbrt "pbrt scene.pbrt"
render radiance "oconv scene.rad > scene.oct && rpict -ab 1 -vp 0 -4 2.2 -vd 0 4 -2.2 -vu 0 0 1 -vh 28 -vv 28 scene.oct > picture.hdr"
render blender "blender -b -P scene.py -- picture.exr"
for picture in "$folder"/*/picture.*; do
    [ -e "$picture" ] && echo "look at $picture"
done
