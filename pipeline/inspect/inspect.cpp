// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/inspect/inspect.h"

#include "abrdf/printable.h"
#include "pipeline/convert/estimate_report.h"
#include "pipeline/inspect/stack_facts.h"
#include "pipeline/job.h"
#include "pipeline/named_pair.h"
#include "stages/read/atlas_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

ordered_json degreesOf(const std::vector<Direction>& directions) {
    std::set<double> thetas;
    for (const Direction& d : directions) {
        thetas.insert(std::round(degreesFromRadians(d.theta) * 100) / 100);
    }
    return thetas;
}

/// What the values alone say of the cosine.
std::string cosineByReciprocity(const Reciprocity& reciprocity) {
    const Cosine guess = cosineFromReciprocity(reciprocity, Cosine::kDivided);
    return guess == Cosine::kDivided ? "undecided" : nameOf(guess);
}

ordered_json jsonOf(const Reciprocity& reciprocity) {
    if (reciprocity.pairs == 0) return {{"pairs", 0}};
    return {{"pairs", reciprocity.pairs},
            {"rms_as_stored", reciprocity.rmsAsStored},
            {"rms_divided_by_cosine", reciprocity.rmsDivided},
            {"largest", reciprocity.largest},
            {"where", pairName(reciprocity.where)},
            {"cosine_by_it", cosineByReciprocity(reciprocity)}};
}

/// The part of the report that images alone can tell.
void addFacts(const BtfReader& reader, const ProgressSink& progress, ordered_json& report) {
    const ColorConfig colors = ColorConfig::load();
    const Linearizer linearizer(colors.transform(reader.description().colorSpace, "scene_linear"));
    const StackFacts facts = stackFacts(reader, linearizer, progress);
    if (facts.least <= facts.greatest) report["stored_range"] = {facts.least, facts.greatest};
    report["nonfinite"] = facts.nonfinite;
    report["reciprocity"] = jsonOf(facts.reciprocity);
    report["unreadable"] = facts.unreadable;
}

ordered_json inspectDatabase(const fs::path& path, const ReadOptions& options,
                             const ProgressSink& progress) {
    const auto reader = openBtf(path, options);
    const BtfDescription& description = reader->description();
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
    report["max_measured_theta"] = degreesFromRadians(description.maxMeasuredTheta);
    report["below_horizon"] = description.belowHorizon;
    report["color_space"] = description.colorSpace;
    report["cosine"] = nameOf(description.cosine);
    report["cosine_from"] = description.cosineFrom;
    report["notes"] = description.notes;
    addFacts(*reader, progress, report);
    report["missing"] = missing;
    report["duplicate"] = description.duplicates;
    report["complete"] =
        missing.empty() && description.duplicates.empty() && report["unreadable"].empty();
    return report;
}

ordered_json inspectAtlas(const fs::path& path, const ProgressSink& progress) {
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
    report["max_theta"] = degreesFromRadians(atlas.grid.maxTheta());
    report["max_measured_theta"] = degreesFromRadians(atlas.maxMeasuredTheta);
    report["counts"] = {{"clamped", atlas.counts.clamped},
                        {"extrapolated", atlas.counts.extrapolated},
                        {"nonfinite", atlas.counts.nonfinite}};
    report["color_space"] = atlas.colorSpace;
    if (!atlas.conversion.empty()) report["conversion"] = atlas.conversion;
    report["color_interop_id"] = atlas.interopId;
    report["cosine"] = nameOf(atlas.cosine);
    report["cosine_from"] = "header";
    try {
        addEstimate(readEstimates(path), report);
        addFacts(*openBtf(path), progress, report);
    } catch (const std::runtime_error& error) {
        report["unreadable"] = {error.what()};
    }
    report["missing"] = ordered_json::array();
    report["duplicate"] = ordered_json::array();
    report["complete"] = report["unreadable"].empty();
    return report;
}

}  // namespace

ordered_json inspect(const fs::path& path, const ProgressSink& progress,
                     const ReadOptions& options) {
    return isAtlas(path) ? inspectAtlas(path, progress) : inspectDatabase(path, options, progress);
}

std::string textOf(const ordered_json& report) {
    std::string text;
    const auto line = [&](const std::string& key, const std::string& value) {
        text += fmt::format("{:<20}{}\n", key, printable(value));
    };
    for (const auto& [key, value] : report.items()) {
        if (key == "notes") {
            for (const ordered_json& note : value) line("note", note.get<std::string>());
        } else if (key == "missing" || key == "duplicate" || key == "unreadable") {
            line(key, fmt::format("{}", value.size()));
            for (std::size_t i = 0; i < std::min<std::size_t>(5, value.size()); ++i) {
                line("", value[i].get<std::string>());
            }
        } else {
            line(key, value.is_string() ? value.get<std::string>() : value.dump());
        }
    }
    return text;
}

}  // namespace abrdf
