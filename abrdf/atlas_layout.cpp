// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/atlas_layout.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

std::string nameOf(AtlasKind kind) {
    return kind == AtlasKind::kAngular ? "angular" : "spatial";
}

AtlasKind atlasKindFromName(const std::string& name) {
    if (name == "angular") return AtlasKind::kAngular;
    if (name == "spatial") return AtlasKind::kSpatial;
    throw std::invalid_argument(
        fmt::format("there is no layout '{}': use angular or spatial", name));
}

AtlasPixel AtlasLayout::pixelFromSample(const AtlasSample& s) const {
    if (kind == AtlasKind::kAngular) {
        return {s.texelX * views + s.view, s.texelY * lights + s.light};
    }
    return {s.view * texelsWide + s.texelX, s.light * texelsHigh + s.texelY};
}

AtlasSample AtlasLayout::sampleFromPixel(const AtlasPixel& p) const {
    if (kind == AtlasKind::kAngular) {
        return {p.x / views, p.y / lights, p.y % lights, p.x % views};
    }
    return {p.x % texelsWide, p.y % texelsHigh, p.y / texelsHigh, p.x / texelsWide};
}

}  // namespace abrdf
