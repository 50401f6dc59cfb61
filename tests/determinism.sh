#!/usr/bin/env bash
# The same job gives the same bytes: determinism.sh [--short] PROGRAM [OTHER PROGRAM...]
# Runs jobs on 1 to 8 threads, in small and large memory, in shards, killed and resumed, and compares
# hashes. With other programs, from another compiler or at another -O, compares theirs with the first
# one's. Prints a line a job; exit status 1 where one program differs from itself or from another.
set -euo pipefail
threads_tried=(1 2 3 4 5 6 7 8)
short=no
if [ "$1" = --short ]; then
    short=yes
    threads_tried=(1 3 8)
    shift
fi
programs=()
for program in "$@"; do programs+=("$(realpath "$program")"); done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset OCIO ABRDF_THREADS CUE_THREADS SLURM_CPUS_PER_TASK
export XDG_CACHE_HOME=$work/cache
cd "$work"
first=${programs[0]}
differences=0

hash() { sha256sum < "$1" | cut -c1-16; }

# same NAME OUTPUT WORDS...: one job of one program, in every way that may not matter.
same() {
    local name=$1 output=$2 hashes ways=0
    shift 2
    : > hashes
    way() { "$@" > /dev/null 2> err || { cat err >&2; exit 1; }; hash "$output" >> hashes; rm "$output"; ways=$((ways + 1)); }
    for threads in "${threads_tried[@]}"; do way "$@" -o "$output" --threads $threads; done
    if [ "$2" = convert ]; then
        way "$@" -o "$output" --memory 4G
        local smallest
        smallest=$("$@" -o "$output" --memory 1M 2>&1 | sed -n 's/.*works is \([0-9]*\)M.*/\1/p' || true)
        way "$@" -o "$output" --memory "$((smallest + 8))M"
        "$@" -o part1.exr --shard 1/2 > /dev/null 2>&1
        "$@" -o part2.exr --shard 2/2 > /dev/null 2>&1
        way "$1" merge part2.exr part1.exr -o "$output"
        { timeout -s KILL 0.3 "$@" -o "$output" --resume || true; } > /dev/null 2>&1
        way "$@" -o "$output" --resume
    fi
    hashes=$(sort -u hashes)
    if [ "$(wc -l <<< "$hashes")" -ne 1 ]; then
        hashes=DIFFERS
        differences=$((differences + 1))
    fi
    printf '%-10s %2d runs  %s\n' "$name" $ways "$hashes"
}

# between NAME OUTPUT WORDS...: the same job by every program.
between() {
    local name=$1 output=$2 line="" reference="" result
    shift 2
    for program in "${programs[@]}"; do
        "$program" "$@" > /dev/null 2> err || { cat err >&2; exit 1; }
        result=$(hash "$output")
        [ -n "$reference" ] || { reference=$result; cp "$output" reference; }
        if [ "$result" = "$reference" ]; then
            line+=" same"
        else
            line+=" DIFFERS($(cmp -l reference "$output" 2> /dev/null | wc -l)_bytes)"
            differences=$((differences + 1))
        fi
        rm "$output"
    done
    printf '%-10s%s\n' "$name" "$line"
}

"$first" demo cloth.zip --size 8 -q
"$first" train --plan greedy:40 --materials 100 -o m.model -q > /dev/null
full=(convert cloth.zip --texels full)
same prior a.exr "$first" "${full[@]}" --plan greedy:40 --model m.model
same spatial a.exr "$first" "${full[@]}" --method measured --layout spatial
if [ $short = yes ]; then
    echo "$differences differences"
    exit $differences
fi
same train train.model "$first" train --plan greedy:40 --materials 100
same measured a.exr "$first" "${full[@]}" --method measured
same published a.exr "$first" "${full[@]}" --method published
"$first" "${full[@]}" --method measured -o map.exr -q > /dev/null
same preview a.png "$first" preview map.exr --size 48x48
same export a.bin "$first" export map.exr --to utia-bin

if [ ${#programs[@]} -gt 1 ]; then
    echo "between programs: ${*}"
    between demo a.zip demo a.zip --size 4
    between demo-hdr a.zip demo a.zip --size 4 --hdr
    between train a.model train --plan greedy:40 --materials 200 -o a.model
    for method in measured published nearest idw rbf microfacet constant; do
        between $method a.exr "${full[@]}" --method $method -o a.exr
    done
    between prior a.exr "${full[@]}" --plan greedy:40 --model m.model -o a.exr
    between average a.exr convert cloth.zip --plan greedy:40 --model m.model -o a.exr
    between grid a.exr convert cloth.zip --method measured --grid utia288 -o a.exr
    between sphere a.png preview map.exr --size 48x48 -o a.png
    between drape a.exr preview map.exr --size 48x48 --kind drape --environment sky -o a.exr
    between export a.bin export map.exr --to utia-bin -o a.bin
fi
echo "$differences differences"
[ $differences -eq 0 ]
