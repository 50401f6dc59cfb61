// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/atlas_header.h"

#include "color/known_space.h"

#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace abrdf {

namespace {

Imf::FloatVector floatsFromDirections(const std::vector<Direction>& directions) {
    Imf::FloatVector values;
    for (const Direction& d : directions) {
        values.push_back(static_cast<float>(d.theta));
        values.push_back(static_cast<float>(d.phi));
    }
    return values;
}

std::vector<Direction> directionsFromFloats(const Imf::FloatVector& values) {
    std::vector<Direction> directions;
    for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
        directions.push_back({values[i], values[i + 1]});
    }
    return directions;
}

Imf::Chromaticities chromaticitiesOf(const Primaries& p) {
    const auto xy = [](const std::array<float, 2>& c) { return Imath::V2f(c[0], c[1]); };
    return {xy(p.red), xy(p.green), xy(p.blue), xy(p.white)};
}

template <typename Attribute>
const auto& valueOf(const Imf::Header& header, const char* name, const std::string& file) {
    const auto* attribute = header.findTypedAttribute<Attribute>(name);
    if (attribute == nullptr) {
        throw std::runtime_error(fmt::format(
            "{}: is not an abrdf atlas: its header lacks the attribute {}", file, name));
    }
    return attribute->value();
}

constexpr int kMostShards = 1 << 20;  ///< No atlas has as many rows of tiles.

/// What atlases of an early day lack.
void readOptional(const Imf::Header& header, AtlasHeader& atlas, const std::string& file) {
    if (const auto* plane = header.findTypedAttribute<Imf::FloatAttribute>("abrdf:plane")) {
        atlas.plane = static_cast<double>(plane->value());
    }
    if (const auto* margin = header.findTypedAttribute<Imf::IntAttribute>("abrdf:margin")) {
        atlas.margin = std::max(0, margin->value());
    }
    if (const auto* outside = header.findTypedAttribute<Imf::IntAttribute>("abrdf:outside")) {
        atlas.counts.outside = static_cast<std::uint64_t>(std::max(0, outside->value()));
    }
    using Text = Imf::StringAttribute;
    if (const auto* conversion = header.findTypedAttribute<Text>("abrdf:conversion")) {
        atlas.conversion = conversion->value();
    }
    if (const auto* job = header.findTypedAttribute<Text>("abrdf:job")) atlas.job = job->value();
    if (const auto* shard = header.findTypedAttribute<Imf::V2iAttribute>("abrdf:shard")) {
        atlas.shard = shard->value().x;
        atlas.shards = shard->value().y;
        if (atlas.shard < 1 || atlas.shard > atlas.shards || atlas.shards > kMostShards) {
            throw std::runtime_error(fmt::format("{}: has a damaged header: it is part {} of {}",
                                                 file, atlas.shard, atlas.shards));
        }
    }
}

void checkSize(const Imf::Header& header, const AtlasLayout& layout, const std::string& file) {
    const Imath::Box2i& window = header.dataWindow();
    const bool isModel = layout.kind == AtlasKind::kModel;
    const bool fits = layout.texelsWide > 0 && layout.texelsHigh > 0 &&
                      layout.texelsWide < (1 << 20) && layout.texelsHigh < (1 << 20) &&
                      std::int64_t{layout.texelsWide} * (isModel ? 1 : layout.views) ==
                          std::int64_t{window.max.x} + 1 &&
                      std::int64_t{layout.texelsHigh} * (isModel ? 1 : layout.lights) ==
                          std::int64_t{window.max.y} + 1 &&
                      window.min == Imath::V2i(0, 0);
    if (!fits) {
        throw std::runtime_error(fmt::format(
            "{}: has a damaged header: {} x {} texels of {} lights and {} views are not its image "
            "of {} x {} pixels",
            file, layout.texelsWide, layout.texelsHigh, layout.lights, layout.views,
            window.max.x + 1, window.max.y + 1));
    }
}

}  // namespace

ValueCounts& ValueCounts::operator+=(const ValueCounts& other) {
    clamped += other.clamped;
    extrapolated += other.extrapolated;
    nonfinite += other.nonfinite;
    missing += other.missing;
    outside += other.outside;
    return *this;
}

int headerCount(std::uint64_t count) {
    return static_cast<int>(
        std::min<std::uint64_t>(count, std::uint64_t{std::numeric_limits<int>::max()}));
}

