// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/page_job.h"

#include "abrdf/output_file.h"
#include "abrdf/stopwatch.h"
#include "color/delta_e.h"
#include "pipeline/preview/picture_output.h"
#include "pipeline/preview/shown_atlas.h"
#include "pipeline/report/report_files.h"
#include "stages/page/html_page.h"
#include "stages/preview/built_in_light.h"
#include "stages/preview/encode_picture.h"
#include "stages/preview/render.h"
#include "stages/write/coded_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

constexpr int kPicture = 320;  // Pixels of a still picture.
constexpr int kEnvironmentLights = 768;
constexpr int kCubeSide = 33;

/// One atlas, as the page needs it.
struct Shown {
    AtlasHeader header;  ///< As the file has it: its own texels.
    std::string file;
    Atlas mean;  ///< Linear Rec.709, one texel.
};

std::vector<PageLight> pageLights(const std::vector<Light>& lights) {
    std::vector<PageLight> result;
    for (const Light& light : lights) result.push_back({light.direction, light.strength});
    return result;
}

std::vector<Light> studioLights(int count) {
    std::vector<Light> lights = lightsOf(studioEnvironment(), count);
    normalize({&lights});
    return lights;
}

std::vector<PageEnvironment> environments() {
    const EnvironmentMap sky = skyEnvironment(skySunDirection());
    std::vector<Light> skyLights = lightsOf(sky, kEnvironmentLights);
    std::vector<Light> sun{skySun(sky)};
    normalize({&skyLights, &sun});
    return {{"Studio", pageLights(studioLights(kEnvironmentLights)), {}},
            {"Sky and sun", pageLights(skyLights), pageLights(sun).front()}};
}

/// The display's codes on a cube of linear Rec.709.
PageView pageView(const ColorTransform& toScene, const ColorTransform& toDisplay,
                  const std::string& name) {
    PageView view{name, kCubeSide, {}};
    std::vector<Rgb> colors;
    const auto value = [](int i) {
        return static_cast<float>(cubeValue(static_cast<double>(i) / (kCubeSide - 1)));
    };
    for (int b = 0; b < kCubeSide; ++b) {
        for (int g = 0; g < kCubeSide; ++g) {
            for (int r = 0; r < kCubeSide; ++r) colors.push_back({value(r), value(g), value(b)});
        }
    }
    toScene.apply(colors);
    toDisplay.apply(colors);
    for (const Rgb& c : colors) {
        for (const float channel : {c.r, c.g, c.b}) {
            view.codes.push_back(
                static_cast<std::uint8_t>(std::lround(255 * std::clamp(channel, 0.0F, 1.0F))));
        }
    }
    return view;
}

/// The work on one page: what all of its materials share.
class PageMaker {
  public:
    PageMaker(const PageOptions& options, const ColorConfig& colors)
        : options_(options),
          colors_(colors),
          rec709_(spaceOfFile(colors, "page", "", "lin_rec709_scene")),
          toScene_(colors.transform(rec709_, "scene_linear")),
          shown_(colors.resolved(options.display, "scene_linear")),
          toDisplay_(colors.displayTransform("scene_linear", shown_)),
          encoding_(knownDisplay(colors.encodedSpace(shown_, "scene_linear"))),
          studio_(studioLights(2048)) {
        if (!encoding_ || encoding_->name != "sRGB") {
            throw std::invalid_argument(fmt::format(
                "a page is shown in sRGB, which the display '{}' with the view '{}' is not; choose "
                "another with --display and --view",
                shown_.display, shown_.view));
        }
    }

    PageContent content(const ProgressSink& progress) {
        std::vector<Shown> atlases;
        for (const auto& path : options_.atlases) {
            const Atlas atlas = atlasInSpace(path, colors_, rec709_, conversions_);
            atlases.push_back({atlas.header(), path.filename().string(), meanOverTexels(atlas)});
            if (progress) {
                progress({"read", "atlases", atlases.size(), options_.atlases.size()});
            }
        }
        PageContent content;
        content.title = options_.title.empty() ? options_.output.stem().string() : options_.title;
        content.environments = environments();
        content.view = pageView(toScene_, toDisplay_, shown_.view);
        content.exposure = options_.exposure;
        content.colorNote = noteOfColors();
        addMaterials(atlases, content, progress);
        return content;
    }

    const ordered_json& conversions() const { return conversions_; }
    const DisplayView& shown() const { return shown_; }

