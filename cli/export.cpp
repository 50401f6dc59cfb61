// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/export.h"

#include "cli/command.h"
#include "pipeline/scene_program.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

namespace abrdf {

namespace {

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
    if (report.contains("notes")) {
        for (const auto& note : report["notes"]) text += note.get<std::string>() + "\n";
    }
    return text;
}

int runScene(const ExportJob& job, SceneJob scene, const std::string& light,
             const SharedOptions& shared, const ProgressSink& progress) {
    scene.material = job;
    if (!light.empty()) {
        char comma = 0;
        std::istringstream stream(light);
        if (!(stream >> scene.lightAzimuth >> comma >> scene.lightElevation) || comma != ',') {
            throw std::invalid_argument("write --light AZIMUTH,ELEVATION in degrees");
        }
    }
    const auto report = exportScene(scene, progress);
    std::string text = fmt::format("{}: render it there with: {}\n", job.output.string(),
                                   report["run"].get<std::string>());
    if (report.contains("preview")) {
        text += fmt::format("the same light: {}\n", report["preview"].get<std::string>());
    }
    deliver(report, shared.quiet ? "" : text, shared);
    return 0;
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
        ->add_option("--tolerance", job->options.tolerance,
                     "of rgl and radiance: mean Delta E between turns of the sample up to which "
                     "it is isotropic")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--spectra", job->options.spectra,
                      "of rgl: smooth spectra beside RGB, as Mitsuba and pbrt ask for");
    command
        ->add_option("--cull", job->options.cull,
                     "of radiance: percent of a tree's leaves that are merged")
        ->check(CLI::Range(0, 100))
        ->capture_default_str();
    command
        ->add_option("--resolution", job->options.resolution,
                     "of rgl: samples a side for each direction (else 128, 64 of a grid, 32 where "
                     "anisotropic); of radiance: cells a side, a power of two")
        ->check(CLI::Range(8, 512));
    addGrazingOption(*command, job->grazing);
    command->callback([job, scene, light, &runCommand] {
        if (job->format.empty() == scene->program.empty()) {
            throw CLI::RequiredError("--to FORMAT or --scene PROGRAM");
        }
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