void storeAtlasHeader(const AtlasHeader& atlas, Imf::Header& header) {
    using Imf::IntAttribute;
    using Imf::StringAttribute;
    header.insert("abrdf:version", IntAttribute(kAtlasVersion));
    header.insert("abrdf:layout", StringAttribute(nameOf(atlas.layout.kind)));
    header.insert("abrdf:texels",
                  Imf::V2iAttribute({atlas.layout.texelsWide, atlas.layout.texelsHigh}));
    header.insert("abrdf:lights",
                  Imf::FloatVectorAttribute(floatsFromDirections(atlas.grid.lights())));
    header.insert("abrdf:views",
                  Imf::FloatVectorAttribute(floatsFromDirections(atlas.grid.views())));
    header.insert("abrdf:method", StringAttribute(atlas.method));
    header.insert("abrdf:plan", StringAttribute(atlas.plan));
    header.insert("abrdf:samples", IntAttribute(atlas.samples));
    header.insert("abrdf:source", StringAttribute(atlas.source));
    header.insert("abrdf:cosine", StringAttribute(nameOf(atlas.cosine)));
    header.insert("abrdf:maxMeasuredTheta",
                  Imf::FloatAttribute(static_cast<float>(atlas.maxMeasuredTheta)));
    header.insert("abrdf:plane", Imf::FloatAttribute(static_cast<float>(atlas.plane)));
    header.insert("abrdf:margin", IntAttribute(atlas.margin));
    header.insert("abrdf:outside", IntAttribute(headerCount(atlas.counts.outside)));
    header.insert("abrdf:clamped", IntAttribute(headerCount(atlas.counts.clamped)));
    header.insert("abrdf:extrapolated", IntAttribute(headerCount(atlas.counts.extrapolated)));
    header.insert("abrdf:nonfinite", IntAttribute(headerCount(atlas.counts.nonfinite)));
    header.insert("abrdf:colorSpace", StringAttribute(atlas.colorSpace));
    if (!atlas.job.empty()) header.insert("abrdf:job", StringAttribute(atlas.job));
    if (atlas.shard > 0) {
        header.insert("abrdf:shard", Imf::V2iAttribute({atlas.shard, atlas.shards}));
    }
    if (!atlas.conversion.empty()) {
        header.insert("abrdf:conversion", StringAttribute(atlas.conversion));
    }
    header.insert("colorInteropID", StringAttribute(atlas.interopId));
    header.insert("Software", StringAttribute("abrdf"));
    if (const auto space = knownSpaceFromInteropId(atlas.interopId)) {
        Imf::addChromaticities(header, chromaticitiesOf(primaries(*space)));
    }
}

AtlasHeader atlasHeaderFrom(const Imf::Header& header, const std::string& file) {
    const auto text = [&](const char* name) {
        return valueOf<Imf::StringAttribute>(header, name, file);
    };
    const auto number = [&](const char* name) {
        return valueOf<Imf::IntAttribute>(header, name, file);
    };
    const auto count = [&](const char* name) {
        return static_cast<std::uint64_t>(std::max(0, number(name)));
    };
    if (number("abrdf:version") != kAtlasVersion) {
        throw std::runtime_error(fmt::format("{}: is an atlas of version {}; this program reads {}",
                                             file, number("abrdf:version"), kAtlasVersion));
    }
    AtlasHeader atlas;
    try {
        atlas.grid = AngularGrid(
            directionsFromFloats(valueOf<Imf::FloatVectorAttribute>(header, "abrdf:lights", file)),
            directionsFromFloats(valueOf<Imf::FloatVectorAttribute>(header, "abrdf:views", file)));
        atlas.layout.kind = atlasKindFromName(text("abrdf:layout"));
        atlas.cosine = cosineFromName(text("abrdf:cosine"));
    } catch (const std::invalid_argument& error) {
        throw std::runtime_error(fmt::format("{}: has a damaged header: {}", file, error.what()));
    }
    const Imath::V2i texels = valueOf<Imf::V2iAttribute>(header, "abrdf:texels", file);
    atlas.layout.texelsWide = texels.x;
    atlas.layout.texelsHigh = texels.y;
    atlas.layout.lights = static_cast<int>(atlas.grid.lights().size());
    atlas.layout.views = static_cast<int>(atlas.grid.views().size());
    atlas.method = text("abrdf:method");
    atlas.plan = text("abrdf:plan");
    atlas.samples = number("abrdf:samples");
    atlas.source = text("abrdf:source");
    atlas.maxMeasuredTheta =
        static_cast<double>(valueOf<Imf::FloatAttribute>(header, "abrdf:maxMeasuredTheta", file));
    atlas.counts.clamped = count("abrdf:clamped");
    atlas.counts.extrapolated = count("abrdf:extrapolated");
    atlas.counts.nonfinite = count("abrdf:nonfinite");
    atlas.colorSpace = text("abrdf:colorSpace");
    atlas.interopId = text("colorInteropID");
    readOptional(header, atlas, file);
    checkSize(header, atlas.layout, file);
    return atlas;
}

}  // namespace abrdf
