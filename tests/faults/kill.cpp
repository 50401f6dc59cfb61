// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/fault_bench.h"

#include <csignal>

namespace abrdf {

void killAtRandom(FaultBench& bench) {
    const std::size_t wanted = bench.isLong() ? 100 : 8;
    std::size_t killed = 0;
    for (std::size_t trial = 0; killed < wanted && trial < 3 * wanted; ++trial) {
        // Two of three are conversions, which can be resumed.
        const std::size_t jobs = bench.jobs().size();
        const Job& job = bench.jobs()[trial % 3 == 2 ? 3 + trial / 3 % (jobs - 3) : trial % 3];
        const bool old = trial % 4 == 3;
        const bool resume = !old;  // With --resume an old file of unknown origin is refused.
        bench.begin(job, old);
        Attack attack;
        attack.signal = SIGKILL;
        attack.after = bench.random() * job.seconds;
        const Outcome outcome = bench.run(job, attack, resume && job.resumable);
        if (outcome.status != -SIGKILL) continue;  // It was done already.
        ++killed;
        bench.inject("SIGKILL at a random moment",
                     job.name + " after " + std::to_string(attack.after) + " s");
        bench.expectNothingHalf(job, true);
        bench.expectRerun(job, resume);
    }
    bench.expect(killed == wanted, "only " + std::to_string(killed) + " runs could be killed");
}

void killAtCalls(FaultBench& bench) {
    const long most = bench.isLong() ? 1000 : 2;
    for (const Job& job : bench.jobs()) {
        if (!bench.isLong() && job.name != "angular" && job.name != "merge") continue;
        for (const char* call : {"rename", "unlink", "fsync", "write"}) {
            if (!bench.isLong() && call[0] != 'r' && call[0] != 'u') continue;
            for (const char* action : {"kill", "killafter"}) {
                // The first ones each, then ever fewer: images and journal lines are many and
                // alike.
                for (long number = 1; number <= most; number += 1 + number / 6) {
                    bench.begin(job, false);
                    Attack attack;
                    attack.fault = bench.faultAt(call, number, action);
                    const Outcome outcome = bench.run(job, attack, job.resumable);
                    if (outcome.status != -SIGKILL) break;  // It makes fewer of these calls.
                    bench.inject("SIGKILL before and after file calls",
                                 job.name + " " + attack.fault);
                    bench.expectNothingHalf(job, true);
                    bench.expectRerun(job, true);
                }
            }
        }
    }
}

}  // namespace abrdf
