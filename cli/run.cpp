// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/printable.h"
#include "cli/batch_file.h"
#include "cli/command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace abrdf {

namespace {

struct Options {
    std::filesystem::path job;
    std::string shard = "1/1";
    bool keepGoing = false;
    bool resume = false;
    bool noClobber = false;
    bool dryRun = false;
};

/// A key that convert does not know should not be found out after an hour.
void checkWords(const BatchItem& item, const std::filesystem::path& job) {
    CLI::App app;
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    SharedOptions shared;
    addSharedOptions(app, shared);
    app.fallthrough();
    RunCommand chosen;
    addConvert(app, chosen);
    std::vector<std::string> words(item.words.rbegin(), item.words.rend());
    words.emplace_back("convert");
    try {
        app.parse(words);
    } catch (const CLI::ParseError& error) {
        throw std::invalid_argument(
            fmt::format("{}: for {}: {}", job.string(), item.input, error.what()));
    }
}

int run(const Options& options, const SharedOptions& shared, const ProgressSink& progress) {
    std::vector<BatchItem> items = batchFromFile(options.job);
    for (BatchItem& item : items) {
        if (options.resume) item.words.emplace_back("--resume");
        if (options.noClobber) item.words.emplace_back("--no-clobber");
        checkWords(item, options.job);
    }
    if (options.dryRun) {
        nlohmann::ordered_json plan = {{"command", "run"}, {"dry_run", true}};
        std::string text;
        for (const BatchItem& item : items) {
            plan["materials"].push_back({{"input", item.input}, {"output", item.output}});
            text += fmt::format("{} -> {}\n", item.input, item.output);
        }
        deliver(plan, text, shared);
        return 0;
    }
    BatchOptions batch;
    batch.program = std::filesystem::read_symlink("/proc/self/exe");
    batch.threads = shared.threads;
    batch.memory = shared.memoryBytes();
    batch.keepGoing = options.keepGoing;
    batch.shard = shardFromText(options.shard);
    batch.warn = [](const std::string& message) { spdlog::warn(printable(message)); };
    const auto summary = runBatch(items, batch, progress);
    deliver(summary, shared.quiet ? "" : batchTable(summary), shared);
    for (const auto& material : summary["materials"]) {
        if (material.contains("error")) spdlog::error(material["error"].get<std::string>());
    }
    return summary["counts"]["failed"] == 0 ? 0 : 1;
}

}  // namespace

void addRun(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand("run", "a batch: many inputs, same keys as the options");
    command->footer(
        "Example: abrdf run examples/jobs/averages.toml --keep-going --report batch.json");
    auto options = std::make_shared<Options>();
    command->add_option("JOB", options->job, "a TOML file, as those of examples/jobs")->required();
    command->add_flag("--keep-going", options->keepGoing,
                      "after a failure; else what has not begun is skipped");
    command->add_flag("--resume", options->resume, "continue where an earlier run stopped");
    command->add_flag("--no-clobber", options->noClobber, "keep existing outputs");
    command->add_option("--shard", options->shard, "only part I of N of the materials, as 1/4");
    command->add_flag("--dry-run", options->dryRun, "list inputs and outputs");
    command->callback([options, &runCommand] {
        runCommand = [options](const SharedOptions& shared, const ProgressSink& progress) {
            return run(*options, shared, progress);
        };
    });
}

}  // namespace abrdf
