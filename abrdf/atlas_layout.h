// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace abrdf {

enum class AtlasKind {
    kAngular,  ///< A rectangle of all pairs a texel: rows light, columns view (UTIA's order).
    kSpatial,  ///< A map of all texels a pair.
    kModel,    ///< A map of few numbers a texel, and a basis (abrdf/model_atlas.h).
};

/// "angular", "spatial" or "model". The inverse throws std::invalid_argument for other names.
std::string nameOf(AtlasKind kind);
AtlasKind atlasKindFromName(const std::string& name);

/// Which texel and which pair a value of an atlas belongs to.
struct AtlasSample {
    int texelX = 0;
    int texelY = 0;
    int light = 0;
    int view = 0;

    bool operator==(const AtlasSample&) const = default;
};

struct AtlasPixel {
    int x = 0;
    int y = 0;

    bool operator==(const AtlasPixel&) const = default;
};

/// Where the values of width x height texels and lights x views pairs stand in an atlas.
struct AtlasLayout {
    AtlasKind kind = AtlasKind::kAngular;
    int texelsWide = 1;
    int texelsHigh = 1;
    int lights = 1;
    int views = 1;

    bool operator==(const AtlasLayout&) const = default;

    int width() const { return kind == AtlasKind::kModel ? texelsWide : texelsWide * views; }
    int height() const { return kind == AtlasKind::kModel ? texelsHigh : texelsHigh * lights; }
    std::size_t texelCount() const {
        return static_cast<std::size_t>(texelsWide) * static_cast<std::size_t>(texelsHigh);
    }

    /// Of an angular or spatial atlas.
    AtlasPixel pixelFromSample(const AtlasSample& sample) const;
    AtlasSample sampleFromPixel(const AtlasPixel& pixel) const;
};

}  // namespace abrdf
