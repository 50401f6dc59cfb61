// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/inspect.h"

#include "abrdf/for_each_texel.h"
#include "pipeline/job.h"
#include "stages/read/atlas_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <set>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// What one image told.
struct ImageFacts {
    std::string error;  ///< Empty where it was read.
    float least = std::numeric_limits<float>::infinity();
    float greatest = -std::numeric_limits<float>::infinity();
    std::uint64_t nonfinite = 0;
};

ImageFacts factsOf(const BtfReader& reader, std::size_t pair) {
    ImageFacts facts;
    try {
        const EncodedImage image = reader.read(pair);
        const auto add = [&](float value) {
            if (!std::isfinite(value)) {
                ++facts.nonfinite;
                return;
            }
            facts.least = std::min(facts.least, value);
            facts.greatest = std::max(facts.greatest, value);
        };
        if (const auto* codes = std::get_if<std::vector<std::uint8_t>>(&image.rgb)) {
            for (const std::uint8_t code : *codes) add(static_cast<float>(code) / 255.0F);
        } else {
            for (const float value : std::get<std::vector<float>>(image.rgb)) add(value);
        }
    } catch (const std::runtime_error& error) {
        facts.error = error.what();
    }
    return facts;
}

ordered_json degreesOf(const std::vector<Direction>& directions) {
    std::set<double> thetas;
    for (const Direction& d : directions) {
        thetas.insert(std::round(degreesFromRadians(d.theta) * 100) / 100);
    }
    return thetas;
}

ordered_json inspectDatabase(const fs::path& path, const ProgressSink& progress) {
    const auto reader = openBtf(path);
    const BtfDescription& description = reader->description();
    std::vector<std::size_t> present;
    for (std::size_t pair = 0; pair < description.present.size(); ++pair) {
        if (description.present[pair] != 0) present.push_back(pair);
    }
    std::vector<ImageFacts> facts(present.size());
    std::atomic<std::size_t> done = 0;
    forEachImage(present.size(), [&](std::size_t i) {
        facts[i] = factsOf(*reader, present[i]);
        if (progress) progress({"inspect", "images", ++done, present.size()});
    });
    ImageFacts all;
    std::vector<std::string> unreadable;
    for (const ImageFacts& one : facts) {
        if (!one.error.empty()) unreadable.push_back(one.error);
        all.least = std::min(all.least, one.least);
        all.greatest = std::max(all.greatest, one.greatest);
        all.nonfinite += one.nonfinite;
    }
    std::vector<std::string> missing;
    for (const std::size_t pair : description.missingPairs()) {
        missing.push_back(pairName(description.grid.pair(pair)));
    }
    ordered_json report;
    report["format"] = description.format;
    report["lights"] = description.grid.lights().size();
    report["views"] = description.grid.views().size();
    report["images"] = description.imageCount();
    report["width"] = description.width;
    report["height"] = description.height;
    report["light_thetas"] = degreesOf(description.grid.lights());
    report["view_thetas"] = degreesOf(description.grid.views());
    report["max_theta"] = degreesFromRadians(description.grid.maxTheta());
    report["color_space"] = description.colorSpace;
    report["cosine"] = nameOf(description.cosine);
    if (all.least <= all.greatest) report["stored_range"] = {all.least, all.greatest};
    report["nonfinite"] = all.nonfinite;
    report["missing"] = missing;
    report["duplicate"] = description.duplicates;
    report["unreadable"] = unreadable;
    report["complete"] = missing.empty() && description.duplicates.empty() && unreadable.empty();
    return report;
}

ordered_json inspectAtlas(const fs::path& path) {
    const AtlasHeader atlas = readAtlasHeader(path);
    ordered_json report;
    report["format"] = "abrdf atlas";
    report["lights"] = atlas.grid.lights().size();
    report["views"] = atlas.grid.views().size();
    report["images"] = atlas.layout.texelCount();
    report["width"] = atlas.layout.width();
    report["height"] = atlas.layout.height();
    report["layout"] = nameOf(atlas.layout.kind);
    report["texels"] = {atlas.layout.texelsWide, atlas.layout.texelsHigh};
    report["light_thetas"] = degreesOf(atlas.grid.lights());
    report["view_thetas"] = degreesOf(atlas.grid.views());
    report["method"] = atlas.method;
    report["plan"] = atlas.plan;
    report["samples"] = atlas.samples;
    report["source"] = atlas.source;
    report["max_measured_theta"] = degreesFromRadians(atlas.maxMeasuredTheta);
    report["counts"] = {{"clamped", atlas.counts.clamped},
                        {"extrapolated", atlas.counts.extrapolated},
                        {"nonfinite", atlas.counts.nonfinite}};
    report["color_space"] = atlas.colorSpace;
    if (!atlas.conversion.empty()) report["conversion"] = atlas.conversion;
    report["color_interop_id"] = atlas.interopId;
    report["cosine"] = nameOf(atlas.cosine);
    report["missing"] = ordered_json::array();
    report["duplicate"] = ordered_json::array();
    report["unreadable"] = ordered_json::array();
    try {
        readAtlas(path);
    } catch (const std::runtime_error& error) {
        report["unreadable"].push_back(error.what());
    }
    report["complete"] = report["unreadable"].empty();
    return report;
}

}  // namespace

ordered_json inspect(const fs::path& path, const ProgressSink& progress) {
    return isAtlas(path) ? inspectAtlas(path) : inspectDatabase(path, progress);
}

std::string textOf(const ordered_json& report) {
    std::string text;
    for (const auto& [key, value] : report.items()) {
        const bool isFaults = key == "missing" || key == "duplicate" || key == "unreadable";
        if (!isFaults) {
            text += fmt::format("{:<20}{}\n", key,
                                value.is_string() ? value.get<std::string>() : value.dump());
            continue;
        }
        text += fmt::format("{:<20}{}\n", key, value.size());
        for (std::size_t i = 0; i < std::min<std::size_t>(5, value.size()); ++i) {
            text += fmt::format("{:<20}{}\n", "", value[i].get<std::string>());
        }
    }
    return text;
}

}  // namespace abrdf
