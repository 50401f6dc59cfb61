// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/merge.h"

#include "cli/atlas_options.h"
#include "cli/command.h"

#include <fmt/format.h>

namespace abrdf {

namespace {

std::string shardsText(std::size_t count) {
    return count == 1 ? "one shard" : fmt::format("{} shards", count);
}

}  // namespace

void addMerge(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand("merge", "shards of one job into one atlas");
    command->footer("Example: abrdf merge corduroy.1.exr corduroy.2.exr -o corduroy.exr");
    auto options = std::make_shared<MergeOptions>();
    auto noClobber = std::make_shared<bool>(false);
    command->add_option("SHARD", options->shards, "atlases of convert --shard, in any order")
        ->required();
    addAtlasOutput(*command, options->output);
    addNoClobberFlag(*command, *noClobber);
    command->callback([options, noClobber, &runCommand] {
        runCommand = [options, noClobber](const SharedOptions& shared,
                                          const ProgressSink& progress) {
            if (isKept(*noClobber, options->output)) return 0;
            options->memory = shared.memoryBytes();
            const auto report = merge(*options, progress);
            const std::string text = fmt::format(
                "{}: {} x {} texels from {} in {:.2f} s\n",
                report["output"]["path"].get<std::string>(), report["texels"][0].get<int>(),
                report["texels"][1].get<int>(), shardsText(report["shards"].get<std::size_t>()),
                report["time"]["total"].get<double>());
            deliver(report, shared.quiet ? "" : text, shared);
            return 0;
        };
    });
}

}  // namespace abrdf
