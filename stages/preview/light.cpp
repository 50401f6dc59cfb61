// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace abrdf {

namespace {

constexpr int kMostColumns = 1024;  // Finer maps are boxed down to this first.

double luminance(double r, double g, double b) {
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

/// Sums over a rectangle of pixels: red, green, blue, and luminance times direction; all times
/// solid angle.
using Sums = std::array<double, 6>;

Sums operator+(Sums a, const Sums& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    return a;
}
Sums operator-(Sums a, const Sums& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
    return a;
}

double usable(float radiance) {
    return std::isfinite(radiance) && radiance > 0 ? static_cast<double>(radiance) : 0;
}

EnvironmentMap boxedDown(const EnvironmentMap& map) {
    const int factor = (map.width + kMostColumns - 1) / kMostColumns;
    if (factor <= 1) return map;
    EnvironmentMap small{map.width / factor, std::max(1, map.height / factor), {}};
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            // The last box takes what the division leaves over.
            const int right = x + 1 == small.width ? map.width : (x + 1) * factor;
            const int bottom = y + 1 == small.height ? map.height : (y + 1) * factor;
            std::array<double, 3> sum{};
            for (int row = y * factor; row < bottom; ++row) {
                for (int column = x * factor; column < right; ++column) {
                    const Rgb& c = map.radiance[map.index(column, row)];
                    sum[0] += usable(c.r);
                    sum[1] += usable(c.g);
                    sum[2] += usable(c.b);
                }
            }
            const double area = (right - x * factor) * (bottom - y * factor);
            small.radiance.push_back({static_cast<float>(sum[0] / area),
                                      static_cast<float>(sum[1] / area),
                                      static_cast<float>(sum[2] / area)});
        }
    }
    return small;
}

/// Sums over any rectangle in four look-ups.
class SummedMap {
  public:
    explicit SummedMap(const EnvironmentMap& map)
        : columns_(static_cast<std::size_t>(map.width) + 1) {
        sums_.resize(columns_ * (static_cast<std::size_t>(map.height) + 1));
        for (int y = 0; y < map.height; ++y) {
            // Exact for the band of a row: 2 pi / width times the difference of sines.
            const double solidAngle =
                2 * kPi / map.width *
                (std::cos(kPi * y / map.height) - std::cos(kPi * (y + 1) / map.height));
            Sums row{};
            for (int x = 0; x < map.width; ++x) {
                const Rgb& c = map.radiance[map.index(x, y)];
                const double r = usable(c.r) * solidAngle;
                const double g = usable(c.g) * solidAngle;
                const double b = usable(c.b) * solidAngle;
                const Imath::V3d d = directionInMap(map, x + 0.5, y + 0.5) * luminance(r, g, b);
                row = row + Sums{r, g, b, d.x, d.y, d.z};
                at(x + 1, y + 1) = at(x + 1, y) + row;
            }
        }
    }

    Sums over(int left, int top, int right, int bottom) const {
        return at(right, bottom) - at(left, bottom) - at(right, top) + at(left, top);
    }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x);
    }
    Sums& at(int x, int y) { return sums_[index(x, y)]; }
    const Sums& at(int x, int y) const { return sums_[index(x, y)]; }

    std::size_t columns_;
    std::vector<Sums> sums_;
};

struct Cell {
    int left, top, right, bottom;
    Sums sums{};
    double wide = 0;  // Angular, in radians, as is high.
    double high = 0;
    double urgency = 0;

    bool operator<(const Cell& other) const {
        if (urgency != other.urgency) return urgency < other.urgency;
        return top != other.top ? top > other.top : left > other.left;
    }
};

Cell cellOf(const SummedMap& summed, const EnvironmentMap& map, int left, int top, int right,
            int bottom) {
    Cell cell{left, top, right, bottom};
    cell.sums = summed.over(left, top, right, bottom);
    const double middle = kPi * (top + bottom) / (2 * map.height);
    cell.wide = 2 * kPi * (right - left) / map.width * std::sin(middle);
    cell.high = kPi * (bottom - top) / map.height;
    const double extent = std::max(cell.wide, cell.high);
    const bool divisible = right - left > 1 || bottom - top > 1;
    cell.urgency =
        divisible ? luminance(cell.sums[0], cell.sums[1], cell.sums[2]) * extent * extent : 0;
    return cell;
}

