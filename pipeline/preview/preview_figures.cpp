// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/preview/preview_figures.h"

#include "color/delta_e.h"
#include "color/known_space.h"
#include "pipeline/job.h"
#include "pipeline/named_pair.h"
#include "pipeline/preview/picture_output.h"
#include "pipeline/preview/shown_atlas.h"
#include "stages/preview/polar_plot.h"
#include "stages/preview/sheet.h"
#include "stages/write/picture_exr.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

/// What is shown, and what it is compared with: in scene_linear.
struct Figures {
    Atlas atlas;
    std::optional<Atlas> reference;
    ColorTransform toRec709;
    FigureColors colors;
};

Figures load(const PreviewOptions& options, const ColorConfig& colors, ordered_json& report) {
    ordered_json& conversions = report["color"]["conversions"];
    Figures figures{atlasInSpace(options.atlas, colors, "scene_linear", conversions),
                    {},
                    colors.transform("scene_linear", "Linear Rec.709 (sRGB)"),
                    {}};
    if (options.reference.empty()) return figures;
    figures.reference = atlasInSpace(options.reference, colors, "scene_linear", conversions);
    const AtlasHeader& a = figures.atlas.header();
    const AtlasHeader& b = figures.reference->header();
    if (!(a.grid == b.grid) || a.cosine != b.cosine) {
        throw std::runtime_error(fmt::format(
            "{}: cannot be compared with {}: {}; convert both with the same --grid and --cosine",
            options.atlas.string(), options.reference.string(),
            a.cosine != b.cosine ? "only one has the cosine in its values"
                                 : "their directions differ"));
    }
    report["reference"] = options.reference.filename().string();
    return figures;
}

float deltaEOf(Rgb a, Rgb b, const Figures& figures) {
    const auto exposure = static_cast<float>(figures.colors.exposure);
    figures.toRec709.apply({&a, 1});
    figures.toRec709.apply({&b, 1});
    return static_cast<float>(
        deltaE76(labFromLinearRec709(exposure * a), labFromLinearRec709(exposure * b)));
}

void compare(SheetImages& row, const Figures& figures) {
    double sum = 0;
    float most = 0;
    for (std::size_t i = 0; i < row.measurement.size(); ++i) {
        row.deltaE.push_back(deltaEOf(row.measurement[i], row.reconstruction[i], figures));
        sum += static_cast<double>(row.deltaE.back());
        most = std::max(most, row.deltaE.back());
    }
    row.caption = fmt::format("mean ΔE {:.2f}   largest {:.1f}",
                              sum / static_cast<double>(row.deltaE.size()), most);
}

/// Everything at once: rows light, columns view.
SheetImages wholeTable(const Figures& figures) {
    const AtlasHeader& header = figures.atlas.header();
    SheetImages row;
    row.width = header.layout.views;
    row.height = header.layout.lights;
    row.title = fmt::format("{}, plan {}, {} samples", header.method, header.plan, header.samples);
    row.reconstruction = meanOverTexels(figures.atlas).pixels();
    if (figures.reference) {
        row.measurement = meanOverTexels(*figures.reference).pixels();
        compare(row, figures);
    }
    return row;
}

std::vector<Rgb> mapAt(const Atlas& atlas, const LightAndView& pair) {
    const AtlasLayout& layout = atlas.header().layout;
    std::vector<Rgb> map;
    for (int y = 0; y < layout.texelsHigh; ++y) {
        for (int x = 0; x < layout.texelsWide; ++x) {
            map.push_back(lookUp(atlas, pair.light, pair.view, x, y));
        }
    }
    return map;
}

/// All texels at one pair of directions.
SheetImages onePair(const Figures& figures, const std::string& text) {
    const LightAndView pair = pairFrom(text);
    const AtlasLayout& layout = figures.atlas.header().layout;
    SheetImages row;
    row.width = layout.texelsWide;
    row.height = layout.texelsHigh;
    row.title =
        fmt::format("light θ {:g}° φ {:g}°, view θ {:g}° φ {:g}°",
                    degreesFromRadians(pair.light.theta), degreesFromRadians(pair.light.phi),
                    degreesFromRadians(pair.view.theta), degreesFromRadians(pair.view.phi));
    row.reconstruction = mapAt(figures.atlas, pair);
    if (!figures.reference) return row;
    const AtlasLayout& other = figures.reference->header().layout;
    if (other.texelsWide != row.width || other.texelsHigh != row.height) {
        throw std::runtime_error(fmt::format(
            "the reference has {} x {} texels, the atlas {} x {}: single pairs need the same",
            other.texelsWide, other.texelsHigh, row.width, row.height));
    }
    row.measurement = mapAt(*figures.reference, pair);
    compare(row, figures);
    return row;
}

