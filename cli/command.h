// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/grazing.h"
#include "abrdf/progress.h"
#include "pipeline/convert/plane.h"
#include "pipeline/job.h"
#include "pipeline/reconstruction.h"
#include "pipeline/report/page_job.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace abrdf {

/// Options that mean the same for every command.
struct SharedOptions {
    int threads = 0;     ///< 0: from the environment, else all processors.
    std::string memory;  ///< As bytesFromText(); empty: 2G.
    std::string progress = "auto";
    std::filesystem::path report;
    bool verbose = false;
    bool quiet = false;
    bool json = false;

    std::uint64_t memoryBytes() const;
};

/// One command: its options on `app` and, when chosen, what to run (returning the exit status).
using RunCommand = std::function<int(const SharedOptions&, const ProgressSink&)>;

// One file a command; each adds its subcommand and says through `run` what to do when it is chosen.
void addConvert(CLI::App& app, RunCommand& run);
void addInspect(CLI::App& app, RunCommand& run);
void addEvaluate(CLI::App& app, RunCommand& run);
void addChart(CLI::App& app, RunCommand& run);
void addPlan(CLI::App& app, RunCommand& run);
void addTrain(CLI::App& app, RunCommand& run);
void addExport(CLI::App& app, RunCommand& run);
void addStress(CLI::App& app, RunCommand& run);
void addPreview(CLI::App& app, RunCommand& run);
void addReport(CLI::App& app, RunCommand& run);
void addExpand(CLI::App& app, RunCommand& runCommand);
void addMerge(CLI::App& app, RunCommand& run);
void addRun(CLI::App& app, RunCommand& run);
void addDemo(CLI::App& app, RunCommand& run);
void addDescribe(CLI::App& app, RunCommand& run);  ///< Hidden: manual and completions.

/// Those of SharedOptions, for the program.
void addSharedOptions(CLI::App& app, SharedOptions& shared);

/// --pattern, --utia-encoding and the limits: for every command that opens a database.
void addReadOptions(CLI::App& command, ReadOptions& options);

/// --grazing, for commands that write on a grid of the user's choice.
void addGrazingOption(CLI::App& command, Grazing& grazing);

/// --colorconfig.
void addColorConfigOption(CLI::App& command, std::optional<std::filesystem::path>& config);

/// --texels, as text until the command runs.
void addTexelsOption(CLI::App& command, std::string& texels);

/// --no-clobber, and whether it keeps `output`, which it says.
void addNoClobberFlag(CLI::App& command, bool& noClobber);
bool isKept(bool noClobber, const std::filesystem::path& output);

/// How databases are read, their colours and missing images, but for the input itself.
void addDatabaseOptions(CLI::App& command, InputOptions& options);

/// The same and the input: for every command on a database.
void addInputOptions(CLI::App& command, InputOptions& options);

/// The method's plan, model and numbers: for every command that reconstructs.
void addMethodOptions(CLI::App& command, MethodChoice& choice);

/// The surface's plane, as text until the command runs.
struct PlaneOptions {
    std::string plane = "auto";
    std::string edges = "auto";
    bool unshift = false;
};
void addPlaneOptions(CLI::App& command, PlaneOptions& options);
PlaneChoice planeFrom(const PlaneOptions& options);

/// Options of a page that `preview --html` and `report` share; and what both end with.
void addPageOptions(CLI::App& command, PageOptions& options);
int deliverPage(nlohmann::ordered_json report, const SharedOptions& shared);

/// Flushes standard output; throws std::runtime_error where it did not take all that was printed.
void checkStandardOutput();

/// Prints `report` on stdout as JSON where --json was given, else `text`, and writes --report.
void deliver(const nlohmann::ordered_json& report, const std::string& text,
             const SharedOptions& shared);

}  // namespace abrdf
