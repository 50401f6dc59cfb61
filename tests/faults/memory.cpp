// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/fault_bench.h"

namespace abrdf {

namespace {

constexpr long kMega = 1L << 20;

/// The address space in which the program can be loaded and say its version.
long loadable(const FaultBench& bench) {
    for (long bytes = 16 * kMega;; bytes += 4 * kMega) {
        Attack attack;
        attack.addressBytes = bytes;
        if (JobRun({"--version"}, bench.work(), attack).end().status == 0) return bytes;
    }
}

}  // namespace

void exhaustMemory(FaultBench& bench) {
    const long least = loadable(bench);
    for (const Job& job : bench.fewJobs()) {
        const long step = (bench.isLong() ? 4 : 24) * kMega;
        std::size_t good = 0;
        for (long bytes = least; good < 2 && bytes < least + 2048 * kMega; bytes += step) {
            bench.begin(job, true);
            Attack attack;
            attack.addressBytes = bytes;
            const Outcome outcome = bench.run(job, attack);
            if (outcome.status == 0) {
                ++good;
                bench.expect(contentOf(bench.work() / job.output) == job.reference, "other bytes");
                continue;
            }
            bench.inject("address space (ulimit -v)",
                         job.name + " in " + std::to_string(bytes / kMega) + " MB");
            bench.expectSentence(outcome, {"memory"});
            bench.expectNothingHalf(job, false);
        }
        bench.expectRerun(job, false);
    }
}

}  // namespace abrdf
