// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/tabulated_warp.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace abrdf {

namespace {

/// The node before a place, and how far the place is on to the next one.
struct NodePlace {
    std::size_t node = 0;
    double share = 0;
};

NodePlace nodePlace(double place, std::size_t nodes) {
    // Not clamp(): a density with negative or huge numbers can make NaN of a place.
    const double inside = place > 0 ? std::min(place, 1.0) : 0;
    const double scaled = inside * static_cast<double>(nodes - 1);
    const std::size_t node = std::min(static_cast<std::size_t>(scaled), nodes - 2);
    return {node, scaled - static_cast<double>(node)};
}

double mix(double a, double b, double share) {
    return (1 - share) * a + share * b;
}

/// values[offset] of each table of `stride` values, blended.
double blended(const std::vector<float>& values, std::size_t stride, std::size_t offset,
               const TableBlend& blend) {
    double sum = 0;
    for (std::size_t i = 0; i < blend.tables.size(); ++i) {
        if (blend.weights[i] == 0) continue;
        sum += blend.weights[i] * static_cast<double>(values[blend.tables[i] * stride + offset]);
    }
    return sum;
}

/// a / b, or 0 where the density is.
double ratio(double a, double b) {
    return b > 0 ? a / b : 0;
}

/// How far into an interval of length 1 the integral of a density, linear from `a` to `b` over it,
/// reaches `area`.
double reach(double a, double b, double area) {
    const double slope = b - a;
    const double root = std::sqrt(std::max(0.0, a * a + 2 * slope * area));
    return std::clamp(ratio(2 * area, a + root), 0.0, 1.0);
}

/// The last node but one whose integral is not past `area`.
std::size_t nodeBefore(std::span<const double> integral, double area) {
    const auto above = std::upper_bound(integral.begin(), integral.end() - 1, area);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(
        0, std::min(above - integral.begin() - 1, std::ssize(integral) - 2)));
}

}  // namespace

double TableStack::at(SquarePlace place, const TableBlend& blend) const {
    const NodePlace x = nodePlace(place.x, width_);
    const NodePlace y = nodePlace(place.y, height_);
    const auto node = [&](std::size_t dx, std::size_t dy) {
        return blended(values_, width_ * height_, (y.node + dy) * width_ + x.node + dx, blend);
    };
    return mix(mix(node(0, 0), node(1, 0), x.share), mix(node(0, 1), node(1, 1), x.share), y.share);
}

TabulatedWarp::TabulatedWarp(TableStack density) : density_(std::move(density)) {
    const std::size_t width = density_.width_;
    const std::size_t height = density_.height_;
    std::vector<double> rows(height);
    for (std::size_t table = 0; table < density_.count(); ++table) {
        float* values = density_.values_.data() + table * width * height;
        // Integrals of the bilinear density by the trapezoid rule, which is exact for it.
        double total = 0;
        const auto rowIntegral = [&](std::size_t y, const auto& keep) {
            double sum = 0;
            keep(0.0);
            for (std::size_t x = 0; x + 1 < width; ++x) {
                sum += 0.5 * (static_cast<double>(values[y * width + x]) +
                              static_cast<double>(values[y * width + x + 1]));
                keep(sum);
            }
            return sum;
        };
        for (std::size_t y = 0; y < height; ++y) {
            rows[y] = rowIntegral(y, [](double) {});
            if (y > 0) total += 0.5 * (rows[y - 1] + rows[y]);
        }
        const double scale = ratio(1, total);
        for (std::size_t y = 0; y < height; ++y) {
            rowIntegral(
                y, [&](double sum) { conditional_.push_back(static_cast<float>(scale * sum)); });
        }
        double sum = 0;
        for (std::size_t y = 0; y < height; ++y) {
            if (y > 0) sum += 0.5 * (rows[y - 1] + rows[y]);
            marginal_.push_back(static_cast<float>(scale * sum));
        }
        for (std::size_t i = 0; i < width * height; ++i) {
            values[i] = static_cast<float>(scale * static_cast<double>(values[i]));
        }
    }
}

SquarePlace TabulatedWarp::invert(SquarePlace place, const TableBlend& blend) const {
    const std::size_t width = density_.width_;
    const std::size_t height = density_.height_;
    const NodePlace x = nodePlace(place.x, width);
    const NodePlace y = nodePlace(place.y, height);
    const auto density = [&](std::size_t dx) {
        const auto at = [&](std::size_t dy) {
            return blended(density_.values_, width * height, (y.node + dy) * width + x.node + dx,
                           blend);
        };
        return mix(at(0), at(1), y.share);
    };
    // Integral along the blended row from its begin to x, over that of the whole row.
    const auto conditional = [&](std::size_t node) {
        const auto at = [&](std::size_t dy) {
            return blended(conditional_, width * height, (y.node + dy) * width + node, blend);
        };
        return std::array{at(0), at(1)};
    };
    const double left = density(0);
    const auto before = conditional(x.node);
    const auto whole = conditional(width - 1);
    const double along = x.share * (left + 0.5 * x.share * (density(1) - left));
    const double row = mix(whole[0], whole[1], y.share);
    const double upTo = y.share * (whole[0] + 0.5 * y.share * (whole[1] - whole[0]));
    return {ratio(mix(before[0], before[1], y.share) + along, row),
            blended(marginal_, height, y.node, blend) + upTo};
}

double TabulatedWarp::density(SquarePlace place, const TableBlend& blend) const {
    const auto cells = static_cast<double>((density_.width_ - 1) * (density_.height_ - 1));
    return cells * density_.at(place, blend);
}

double TabulatedWarp::nodeDensity(std::size_t x, std::size_t y, std::size_t table) const {
    const std::size_t width = density_.width_;
    return static_cast<double>(density_.values_[table * width * density_.height_ + y * width + x]);
}

SquarePlace TabulatedWarp::warp(SquarePlace place, std::size_t table) const {
    const std::size_t width = density_.width_;
    const std::size_t height = density_.height_;
    std::vector<double> integral(height);
    const std::size_t rows = table * height;
    for (std::size_t y = 0; y < height; ++y) {
        integral[y] = static_cast<double>(marginal_[rows + y]);
    }
    const auto whole = [&](std::size_t y) {
        return static_cast<double>(conditional_[(rows + y) * width + width - 1]);
    };
    const double up = std::clamp(place.y, 0.0, 1.0) * integral.back();
    const std::size_t y = nodeBefore(integral, up);
    const double shareY = reach(whole(y), whole(y + 1), up - integral[y]);
    integral.resize(width);
    for (std::size_t x = 0; x < width; ++x) {
        const auto at = [&](std::size_t row) {
            return static_cast<double>(conditional_[(rows + row) * width + x]);
        };
        integral[x] = mix(at(y), at(y + 1), shareY);
    }
    const double along = std::clamp(place.x, 0.0, 1.0) * integral.back();
    const std::size_t x = nodeBefore(integral, along);
    const auto node = [&](std::size_t at) {
        return mix(nodeDensity(at, y, table), nodeDensity(at, y + 1, table), shareY);
    };
    const double shareX = reach(node(x), node(x + 1), along - integral[x]);
    return {(static_cast<double>(x) + shareX) / static_cast<double>(width - 1),
            (static_cast<double>(y) + shareY) / static_cast<double>(height - 1)};
}

}  // namespace abrdf
