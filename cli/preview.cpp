// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/preview/preview.h"

#include "cli/command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <charconv>
#include <stdexcept>

namespace abrdf {

namespace {

struct Options {
    PreviewOptions job;
    std::vector<std::filesystem::path> atlases;
    std::filesystem::path html;
    PageOptions page;
    std::string kind = "sphere";
    std::string size = "512x512";
    std::vector<double> camera;
    std::vector<std::string> lights;
    std::string background = "0.05";
    bool noClobber = false;
};

/// "a,b,c" -> numbers; throws std::invalid_argument unless there are `least` to `most` of them.
std::vector<double> numbers(const std::string& text, std::size_t least, std::size_t most,
                            const std::string& what) {
    std::vector<double> values;
    const char* at = text.data();
    const char* end = at + text.size();
    while (at < end) {
        double value = 0;
        const auto [rest, error] = std::from_chars(at, end, value);
        if (error != std::errc() || (rest != end && *rest != ',')) break;
        values.push_back(value);
        at = rest == end ? end : rest + 1;
    }
    if (at != end || values.size() < least || values.size() > most) {
        throw std::invalid_argument(fmt::format("'{}' is not understood: write {}", text, what));
    }
    return values;
}

void setSize(const std::string& text, PreviewOptions& job) {
    std::string commas = text;
    std::replace(commas.begin(), commas.end(), 'x', ',');
    const auto size = numbers(commas, 1, 2, "--size WIDTHxHEIGHT, as 512x512");
    const auto pixels = [](double value) {
        if (!(value >= 1 && value <= 16384) || value != std::floor(value)) {
            throw std::invalid_argument("a picture has 1 to 16384 pixels each way");
        }
        return static_cast<int>(value);
    };
    job.width = pixels(size.front());
    job.height = pixels(size.back());
}

PreviewOptions jobOf(const Options& options) {
    PreviewOptions job = options.job;
    job.kind = previewKindFromName(options.kind);
    setSize(options.size, job);
    if (!options.camera.empty()) {
        if (options.camera.size() > 3) {
            throw std::invalid_argument("write --camera AZIMUTH,ELEVATION[,FIELD_OF_VIEW]");
        }
        job.cameraAzimuth = options.camera[0];
        if (options.camera.size() > 1) job.cameraElevation = options.camera[1];
        if (options.camera.size() > 2) job.fieldOfView = options.camera[2];
    }
    for (const std::string& text : options.lights) {
        const auto light = numbers(text, 2, 3, "--light AZIMUTH,ELEVATION[,STRENGTH]");
        job.lights.push_back({radiansFromDegrees(light[0]), radiansFromDegrees(light[1]),
                              light.size() > 2 ? light[2] : 1});
    }
    if (options.background == "none") {
        job.background.reset();
    } else {
        const auto c = numbers(options.background, 1, 3, "--background R,G,B, one grey, or none");
        const auto channel = [&](std::size_t i) {
            return static_cast<float>(c[std::min(i, c.size() - 1)]);
        };
        job.background = Rgb{channel(0), channel(1), channel(2)};
    }
    return job;
}

int runPage(const Options& options, const SharedOptions& shared, const ProgressSink& progress) {
    if (isKept(options.noClobber, options.html)) return 0;
    PageOptions page = options.page;
    page.atlases = options.atlases;
    page.output = options.html;
    page.colorConfig = options.job.colorConfig;
    page.display = options.job.display;
    page.exposure = options.job.exposure;
    nlohmann::ordered_json report;
    report["command"] = "preview";
    report.update(writePage(page, progress));
    return deliverPage(report, shared);
}

int run(const Options& options, const SharedOptions& shared, const ProgressSink& progress) {
    if (options.html.empty() == options.job.output.empty()) {
        throw std::invalid_argument("write either a picture (-o FILE) or a page (--html FILE)");
    }
    if (!options.html.empty()) return runPage(options, shared, progress);
    if (options.atlases.size() != 1) {
        throw std::invalid_argument("a picture shows one atlas; --html FILE makes a page of many");
    }
    PreviewOptions job = jobOf(options);
    job.atlas = options.atlases.front();
    if (isKept(options.noClobber, job.output)) return 0;
    auto report = preview(job, progress);
    report["threads"] = shared.threads;
    if (report["color"].value("encoding", "") == "unknown") {
        spdlog::warn(
            "no file can state the encoding of the display '{}' with the view '{}': the "
            "picture has no colour tag",
            report["color"]["display"].get<std::string>(),
            report["color"]["view"].get<std::string>());
    }
    const std::string text = fmt::format(
        "{}: {}, {} bytes, {:.2f} s\n", report["output"]["path"].get<std::string>(),
        report["kind"].get<std::string>(), report["output"]["bytes"].get<std::uint64_t>(),
        report["time"]["total"].get<double>());
    deliver(report, shared.quiet ? "" : text, shared);
    return 0;
}

void addSceneOptions(CLI::App& command, Options& options) {
    PreviewOptions& job = options.job;
    command
        .add_option("--camera", options.camera,
                    "AZIMUTH,ELEVATION[,FIELD_OF_VIEW] in degrees; 0,0 looks from the front")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--light", options.lights,
                    "AZIMUTH,ELEVATION[,STRENGTH]: a distant light in degrees; may be repeated")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    command.add_option("--environment", job.environment,
                       "studio | sky | none | a file (.exr, .hdr) of longitude and latitude; "
                       "studio where there is no --light");
    command.add_option("--environment-space", job.environmentSpace,
                       "colour space of that file, where it does not say (scene_linear)");
    command.add_option("--turn", job.turnEnvironment, "turns the environment, in degrees")
        ->capture_default_str();
    command.add_option("--samples", job.samples, "lights that stand for the environment")
        ->capture_default_str();
    command
        .add_option("--tiles", job.tiles,
                    "repeats of a map over the shape; 0: about two pixels a texel")
        ->capture_default_str();
}

void addPictureOptions(CLI::App& command, Options& options) {
    PreviewOptions& job = options.job;
    command.add_option("--size", options.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    command.add_option("--exposure", job.exposure, "factor on the light")->capture_default_str();
    command.add_option("--display", job.display.display, "OpenColorIO display (.png, .jpg)");
    command.add_option("--view", job.display.view, "OpenColorIO view of that display");
    command.add_option("--look", job.display.look, "OpenColorIO looks, in place of the view's own");
    command.add_option("--output-space", job.outputSpace, "colour space of an .exr")
        ->capture_default_str();
    addColorConfigOption(command, job.colorConfig);
    command
        .add_option("--background", options.background,
                    "scene-linear R,G,B or one grey; none leaves an alpha channel")
        ->capture_default_str();
    command.add_option("--bits", job.bits, "8 | 16 bits of a .png; 0: 16 for PQ displays, else 8")
        ->capture_default_str();
    command.add_option("--quality", job.quality, "of a .jpg")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command.add_flag("--draft", job.draft, "first writes a coarse picture in the same place");
    addNoClobberFlag(command, options.noClobber);
}

}  // namespace

void addPreview(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand("preview", "an atlas as a picture to judge it by");
    command->footer("Example: abrdf preview corduroy.exr --kind drape -o corduroy.png");
    auto options = std::make_shared<Options>();
    command->add_option("ATLAS", options->atlases, "atlases that abrdf convert made")->required();
    command->add_option("-o,--output", options->job.output, "the picture: .exr, .png or .jpg");
    command->add_option("--html", options->html, "an interactive page of all atlases instead");
    addPageOptions(*command, options->page);
    command->add_option("--kind", options->kind, "sphere | plane | drape | sheet | polar")
        ->capture_default_str();
    command->add_option("--reference", options->job.reference,
                        "the measured atlas that a sheet or a polar plot compares with");
    command
        ->add_option("--pair", options->job.pairs,
                     "THETA_I,PHI_I,THETA_V,PHI_V in degrees: a sheet of single pairs; may be "
                     "repeated")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    addSceneOptions(*command, *options);
    addPictureOptions(*command, *options);
    command->callback([options, &runCommand] {
        runCommand = [options](const SharedOptions& shared, const ProgressSink& progress) {
            return run(*options, shared, progress);
        };
    });
}

}  // namespace abrdf
