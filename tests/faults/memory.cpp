// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/fault_bench.h"

namespace abrdf {

void exhaustMemory(FaultBench& bench) {
    constexpr long kMega = 1L << 20;
    for (const Job& job : bench.jobs()) {
        if (!bench.isLong() && job.name != "angular") continue;
        const long step = (bench.isLong() ? 8 : 32) * kMega;
        std::size_t good = 0;
        for (long bytes = 0; good < 2 && bytes < 1024 * kMega; bytes += step) {
            bench.begin(job, true);
            Attack attack;
            attack.moreBytes = bytes;
            const Outcome outcome = bench.run(job, attack);
            if (outcome.status == 0) {
                ++good;
                bench.expect(contentOf(bench.work() / job.output) == job.reference, "other bytes");
                continue;
            }
            bench.inject("address space (RLIMIT_AS)",
                         job.name + " with " + std::to_string(bytes / kMega) + " MB more");
            // Libraries say it in their own words; libzip takes it for a wrong file.
            bench.expectSentence(outcome, {"memory", "alloc", "Malloc", "zip archive"});
            bench.expectNothingHalf(job, false);
        }
        bench.expectRerun(job, false);
    }
}

}  // namespace abrdf