Sheet sheetOf(const PreviewOptions& options, const Figures& figures) {
    Sheet sheet;
    sheet.title = options.atlas.filename().string();
    const AtlasHeader& header = figures.atlas.header();
    if (options.pairs.empty()) {
        sheet.rows.push_back(wholeTable(figures));
        sheet.note = fmt::format("{} lights (rows) x {} views (columns){}", header.layout.lights,
                                 header.layout.views,
                                 header.layout.texelCount() > 1 ? ", mean of all texels" : "");
        return sheet;
    }
    for (const std::string& pair : options.pairs) sheet.rows.push_back(onePair(figures, pair));
    sheet.note = fmt::format("{} x {} texels, one pair of directions a row",
                             header.layout.texelsWide, header.layout.texelsHigh);
    return sheet;
}

CodedPicture polarOf(const PreviewOptions& options, const Figures& figures) {
    const Atlas atlas = meanOverTexels(figures.atlas);
    std::optional<Atlas> reference;
    if (figures.reference) reference = meanOverTexels(*figures.reference);
    PolarPlot plot;
    plot.title = options.atlas.filename().string();
    plot.atlas = &atlas;
    plot.reference = reference ? &*reference : nullptr;
    for (const double degrees : {0.0, 30.0, 60.0}) {
        plot.lightThetas.push_back(radiansFromDegrees(degrees));
    }
    return drawPolarPlot(plot, figures.colors, figures.toRec709);
}

std::vector<float> channelOf(const std::vector<Rgb>& colors, float Rgb::*channel) {
    std::vector<float> values;
    for (const Rgb& c : colors) values.push_back(c.*channel);
    return values;
}

/// A sheet's table as EXR: colours in scene-linear parts, Delta E as data that nothing converts.
void writeTable(const PreviewOptions& options, const ColorConfig& colors, const Figures& figures,
                ordered_json& report) {
    if (options.kind != PreviewKind::kSheet || !options.pairs.empty()) {
        throw std::invalid_argument(
            "plots and single pairs are figures with text: write them as .png or .jpg; an .exr "
            "holds the whole table (--kind sheet)");
    }
    const SheetImages table = wholeTable(figures);
    const std::string from = colors.spaceName("scene_linear");
    const std::string to = colors.spaceName(options.outputSpace);
    const ColorTransform transform = colors.transform(from, to);
    const auto known = knownSpace(colors.aliases(to));
    const std::string id = known ? std::string(interopId(*known)) : "unknown";
    std::vector<ExrPart> parts;
    const auto addColors = [&](const char* name, std::vector<Rgb> values) {
        transform.apply(values);
        ExrPart part{name, table.width, table.height, {}, to, id, {}};
        part.channels = {{"R", channelOf(values, &Rgb::r), false},
                         {"G", channelOf(values, &Rgb::g), false},
                         {"B", channelOf(values, &Rgb::b), false}};
        parts.push_back(std::move(part));
    };
    addColors("reconstruction", table.reconstruction);
    if (!table.measurement.empty()) {
        addColors("measurement", table.measurement);
        parts.push_back({"deltaE",
                         table.width,
                         table.height,
                         {{"deltaE", table.deltaE, false}},
                         "",
                         "data",
                         {}});
    }
    report["color"]["conversions"].push_back(conversion("table", from, to));
    const std::uint64_t bytes = writeExrParts(options.output, parts);
    report["output"] = {{"path", options.output.string()}, {"bytes", bytes}, {"color_space", to}};
}

}  // namespace

void drawFigure(const PreviewOptions& options, const ColorConfig& colors, ordered_json& report) {
    for (const std::string& pair : options.pairs) pairFrom(pair);
    Figures figures = load(options, colors, report);
    figures.colors.exposure = options.exposure;
    if (pictureFormatOf(options.output) == PictureFormat::kExr) {
        writeTable(options, colors, figures, report);
        return;
    }
    DisplayOutput display = displayOutputOf(options, colors);
    if (display.encoding && display.encoding->curve == DisplayCurve::kPq) {
        throw std::invalid_argument(
            "sheets and plots are figures with text for ordinary displays; choose one that is not "
            "PQ, or a sphere");
    }
    figures.colors.toDisplay = display.transform;
    figures.colors.note = fmt::format("shown on {}, view {}, exposure {:.4g}",
                                      display.shown.display, display.shown.view, options.exposure);
    report["color"]["conversions"].push_back(
        conversion("picture", colors.spaceName("scene_linear"), display.space));
    CodedPicture picture = options.kind == PreviewKind::kPolar
                               ? polarOf(options, figures)
                               : drawSheet(sheetOf(options, figures), figures.colors);
    report["size"] = {picture.width, picture.height};
    writeCoded(std::move(picture), options, display, report);
}

}  // namespace abrdf
