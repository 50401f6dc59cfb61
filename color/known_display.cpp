// SPDX-License-Identifier: BSD-3-Clause
#include "color/known_display.h"

#include "color/near_names.h"

#include <algorithm>

namespace abrdf {

namespace {

struct Row {
    DisplayEncoding encoding;
    std::vector<std::string> names;  ///< In the ASWF and Blender configs.
};

const std::vector<Row>& rows() {
    using Cicp = std::array<std::uint8_t, 4>;
    const Primaries rec709 = primaries(KnownSpace::kLinearRec709);
    const Primaries p3 = primaries(KnownSpace::kLinearP3D65);
    const Primaries rec2020 = primaries(KnownSpace::kLinearRec2020);
    static const std::vector<Row> kRows{
        {{"sRGB", rec709, DisplayCurve::kSrgb, 0, Cicp{1, 13, 0, 1}},
         {"sRGB - Display", "srgb_display", "sRGB"}},
        {{"Rec.1886 Rec.709", rec709, DisplayCurve::kPower, 2.4, {}},
         {"Rec.1886 Rec.709 - Display", "rec1886_rec709_display",
          "Rec.1886 / Rec.709 Video - Display", "Rec.1886"}},
        {{"Display P3", p3, DisplayCurve::kSrgb, 0, Cicp{12, 13, 0, 1}},
         {"Display P3 - Display", "displayp3_display", "Display P3"}},
        {{"P3-D65", p3, DisplayCurve::kPower, 2.6, {}}, {"P3-D65 - Display", "p3d65_display"}},
        {{"Rec.2100-PQ", rec2020, DisplayCurve::kPq, 0, Cicp{9, 16, 0, 1}},
         {"Rec.2100-PQ - Display", "rec2100_pq_display", "Rec.2100-PQ"}},
    };
    return kRows;
}

}  // namespace

std::optional<DisplayEncoding> knownDisplay(const std::vector<std::string>& namesAndAliases) {
    for (const std::string& name : namesAndAliases) {
        for (const Row& row : rows()) {
            if (std::ranges::any_of(row.names,
                                    [&](const auto& known) { return sameLetters(known, name); })) {
                return row.encoding;
            }
        }
    }
    return std::nullopt;
}

}  // namespace abrdf