  private:
    void addMaterials(const std::vector<Shown>& atlases, PageContent& content,
                      const ProgressSink& progress) {
        std::map<std::string, const Shown*> measured;
        for (const Shown& atlas : atlases) {
            if (atlas.header.method == "measured") measured.emplace(atlas.header.source, &atlas);
        }
        std::map<std::string, bool> compared;
        for (const Shown& atlas : atlases) {
            if (atlas.header.method != "measured") compared[atlas.header.source] = true;
        }
        std::size_t done = 0;
        for (const Shown& atlas : atlases) {
            const std::string& source = atlas.header.source;
            const bool isMeasured = atlas.header.method == "measured";
            // A measurement that something is compared with has no entry of its own.
            if (!isMeasured || !compared[source] || measured[source] != &atlas) {
                const auto found = measured.find(source);
                const Shown* reference =
                    isMeasured || found == measured.end() ? nullptr : found->second;
                content.materials.push_back(materialOf(atlas, reference, isMeasured));
            }
            if (progress) progress({"page", "atlases", ++done, atlases.size()});
        }
    }

    PageMaterial materialOf(const Shown& atlas, const Shown* reference, bool isMeasured) {
        PageMaterial material;
        material.name = atlas.header.source.empty() ? atlas.file : atlas.header.source;
        material.caption = isMeasured ? "full measurement"
                                      : fmt::format("{}, plan {}, {} samples", atlas.header.method,
                                                    atlas.header.plan, atlas.header.samples);
        const AtlasLayout& layout = atlas.header.layout;
        if (layout.texelCount() > 1) {
            material.caption +=
                fmt::format(", mean of {} x {} texels", layout.texelsWide, layout.texelsHigh);
        }
        (isMeasured ? material.measurement : material.reconstruction) = pageTableOf(atlas.mean);
        material.picture = pictureOf(atlas.mean);
        if (reference == nullptr) return material;
        material.measurement = pageTableOf(reference->mean);
        material.measuredPicture = pictureOf(reference->mean);
        if (atlas.header.grid == reference->header.grid) {
            material.caption +=
                fmt::format(", mean ΔE {:.2f}", meanDeltaE(atlas.mean, reference->mean));
        }
        return material;
    }

    double meanDeltaE(const Atlas& a, const Atlas& b) const {
        const auto exposure = static_cast<float>(options_.exposure);
        double sum = 0;
        for (std::size_t i = 0; i < a.pixels().size(); ++i) {
            sum += deltaE76(labFromLinearRec709(exposure * a.pixels()[i]),
                            labFromLinearRec709(exposure * b.pixels()[i]));
        }
        return sum / static_cast<double>(a.pixels().size());
    }

    std::string pictureOf(const Atlas& atlas) const {
        const Material material(atlas);
        const auto sphere = makeSphere();
        Scene scene;
        scene.surface = sphere.get();
        scene.sky = studio_;
        Picture picture = render(material, scene, kPicture, kPicture, {});
        toScene_.apply(picture.color);
        EncodeOptions encode;
        encode.exposure = options_.exposure;
        encode.dither = false;
        encode.background = Rgb{0.05F, 0.05F, 0.05F};
        CodedPicture coded = encodePicture(picture, toDisplay_, encode);
        coded.encoding = encoding_;
        return jpegBytes(coded, 90);
    }

    std::string noteOfColors() const {
        std::string note = fmt::format("Colours: config {}", colors_.origin());
        for (const ordered_json& step : conversions_) {
            note += fmt::format("; {}: {} to {}", step["what"].get<std::string>(),
                                step["from"].get<std::string>(), step["to"].get<std::string>());
        }
        return note + fmt::format("; shown on {} with the view {}.", shown_.display, shown_.view);
    }

    const PageOptions& options_;
    const ColorConfig& colors_;
    std::string rec709_;
    ColorTransform toScene_;
    DisplayView shown_;
    ColorTransform toDisplay_;
    std::optional<DisplayEncoding> encoding_;
    std::vector<Light> studio_;
    ordered_json conversions_ = ordered_json::array();
};

}  // namespace

ordered_json writePage(const PageOptions& options, const ProgressSink& progress) {
    const Stopwatch time;
    checkOutputPath(options.output);
    if (!(options.exposure > 0)) throw std::invalid_argument("the exposure must be above 0");
    const ColorConfig colors = ColorConfig::load(options.colorConfig);
    PageMaker maker(options, colors);
    PageContent content = maker.content(progress);
    const std::vector<std::string> others = addReports(options.reports, content);
    const std::string html = htmlPage(content);
    writeWholeFile(options.output, html);
    ordered_json report;
    report["version"] = ABRDF_VERSION;
    report["materials"] = content.materials.size();
    report["reports"] = options.reports.size() - others.size();
    report["ignored"] = others;
    report["color"] = {{"config", colors.origin()},
                       {"conversions", maker.conversions()},
                       {"display", maker.shown().display},
                       {"view", maker.shown().view}};
    report["time"] = {{"total", time.seconds()}};
    report["output"] = {{"path", options.output.string()}, {"bytes", html.size()}};
    return report;
}

}  // namespace abrdf
