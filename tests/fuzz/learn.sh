#!/usr/bin/env bash
# Keeps in tests/fuzz/corpus/TARGET/learned_* what a campaign of tests/fuzz/run.sh has learned, as far as a
# few small files hold it: tests/fuzz/learn.sh [TARGET...]
# At most FILES (9) and BYTES (14000) a target, chosen by new features a byte. Findings, which have other
# names there, stay as they are.
set -euo pipefail
cd "$(dirname "$0")/../.."
bin=$(realpath "${FUZZ_BIN:-build/fuzz/tests}")
learned=$(realpath "${FUZZ_WORK:-build/fuzz}/corpus")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for target in ${*:-$(bash tests/fuzz/targets.sh)}; do
    [ -d "$learned/$target" ] || continue
    rm -rf "$work"/*
    mkdir "$work/merged"
    leaks=1
    case $target in image | zip | environment) leaks=0 ;; esac
    # Its control file says which features each input reaches.
    ABRDF_FUZZ_TARGET=$target ASAN_OPTIONS=detect_leaks=$leaks "$bin/fuzz_target" -set_cover_merge=1 -merge_control_file="$work/control" \
        -detect_leaks=$leaks -malloc_limit_mb=128 -max_len=16384 "$work/merged" "$learned/$target" > "$work/log" 2>&1
    mkdir -p "tests/fuzz/corpus/$target"
    rm -f "tests/fuzz/corpus/$target"/learned_*
    awk -v most="${FILES:-9}" -v room="${BYTES:-14000}" '
        FNR > 2 && /^\// { name[count++] = $0 }
        $1 == "STARTED" { size[$2] = $3 }
        $1 == "FT" { features[$2] = $0 }
        END {
            while (most-- > 0) {
                best = -1
                score = 0
                for (i in features) {
                    if (size[i] > room) continue
                    new = 0
                    n = split(features[i], f, " ")
                    for (k = 3; k <= n; ++k) new += !(f[k] in seen)
                    if (new / (size[i] + 4000) > score) { score = new / (size[i] + 4000); best = i }
                }
                if (best < 0) break
                n = split(features[best], f, " ")
                for (k = 3; k <= n; ++k) seen[f[k]]
                room -= size[best]
                print name[best]
            }
        }' "$work/control" |
        while read -r file; do
            cp "$file" "tests/fuzz/corpus/$target/learned_$(sha256sum < "$file" | cut -c1-8)"
        done
    echo "$target: $(ls "$learned/$target" | wc -l) learned, $(ls "$work/merged" | wc -l) of use," \
         "$(cat "tests/fuzz/corpus/$target"/learned_* | wc -c) bytes kept"
done
