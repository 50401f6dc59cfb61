#!/usr/bin/env bash
# A Slurm array of two shards with its merge, one shard killed half way: the atlas is that of a single
# run, to the byte. Exit status 77 where Slurm is absent.
#   array.sh PROGRAM
set -euo pipefail
export ABRDF=$1
here=$(cd "$(dirname "$0")" && pwd)
for tool in munged slurmctld slurmd sbatch; do
    if ! command -v "$tool" > /dev/null; then
        echo "skipped: $tool is absent (tests/packages.txt)"
        exit 77
    fi
done
folder=$(mktemp -d "${TMPDIR:-/tmp}/abrdf-slurm-XXXXXX")
chmod 755 "$folder"  # munged wants its socket reachable by all.
finish() {
    local status=$?
    bash "$here/cluster.sh" stop "$folder/cluster"
    if [ $status -ne 0 ]; then tail -n 40 "$folder"/*.log "$folder"/cluster/*.log 2> /dev/null || true; fi
    rm -rf "$folder"
}
trap finish EXIT
bash "$here/cluster.sh" start "$folder/cluster"
export SLURM_CONF=$folder/cluster/slurm.conf
cd "$folder"

job=(--texels full --method measured --compression piz)
"$ABRDF" demo cloth.zip --size 48 -q
"$ABRDF" convert cloth.zip -o single.exr "${job[@]}" -q
ABRDF_CORES=1 bash "$here/../../examples/slurm/submit.sh" 2 cloth.zip atlas.exr "${job[@]}"

# Kills the process that makes shard 1 once it has written some tiles.
process=
for ((try = 0; ; ++try)); do
    if [ -z "$process" ]; then
        process=$(grep -ls 'atlas[.]exr[.]1[.]exr' /proc/[0-9]*/cmdline | grep -o '[0-9]*' | head -n 1) || true
    fi
    size=$(stat -c %s .atlas.exr.1.exr.abrdf-partial 2> /dev/null || echo 0)
    if [ "$size" -gt 1000000 ]; then break; fi
    if [ $try -gt 6000 ]; then echo "shard 1 wrote nothing within a minute"; exit 1; fi
    sleep 0.01
done
kill -KILL "$process"

for ((try = 0; try < 1200; ++try)); do
    if [ -z "$(squeue -h)" ]; then break; fi
    sleep 0.1
done
squeue
cat atlas.exr.1.log
grep -q "back to the queue" atlas.exr.1.log
grep -q "from an earlier run" atlas.exr.1.log
cat atlas.exr.merge.log
cmp single.exr atlas.exr
if ls atlas.exr.[12].exr .atlas* 2> /dev/null; then echo "shards are left over"; exit 1; fi
echo "the same bytes"
