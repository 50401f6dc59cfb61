// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/export/export.h"

#include "cli/command.h"
#include "pipeline/export/scene_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace abrdf {

namespace {

/// What was lost and decided, a line each.
std::string notesOf(const nlohmann::ordered_json& report) {
    std::string text;
    if (!report.contains("notes")) return text;
    for (const auto& note : report["notes"]) text += note.get<std::string>() + "\n";
    return text;
}

std::string summaryOf(const std::filesystem::path& file, const nlohmann::ordered_json& report) {
    const auto& extrapolated = report["extrapolated"];
    std::string text = fmt::format(
        "{}: {}; {} of {} values lie past the measured {:g} degrees ({})\n", file.string(),
        report["description"].get<std::string>(), extrapolated["values"].get<std::uint64_t>(),
        extrapolated["of"].get<std::uint64_t>(), report["max_measured_theta"].get<double>(),
        extrapolated["grazing"].get<std::string>());
    if (report.contains("lost")) {
        text += fmt::format(
            "lost by the isotropic average: RMS over azimuth {:.3g} of an RMS of {:.3g} 1/sr, "
            "{:.3g} % of the energy\n",
            report["lost"]["rms_over_azimuth"].get<double>(),
            report["lost"]["rms_of_brdf"].get<double>(),
            100 * report["lost"]["share_of_energy"].get<double>());
    }
    return text + notesOf(report);
}

int runScene(const ExportJob& job, SceneJob scene, const std::string& light,
             const SharedOptions& shared, const ProgressSink& progress) {
    scene.material = job;
    if (!light.empty()) {
        char comma = 0;
        std::istringstream stream(light);
        if (!(stream >> scene.lightAzimuth >> comma >> scene.lightElevation) || comma != ',' ||
            stream.peek() != std::char_traits<char>::eof() ||
            !(std::abs(scene.lightAzimuth) <= 360) ||
            !(scene.lightElevation > 0 && scene.lightElevation <= 90)) {
            throw std::invalid_argument(fmt::format(
                "'{}' is no light: it is AZIMUTH,ELEVATION in degrees, as -35,45, the azimuth "
                "within -360 .. 360 and the elevation above 0, up to 90",
                light));
        }
    }
    const auto report = exportScene(scene, progress);
    std::string text = notesOf(report);
    text += fmt::format("{}: render it there with: {}\n", job.output.string(),
                        report["run"].get<std::string>());
    if (report.contains("preview")) {
        text += fmt::format("the same light: {}\n", report["preview"].get<std::string>());
    }
    deliver(report, shared.quiet ? "" : text, shared);
    return 0;
}

/// CLI::Range lets pass what is not a number.
CLI::Validator finiteRange(double low, double high) {
    return {[=](const std::string& text) {
                double value = 0;
                const bool isInside =
                    CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
                return isInside
                           ? std::string()
                           : fmt::format("Value {} not in range {:g} to {:g}", text, low, high);
            },
            fmt::format("in [{:g} - {:g}]", low, high)};
}

/// Options that only some formats have, and those formats.
struct FormatOption {
    const char* name;
    std::vector<std::string> formats;
};
const std::vector<FormatOption>& formatOptions() {
    static const std::vector<FormatOption> options = {
        {"--utia-encoding", {"utia-bin", "utia-exr"}},
        {"--tolerance", {"rgl", "radiance", "astm", "ssdd", "mitsuba", "pbrt"}},
        {"--spectra", {"rgl"}},
        {"--cull", {"radiance"}},
        {"--resolution", {"rgl", "radiance", "mitsuba", "pbrt"}},
    };
    return options;
}

/// An option that would say nothing about what is written is a mistake.
void checkOptions(const CLI::App& command, const std::string& wanted) {
    for (const FormatOption& option : formatOptions()) {
        if (command.count(option.name) == 0) continue;
        if (std::ranges::find(option.formats, wanted) != option.formats.end()) continue;
        throw CLI::ValidationError(option.name, fmt::format("is not for {}: it is for {}", wanted,
                                                            fmt::join(option.formats, ", ")));
    }
    if (wanted == "blender" && command.count("--texel") > 0) {
        throw CLI::ValidationError("--texel", "is not for blender, which shows the whole map");
    }
}

std::string formatNames() {
    std::string names;
    for (const ExportFormat& format : exportFormats()) {
        names += fmt::format("{}{}", names.empty() ? "" : " | ", format.name);
    }
    return names;
}

}  // namespace

void addExport(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand("export", "an atlas into other programs' formats");
    command->footer("Example: abrdf export corduroy.exr --to utia-bin -o corduroy.bin");
    auto job = std::make_shared<ExportJob>();
    command->add_option("ATLAS", job->input.input, "an atlas, or any database")->required();
    auto* to = command->add_option("--to", job->format, formatNames());
    auto scene = std::make_shared<SceneJob>();
    auto light = std::make_shared<std::string>();
    command
        ->add_option("--scene", scene->program,
                     fmt::format("instead of --to, a folder that a renderer takes as it stands: {}",
                                 fmt::join(scenePrograms(), " | ")))
        ->excludes(to);
    command->add_option("--light", *light, "of a scene: AZIMUTH,ELEVATION (-35,45)")
        ->needs("--scene");
    command
        ->add_option("-o,--output", job->output,
                     "the file, FILE.json beside it says what it is; or the scene's folder")
        ->required();
    command->add_option("--colorconfig", job->input.colorConfig,
                        "OpenColorIO config (else $OCIO, else the shipped one)");
    command->add_option_function<std::string>(
        "--utia-encoding",
        [job](const std::string& name) { job->options.utiaEncoding = utiaEncodingFromName(name); },
        "of utia-bin and utia-exr: linear (the default) | srgb | srgb140");
    command->add_option_function<std::string>(
        "--texel", [job](const std::string& name) { job->texel = texelPlaceFromName(name); },
        "X,Y from the top left, instead of the mean over all texels");
    command
        ->add_option(
            "--tolerance", job->options.tolerance,
            "of rgl, radiance, astm and ssdd: mean Delta E between turns of the sample up to which "
            "it is isotropic")
        ->check(finiteRange(0, 100))
        ->capture_default_str();
    command->add_flag("--spectra", job->options.spectra,
                      "of rgl: smooth spectra beside RGB, as Mitsuba and pbrt ask for");
    command
        ->add_option("--cull", job->options.cull,
                     "of radiance: percent of a tree's leaves that are merged")
        ->check(finiteRange(0, 100))
        ->capture_default_str();
    command
        ->add_option("--resolution", job->options.resolution,
                     "of rgl: samples a side for each direction (else 128, 64 of a grid, 32 where "
                     "anisotropic); of radiance: cells a side, a power of two")
        ->check(CLI::Range(8, 512));
    addGrazingOption(*command, job->grazing);
    command->callback([job, scene, light, command, &runCommand] {
        if (job->format.empty() == scene->program.empty()) {
            throw CLI::RequiredError("--to FORMAT or --scene PROGRAM");
        }
        checkOptions(*command, job->format.empty() ? scene->program : job->format);
        runCommand = [job, scene, light](const SharedOptions& shared,
                                         const ProgressSink& progress) {
            if (!scene->program.empty()) return runScene(*job, *scene, *light, shared, progress);
            const auto report = exportBrdf(*job, progress);
            deliver(report, shared.quiet ? "" : summaryOf(job->output, report), shared);
            return 0;
        };
    });
}

}  // namespace abrdf
