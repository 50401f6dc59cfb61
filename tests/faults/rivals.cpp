// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/fault_bench.h"

#include <unistd.h>

namespace abrdf {

void runRivals(FaultBench& bench) {
    const std::size_t trials = bench.isLong() ? 40 : 3;
    for (std::size_t trial = 0; trial < trials; ++trial) {
        const Job& job = bench.jobs()[trial % bench.jobs().size()];
        bench.begin(job, trial % 2 == 0 && job.name != "demo");
        bench.inject("two jobs on one output", job.name);
        std::vector<std::string> words = job.words;
        words.emplace_back("-q");
        if (job.name != "demo") words.emplace_back("-o");
        words.push_back(job.output);
        JobRun first(words, bench.work(), {});
        usleep(static_cast<useconds_t>(1e6 * 0.5 * bench.random() * job.seconds));
        JobRun second(words, bench.work(), {});
        const Outcome outcomes[] = {first.end(), second.end()};
        for (const Outcome& outcome : outcomes) {
            if (outcome.status != 0) bench.expectSentence(outcome, {job.output});
        }
        bench.expect(outcomes[0].status == 0 || outcomes[1].status == 0, "none of them ends well");
        bench.expect(contentOf(bench.work() / job.output) == job.reference, "other bytes");
        bench.expectNothingHalf(job, false);
    }
}

}  // namespace abrdf