Light lightFrom(const Cell& cell, const EnvironmentMap& map) {
    const Imath::V3d centroid(cell.sums[3], cell.sums[4], cell.sums[5]);
    Light light;
    light.direction = centroid.length() > 0 ? centroid.normalized()
                                            : directionInMap(map, (cell.left + cell.right) / 2.0,
                                                             (cell.top + cell.bottom) / 2.0);
    light.strength = {static_cast<float>(cell.sums[0] / kPi),
                      static_cast<float>(cell.sums[1] / kPi),
                      static_cast<float>(cell.sums[2] / kPi)};
    light.softness = std::clamp(std::max(cell.wide, cell.high) / 2, 0.01, 0.5);
    return light;
}

}  // namespace

Imath::V3d directionInMap(const EnvironmentMap& map, double x, double y) {
    return vectorFromAzimuthElevation(kPi - 2 * kPi * (x / map.width - 0.5),
                                      kPi / 2 - kPi * y / map.height);
}

std::vector<Light> lightsOf(const EnvironmentMap& whole, int count) {
    const EnvironmentMap map = boxedDown(whole);
    const SummedMap summed(map);
    std::priority_queue<Cell> cells;
    cells.push(cellOf(summed, map, 0, 0, map.width, map.height));
    while (static_cast<int>(cells.size()) < count && cells.top().urgency > 0) {
        const Cell cell = cells.top();
        cells.pop();
        const bool sideways =
            cell.right - cell.left > 1 && (cell.wide >= cell.high || cell.bottom - cell.top == 1);
        if (sideways) {
            const int middle = (cell.left + cell.right) / 2;
            cells.push(cellOf(summed, map, cell.left, cell.top, middle, cell.bottom));
            cells.push(cellOf(summed, map, middle, cell.top, cell.right, cell.bottom));
        } else {
            const int middle = (cell.top + cell.bottom) / 2;
            cells.push(cellOf(summed, map, cell.left, cell.top, cell.right, middle));
            cells.push(cellOf(summed, map, cell.left, middle, cell.right, cell.bottom));
        }
    }
    std::vector<Light> lights;
    for (; !cells.empty(); cells.pop()) {
        const Sums& sums = cells.top().sums;
        if (luminance(sums[0], sums[1], sums[2]) > 0) {
            lights.push_back(lightFrom(cells.top(), map));
        }
    }
    return lights;
}

std::vector<Light> turned(std::vector<Light> lights, Radians azimuth) {
    const double c = std::cos(azimuth);
    const double s = std::sin(azimuth);
    for (Light& light : lights) {
        const Imath::V3d d = light.direction;
        light.direction = {c * d.x + s * d.z, d.y, c * d.z - s * d.x};
    }
    return lights;
}

Rgb whiteShows(const std::vector<Light>& lights, const Imath::V3d& normal) {
    Rgb sum;
    for (const Light& light : lights) {
        const double cosine = light.direction ^ normal;
        if (cosine > 0) sum += static_cast<float>(cosine) * light.strength;
    }
    return sum;
}

void normalize(const std::vector<std::vector<Light>*>& lights) {
    double brightest = 0;
    for (int elevation = -90; elevation <= 90; elevation += 10) {
        for (int azimuth = 0; azimuth < 360; azimuth += 10) {
            const Imath::V3d normal = vectorFromAzimuthElevation(radiansFromDegrees(azimuth),
                                                                 radiansFromDegrees(elevation));
            double shown = 0;
            for (const auto* list : lights) {
                const Rgb c = whiteShows(*list, normal);
                shown += luminance(static_cast<double>(c.r), static_cast<double>(c.g),
                                   static_cast<double>(c.b));
            }
            brightest = std::max(brightest, shown);
        }
    }
    if (!(brightest > 0)) return;
    for (auto* list : lights) {
        for (Light& light : *list) light.strength *= static_cast<float>(1 / brightest);
    }
}

}  // namespace abrdf
