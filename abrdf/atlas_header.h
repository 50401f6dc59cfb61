// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/atlas_layout.h"
#include "abrdf/cosine.h"

#include <ImfHeader.h>

#include <cstdint>
#include <string>

namespace abrdf {

/// How many values needed care. A value is one colour: one pair of one texel.
struct ValueCounts {
    std::uint64_t clamped = 0;       ///< Below 0 after reconstruction, or above half's range: cut.
    std::uint64_t extrapolated = 0;  ///< At a theta past the largest measured one.
    std::uint64_t nonfinite =
        0;                      ///< NaN, infinite or negative in the input, or made so on the way.
    std::uint64_t missing = 0;  ///< Missing images that were interpolated on request.
    std::uint64_t outside = 0;  ///< Pixels of shifted images that lie outside them.

    ValueCounts& operator+=(const ValueCounts& other);
};

/// All that an atlas says of itself (interface.md, "Files").
struct AtlasHeader {
    AtlasLayout layout;
    AngularGrid grid;
    std::string method;
    std::string plan;
    int samples = 0;
    std::string source;
    Cosine cosine = Cosine::kKept;
    Radians maxMeasuredTheta = 0;
    /// A texel shows one place of the plane z = plane in all views, in texels of the database's
    /// images; 0: as the database was rectified.
    double plane = 0;
    int margin = 0;  ///< Texels from an edge within which shifted images lack some; 0: none does.
    ValueCounts counts;
    std::string colorSpace;  ///< OpenColorIO name.
    std::string interopId;   ///< Color Interop Forum id, "unknown" where the space is none of ours.
    std::string conversion;  ///< "sRGB - Texture -> ACEScg": of the input's colours; may be empty.
    std::string job;         ///< JSON of all that these values depend on; may be empty.
    int shard = 0;           ///< Of a part of an atlas: 1 .. shards; 0: it is whole.
    int shards = 0;
};

constexpr int kAtlasVersion = 1;

/// A count as the header's 32-bit integers hold it: a larger one stands as the largest.
int headerCount(std::uint64_t count);

/// Writes `atlas` into attributes `abrdf:*`, with chromaticities and colorInteropID.
void storeAtlasHeader(const AtlasHeader& atlas, Imf::Header& header);

/// The inverse. Throws std::runtime_error, naming `file`, where an attribute is absent or
/// contradicts another or the image's size.
AtlasHeader atlasHeaderFrom(const Imf::Header& header, const std::string& file);

}  // namespace abrdf
