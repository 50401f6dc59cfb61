// SPDX-License-Identifier: BSD-3-Clause
#include "stages/align/shift_image.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace abrdf {

std::vector<Between> shiftedPlaces(int count, double shift, Edges edges) {
    // A shift that is whole but for rounding is whole: no texel is then lost at an edge.
    constexpr double kRounding = 1e-6;
    const double whole = std::floor(shift + kRounding);
    const auto share = static_cast<float>(std::max(shift - whole, 0.0));
    const auto n = static_cast<long>(count);
    const auto index = [&](long i) {
        const long rest = edges == Edges::kPeriodic ? i % n : std::clamp(i, 0L, n - 1);
        return static_cast<std::size_t>(rest < 0 ? rest + n : rest);
    };
    std::vector<Between> places(static_cast<std::size_t>(count));
    for (long i = 0; i < n; ++i) {
        const long first = i + static_cast<long>(whole);
        const long last = share > 0 ? first + 1 : first;
        places[static_cast<std::size_t>(i)] = {
            index(first), index(last), share,
            edges == Edges::kPeriodic || (first >= 0 && last < n)};
    }
    return places;
}

Shift parallax(double height, Direction view) {
    const double distance = height * std::tan(std::min(view.theta, radiansFromDegrees(87)));
    return {-distance * std::cos(view.phi), distance * std::sin(view.phi)};  // Rows go down.
}

std::size_t shiftImage(std::span<const Rgb> image, int width, int height, Shift shift, Edges edges,
                       std::span<Rgb> result) {
    assert(image.size() == result.size() && image.data() != result.data());
    const std::vector<Between> columns = shiftedPlaces(width, shift.x, edges);
    const std::vector<Between> rows = shiftedPlaces(height, shift.y, edges);
    const auto w = static_cast<std::size_t>(width);
    std::size_t outside = 0;
    for (std::size_t y = 0; y < rows.size(); ++y) {
        const auto upper = image.subspan(rows[y].first * w, w);
        const auto lower = image.subspan(rows[y].second * w, w);
        const auto between = [](Rgb a, Rgb b, float share) {
            return share > 0 ? (1 - share) * a + share * b : a;
        };
        for (std::size_t x = 0; x < columns.size(); ++x) {
            const Between& column = columns[x];
            Rgb& texel = result[y * w + x];
            if (!column.isInside || !rows[y].isInside) {
                constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
                texel = {kNaN, kNaN, kNaN};
                ++outside;
                continue;
            }
            texel = between(between(upper[column.first], upper[column.second], column.share),
                            between(lower[column.first], lower[column.second], column.share),
                            rows[y].share);
        }
    }
    return outside;
}

}  // namespace abrdf
