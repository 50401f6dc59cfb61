// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/report.h"

#include "cli/command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace abrdf {

void addPageOptions(CLI::App& command, PageOptions& options) {
    command.add_option("--title", options.title, "the page's title");
}

int deliverPage(nlohmann::ordered_json report, const SharedOptions& shared) {
    for (const auto& file : report["ignored"]) {
        spdlog::warn("{}: is no report that the page knows, and is left out",
                     file.get<std::string>());
    }
    report["threads"] = shared.threads;
    const std::string text = fmt::format(
        "{}: {} materials, {} reports, {:.2f} MB, {:.2f} s\n",
        report["output"]["path"].get<std::string>(), report["materials"].get<std::size_t>(),
        report["reports"].get<std::size_t>(), report["output"]["bytes"].get<double>() / 1e6,
        report["time"]["total"].get<double>());
    deliver(report, shared.quiet ? "" : text, shared);
    return 0;
}

void addReport(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand("report", "one page for a batch");
    command->footer("Example: abrdf report results -o results.html");
    struct Options {
        std::filesystem::path folder;
        PageOptions page;
    };
    auto options = std::make_shared<Options>();
    auto noClobber = std::make_shared<bool>(false);
    PageOptions& page = options->page;
    command
        ->add_option("FOLDER", options->folder,
                     "atlases (.exr) and reports (.json) of other commands")
        ->required();
    command->add_option("-o,--output", page.output, "the page, one HTML file")->required();
    addPageOptions(*command, page);
    command->add_option("--exposure", page.exposure, "factor on the light")->capture_default_str();
    command->add_option("--display", page.display.display, "an OpenColorIO display in sRGB");
    command->add_option("--view", page.display.view, "the view of tone curve 1");
    addColorConfigOption(*command, page.colorConfig);
    addNoClobberFlag(*command, *noClobber);
    command->callback([options, noClobber, &runCommand] {
        runCommand = [options, noClobber](const SharedOptions& shared,
                                          const ProgressSink& progress) {
            if (isKept(*noClobber, options->page.output)) return 0;
            return deliverPage(reportFolder(options->folder, options->page, progress), shared);
        };
    });
}

}  // namespace abrdf
