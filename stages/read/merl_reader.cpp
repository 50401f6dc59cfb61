// SPDX-License-Identifier: BSD-3-Clause
//
// MERL .binary [Matusik et al. 2003]: three int32 (90 90 180), then three planes of doubles, red,
// green and blue; isotropic BRDFs. Negative entries mean that there is no data.
#include "abrdf/merl_table.h"
#include "stages/read/byte_cursor.h"
#include "stages/read/mapped_file.h"
#include "stages/read/table_reader.h"

#include <fmt/format.h>

#include <limits>

namespace abrdf {

namespace {

using Sizes = std::array<std::int32_t, 3>;
constexpr Sizes kSizes = {merl::kThetaHalf, merl::kThetaDifference, merl::kPhiDifference};

Sizes sizesFrom(const std::string& head) {
    Sizes sizes{};
    if (head.size() >= sizeof sizes) std::memcpy(sizes.data(), head.data(), sizeof sizes);
    return sizes;
}

Sizes swapped(const Sizes& sizes) {
    Sizes result{};
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        result[i] =
            static_cast<std::int32_t>(__builtin_bswap32(static_cast<std::uint32_t>(sizes[i])));
    }
    return result;
}

bool isMerlName(const std::string& name) {
    return name.ends_with(".binary");
}

}  // namespace

bool recognizesMerl(const DatabasePath& path) {
    const Sizes sizes = sizesFrom(path.head);
    return !path.files && path.head.size() >= sizeof(Sizes) &&
           (sizes == kSizes || swapped(sizes) == kSizes || isMerlName(path.name()));
}

std::unique_ptr<BtfReader> makeMerlReader(const DatabasePath& path) {
    const MappedFile map(path.path);
    ByteCursor file(map.bytes(), path.path.string());
    const Sizes sizes = {file.number<std::int32_t>("sizes"), file.number<std::int32_t>("sizes"),
                         file.number<std::int32_t>("sizes")};
    if (swapped(sizes) == kSizes) file.fail("it is big-endian, and MERL's files are little-endian");
    if (sizes != kSizes) {
        file.fail(fmt::format("it declares {} x {} x {} entries, a MERL file 90 x 90 x 180",
                              sizes[0], sizes[1], sizes[2]));
    }
    const auto bytes = file.take(3 * merl::kEntries * sizeof(double), "three planes of doubles");
    if (file.left() > 0) file.fail(fmt::format("{} bytes follow its data", file.left()));
    const auto stored = [&](std::size_t plane, std::size_t entry) {
        double value = 0;
        std::memcpy(&value, bytes.data() + sizeof value * (plane * merl::kEntries + entry),
                    sizeof value);
        return value;
    };
    std::vector<Rgb> brdf(merl::kEntries);
    std::size_t empty = 0;
    for (std::size_t i = 0; i < brdf.size(); ++i) {
        std::array<float, 3> f{};
        bool hasData = true;
        for (std::size_t c = 0; c < 3; ++c) {
            const double value = stored(c, i);
            hasData = hasData && value >= 0;
            f[c] = static_cast<float>(value * merl::kScales[c]);
        }
        constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
        brdf[i] = hasData ? Rgb{f[0], f[1], f[2]} : Rgb{kNaN, kNaN, kNaN};
        empty += hasData ? 0U : 1U;
    }
    map.checkWhole();
    BtfDescription description = tableDescription(path, "MERL");
    description.belowHorizon = empty;
    description.notes.push_back(fmt::format("{} of {} entries hold no data", empty, brdf.size()));
    return makeTableReader(path, std::move(description),
                           std::make_unique<MerlTable>(std::move(brdf)));
}

}  // namespace abrdf
