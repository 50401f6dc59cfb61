// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/fault_bench.h"

#include <array>
#include <csignal>

namespace abrdf {

void interrupt(FaultBench& bench) {
    const std::size_t wanted = bench.isLong() ? 60 : 8;
    std::size_t sent = 0;
    for (std::size_t trial = 0; sent < wanted && trial < 3 * wanted; ++trial) {
        const Job& job = bench.jobs()[trial % bench.jobs().size()];
        const int signal = std::array<int, 3>{SIGINT, SIGTERM, SIGHUP}[trial % 3];
        const bool resume = trial / bench.jobs().size() % 2 == 1;
        bench.begin(job, !resume);
        Attack attack;
        attack.signal = signal;
        attack.after = bench.random() * job.seconds;
        const Outcome outcome = bench.run(job, attack, resume && job.resumable);
        if (outcome.status == 0) continue;  // It was done already.
        ++sent;
        bench.inject("SIGINT, SIGTERM, SIGHUP", job.name + " signal " + std::to_string(signal));
        bench.expect(outcome.status == -signal,
                     "status " + std::to_string(outcome.status) + ": " + outcome.err);
        // Before main() there is nobody to say it.
        bench.expect(outcome.err.empty() || outcome.err.find("interrupted") != std::string::npos,
                     "no word of it: " + outcome.err);
        bench.expectNothingHalf(job, resume);
        bench.expectRerun(job, resume);
    }
    bench.expect(sent == wanted, "only " + std::to_string(sent) + " runs were interrupted");
}

}  // namespace abrdf
