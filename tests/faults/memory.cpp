// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/fault_bench.h"

#include <algorithm>

namespace abrdf {

namespace {

constexpr long kMega = 1L << 20;

/// One run in too little memory; whether it had enough.
bool runShort(FaultBench& bench, const Job& job, const Attack& attack, const std::string& kind,
              const std::string& what) {
    bench.begin(job, true);
    const Outcome outcome = bench.run(job, attack);
    if (outcome.status == 0) {
        bench.expect(contentOf(bench.work() / job.output) == job.reference, "other bytes");
        return true;
    }
    bench.inject(kind, job.name + " with " + what);
    // Libraries say it in their own words; libzip takes it for a wrong file.
    bench.expectSentence(outcome, {"memory", "alloc", "Malloc", "zip archive"});
    bench.expectNothingHalf(job, false);
    return false;
}

void boundAddresses(FaultBench& bench, const Job& job) {
    const long step = (bench.isLong() ? 8 : 32) * kMega;
    std::size_t good = 0;
    for (long bytes = 0; good < 2 && bytes < 1024 * kMega; bytes += step) {
        Attack attack;
        attack.moreBytes = bytes;
        if (runShort(bench, job, attack, "address space (RLIMIT_AS)",
                     std::to_string(bytes / kMega) + " MB more")) {
            ++good;
        }
    }
}

/// From some call of operator new on there is nothing, not even for the words that say so.
void endMemory(FaultBench& bench, const Job& job) {
    const double growth = bench.isLong() ? 1.1 : 1.6;
    for (long news = 0; news < 1L << 30;
         news = std::max(news + 1, static_cast<long>(static_cast<double>(news) * growth))) {
        Attack attack;
        attack.news = news;
        if (runShort(bench, job, attack, "no memory from one operator new on",
                     std::to_string(news) + " calls that got some")) {
            return;
        }
    }
}

}  // namespace

void exhaustMemory(FaultBench& bench) {
    for (const Job& job : bench.jobs()) {
        if (!bench.isLong() && job.name != "angular") continue;
        boundAddresses(bench, job);
        endMemory(bench, job);
        bench.expectRerun(job, false);
    }
}

}  // namespace abrdf
