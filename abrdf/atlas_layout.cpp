// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/atlas_layout.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

std::string nameOf(AtlasKind kind) {
    switch (kind) {
        case AtlasKind::kAngular:
            return "angular";
        case AtlasKind::kSpatial:
            return "spatial";
        case AtlasKind::kModel:
            return "model";
    }
    return "angular";
}

AtlasKind atlasKindFromName(const std::string& name) {
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial, AtlasKind::kModel}) {
        if (name == nameOf(kind)) return kind;
    }
    throw std::invalid_argument(
        fmt::format("there is no layout '{}': use angular, spatial or model", name));
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
