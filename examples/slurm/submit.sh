#!/usr/bin/env bash
# Converts one database on many machines: an array of N shards, then the merge of what they made.
#   bash examples/slurm/submit.sh N INPUT ATLAS.exr [options of abrdf convert]
#   SBATCH_TIMELIMIT=2:00:00 bash examples/slurm/submit.sh 16 corduroy.btf corduroy.exr --texels full
# Time, partition and account come from sbatch's own environment (SBATCH_*); memory and cores from
# ABRDF_MEMORY (1G) and ABRDF_CORES (4) a shard. ABRDF names the program, if not abrdf on the PATH.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
shards=$1 input=$2 atlas=$3
shift 3
export ABRDF=${ABRDF:-abrdf}
array=$(sbatch --parsable --array="1-$shards" --mem="${ABRDF_MEMORY:-1G}" \
    --cpus-per-task="${ABRDF_CORES:-4}" --output="$atlas.%a.log" \
    "$here/shard.sbatch" "$shards" "$input" "$atlas" "$@")
merge=$(sbatch --parsable --dependency="afterok:$array" --kill-on-invalid-dep=yes \
    --mem="${ABRDF_MEMORY:-1G}" --output="$atlas.merge.log" \
    "$here/merge.sbatch" "$shards" "$atlas")
echo "array $array, merge $merge"
