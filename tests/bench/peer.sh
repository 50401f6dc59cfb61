#!/usr/bin/env bash
# The peer: oiiotool decodes, linearises and averages the images that abrdf reads for one texel, as
# many at once as there are cores; then abrdf does the same and reconstructs and writes as well.
#   peer.sh ABRDF DATABASE.zip
set -euo pipefail
abrdf=$1 database=$2
config=$(cd "$(dirname "$0")/../.." && pwd)/color/config.ocio
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$abrdf" convert "$database" -o "$folder/a.exr" --plan greedy:204 -q
"$abrdf" convert "$database" -o "$folder/a.exr" --plan greedy:204 --dry-run --json |
    sed -n 's/^ *"\(.*\): \(.*\.jpg\)",\{0,1\}$/\2/p' > "$folder/names"
(cd "$folder" && xargs -d '\n' python3 -c '
import sys, zipfile
z = zipfile.ZipFile(sys.argv[1])
[z.extract(n) for n in sys.argv[2:]]' "$database" < names)
seconds() { local start; start=$(date +%s.%N); "$@" > /dev/null; echo "$(date +%s.%N) $start" | awk '{print $1 - $2}'; }
average() {
    (cd "$folder" && xargs -d '\n' -P "$(nproc)" -I{} oiiotool --threads 1 --colorconfig "$config" {} \
        --colorconvert "sRGB - Texture" "Linear Rec.709 (sRGB)" --resize:filter=box 1x1 -o "{}.exr" < names)
}
peer=$(seconds average)
ours=$(seconds "$abrdf" convert "$database" -o "$folder/a.exr" --plan greedy:204 -q)
echo "$(wc -l < "$folder/names") images: oiiotool $peer s, abrdf $ours s: $(echo "$peer $ours" | awk '{print $1 / $2}') x"
