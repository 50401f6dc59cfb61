#!/usr/bin/env bash
# What fuzzing has done so far, a line a target, from the logs of tests/fuzz/run.sh:
# tests/fuzz/table.sh [TARGET...]
set -euo pipefail
cd "${FUZZ_WORK:-$(dirname "$0")/../../build/fuzz}/log"
targets=${*:-$(ls -- *.txt | sed 's/\.txt$//')}
for target in $targets; do
    awk -v target="$target" '
        /^stat::number_of_executed_units/ { executions += $2 }
        /^seconds: / { seconds += $2 }
        /^core: / { core += $2 }
        { for (i = 1; i < NF; ++i) {
              if ($i == "cov:" && $(i + 1) > cov) cov = $(i + 1)
              if ($i == "ft:" && $(i + 1) > ft) ft = $(i + 1) } }
        /^SUMMARY:/ { ++findings }
        END { printf "%-12s %10d executions %6d s  of a core %6d s  cov %6d  ft %6d  findings %d\n",
                     target, executions, seconds, core, cov, ft, findings }' "$target.txt"
done
