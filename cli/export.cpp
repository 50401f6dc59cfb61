// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/export.h"

#include "cli/command.h"

#include <fmt/format.h>

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
    command->add_option("--to", job->format, formatNames())->required();
    command->add_option("-o,--output", job->output, "the file; FILE.json beside it says what it is")
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
                     "anisotropic)")
        ->check(CLI::Range(8, 512));
    addGrazingOption(*command, job->grazing);
    command->callback([job, &runCommand] {
        runCommand = [job](const SharedOptions& shared, const ProgressSink& progress) {
            const auto report = exportBrdf(*job, progress);
            deliver(report, shared.quiet ? "" : summaryOf(job->output, report), shared);
            return 0;
        };
    });
}

}  // namespace abrdf
