// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/job_shards.h"

#include "pipeline/convert/tile_journal.h"

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

ordered_json jobOf(const AtlasTiles& shard, const fs::path& path) {
    ordered_json job = ordered_json::parse(shard.header().job, nullptr, false);
    if (shard.header().shard == 0) {
        throw std::runtime_error(fmt::format(
            "{}: is a whole atlas and no part of one; give only what one convert --shard I/N made",
            path.string()));
    }
    if (!job.is_object() || shard.header().layout.kind != AtlasKind::kAngular) {
        throw std::runtime_error(fmt::format(
            "{}: is no shard of an atlas; those are made by convert --shard I/N", path.string()));
    }
    for (const char* key : {"layout", "texels", "compression"}) {
        if (job.contains(key) && job[key].is_string()) continue;
        throw std::runtime_error(
            fmt::format("{}: has a damaged header: its job lacks its {}", path.string(), key));
    }
    return job;
}

/// What all shards of a job have alike, whatever its text says.
std::string formOf(const AtlasLayout& layout) {
    return fmt::format("texels {} wide of {} x {} directions", layout.texelsWide, layout.lights,
                       layout.views);
}

/// Throws where a shard is of another job than the first, or of another division of it.
void checkOneJob(const std::vector<AtlasTiles>& shards, const std::vector<fs::path>& paths) {
    const ordered_json job = jobOf(shards[0], paths[0]);
    for (std::size_t i = 1; i < shards.size(); ++i) {
        std::string changed = differences(job, jobOf(shards[i], paths[i]));
        if (shards[i].header().shards != shards[0].header().shards) {
            changed = fmt::format("one is of {} parts, the other of {}", shards[0].header().shards,
                                  shards[i].header().shards);
        } else if (changed.empty() &&
                   shards[i].estimates().empty() != shards[0].estimates().empty()) {
            changed =
                "one tells the error of its texels, the other does not; convert all parts with one "
                "version of abrdf";
        } else if (changed.empty() && shards[i].type() != shards[0].type()) {
            changed = fmt::format(
                "pixels were {} and are {}, as a value in one part fits no half; convert all parts "
                "with --pixel float, or with half",
                nameOf(shards[0].type()), nameOf(shards[i].type()));
        }
        const std::string form = formOf(shards[i].header().layout);
        if (changed.empty() && form != formOf(shards[0].header().layout)) {
            changed = fmt::format("{} instead of {}", form, formOf(shards[0].header().layout));
        }
        if (changed.empty()) continue;
        throw std::runtime_error(fmt::format("{}: is not of the job of {}: {}", paths[i].string(),
                                             paths[0].string(), changed));
    }
}

/// The shards in order of their parts. Throws where one is missing or there twice.
std::vector<AtlasTiles> inOrder(const std::vector<fs::path>& paths) {
    std::vector<AtlasTiles> shards;
    for (const fs::path& path : paths) shards.emplace_back(path);
    checkOneJob(shards, paths);
    const auto count = static_cast<std::size_t>(shards[0].header().shards);
    std::vector<std::size_t> partAt(count, shards.size());
    for (std::size_t i = 0; i < shards.size(); ++i) {
        std::size_t& at = partAt[static_cast<std::size_t>(shards[i].header().shard - 1)];
        if (at < shards.size()) {
            throw std::runtime_error(fmt::format("{} and {} are both part {} of {}",
                                                 paths[at].string(), paths[i].string(),
                                                 shards[i].header().shard, count));
        }
        at = i;
    }
    std::string missing;
    std::vector<AtlasTiles> ordered;
    for (std::size_t part = 0; part < count; ++part) {
        if (partAt[part] == shards.size()) {
            missing += fmt::format("{}{}", missing.empty() ? "" : ", ", part + 1);
        } else {
            ordered.push_back(std::move(shards[partAt[part]]));
        }
    }
    if (!missing.empty()) {
        throw std::runtime_error(fmt::format("{}: of the {} parts of its job these are missing: {}",
                                             paths[0].string(), count, missing));
    }
    return ordered;
}

AtlasHeader wholeHeader(const std::vector<AtlasTiles>& shards, const ordered_json& job,
                        const fs::path& first) {
    AtlasHeader header = shards[0].header();
    header.shard = 0;
    header.shards = 0;
    header.counts = {};
    header.layout.texelsHigh = 0;
    const int tileHeight = shards[0].order().tileHeight();
    for (const AtlasTiles& shard : shards) {
        if (header.layout.texelsHigh % tileHeight != 0) {
            throw std::runtime_error(fmt::format(
                "{}: part {} begins within a tile of the whole, and convert --shard cuts between "
                "them; make the parts again",
                first.string(), shard.header().shard));
        }
        header.layout.texelsHigh += shard.header().layout.texelsHigh;
        header.counts += shard.header().counts;
    }
    header.layout.kind = atlasKindFromName(job["layout"].get<std::string>());
    const auto texels = fmt::format("{}x{}", header.layout.texelsWide, header.layout.texelsHigh);
    if (job["texels"] != texels) {
        throw std::runtime_error(fmt::format("{}: its job has {} texels, its parts together {}",
                                             first.string(), job["texels"].get<std::string>(),
                                             texels));
    }
    return header;
}

/// Those of all texels, row by row; none where the shards have none.
std::vector<float> estimatesOf(const std::vector<AtlasTiles>& shards) {
    std::vector<float> rows;
    for (const AtlasTiles& shard : shards) {
        const std::vector<float> more = shard.estimates();
        rows.insert(rows.end(), more.begin(), more.end());
    }
    return rows;
}

}  // namespace

JobShards openShards(const std::vector<fs::path>& paths) {
    JobShards shards;
    shards.parts = inOrder(paths);
    shards.job = jobOf(shards.parts[0], paths[0]);
    shards.header = wholeHeader(shards.parts, shards.job, paths[0]);
    shards.estimates = estimatesOf(shards.parts);
    return shards;
}

}  // namespace abrdf
