// SPDX-License-Identifier: BSD-3-Clause
//
// A cloth over a small dome as a height field y = h(x, z): cheap to meet, to shade and to shadow.
#include "stages/preview/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace abrdf {

namespace {

constexpr double kHalfSide = 0.7;  // The cloth covers |x|, |z| below this.
constexpr double kDrop = 0.2;      // The ground lies this far below the origin.
constexpr int kHeights = 385;      // Samples a side.
constexpr int kNodes = 129;        // Of frames and horizons, a side.
constexpr int kAzimuths = 48;      // Of a horizon.

double smooth(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// The dome, and folds that open towards the ground, where they run out.
double shapedHeight(double x, double z) {
    const double r = std::hypot(x, z);
    const double phi = std::atan2(z, x);
    const double dome = 0.66 * std::exp(-std::pow(r / 0.37, 2.6));
    const double opening = smooth(0.05, 0.42, r) * (1 - 0.8 * smooth(0.42, 0.72, r));
    const double turn = phi + 0.3 * std::sin(2 * phi + 0.6) + 0.6 * r;
    const double folds = std::sin(6 * turn) + 0.4 * std::sin(9 * phi - 1.3 + r) +
                         0.15 * std::sin(15 * phi + 2 + 3 * r);
    const double ripples = 0.006 * std::sin(5 * x + 3 * z) * std::sin(4 * z - 2 * x + 1);
    return dome + 0.085 * opening * (folds + 1.55) + ripples - kDrop;
}

class Drape : public Surface {
  public:
    Drape() : heights_(static_cast<std::size_t>(kHeights) * kHeights) {
        for (int row = 0; row < kHeights; ++row) {
            for (int column = 0; column < kHeights; ++column) {
                heights_[index(column, row)] =
                    shapedHeight(kHalfSide * (2.0 * column / (kHeights - 1) - 1),
                                 kHalfSide * (2.0 * row / (kHeights - 1) - 1));
            }
        }
        const auto [least, greatest] = std::ranges::minmax_element(heights_);
        least_ = *least;
        greatest_ = *greatest;
        findHorizons();
    }

    std::optional<SurfacePoint> hit(const Ray& ray) const override {
        double begin = 0;
        double end = 0;
        if (!throughBox(ray, begin, end)) return std::nullopt;
        constexpr double kStep = 0.012;
        const auto above = [&](double t) {
            const Imath::V3d p = ray.origin + ray.direction * t;
            return p.y - heightAt(p.x, p.z);
        };
        double last = begin;
        if (above(begin) < 0) return std::nullopt;  // From below: the cloth has one side.
        for (double t = begin + kStep; t < end + kStep; t += kStep) {
            if (above(std::min(t, end)) < 0) return pointBetween(ray, last, std::min(t, end));
            last = t;
        }
        return std::nullopt;
    }

    Frame frameAt(double u, double v) const override {
        const double x = kHalfSide * (2 * u - 1);
        const double z = kHalfSide * (2 * v - 1);
        constexpr double kReach = 2 * kHalfSide / (kHeights - 1);
        const double dx = (heightAt(x + kReach, z) - heightAt(x - kReach, z)) / (2 * kReach);
        const double dz = (heightAt(x, z + kReach) - heightAt(x, z - kReach)) / (2 * kReach);
        const Imath::V3d normal = Imath::V3d(-dx, 1, -dz).normalized();
        const Imath::V3d along = Imath::V3d(1, dx, 0).normalized();
        return {along, normal.cross(along), normal};
    }

    double lightReaching(const SurfacePoint& point, const Imath::V3d& direction,
                         double softness) const override {
        // The narrowest gap between ray and cloth, in units of the distance travelled.
        constexpr double kStep = 0.01;
        double gap = 1;
        const Imath::V3d from = point.position + point.frame.normal * 0.004;
        for (double t = kStep; t < 2.5; t += kStep) {
            const Imath::V3d p = from + direction * t;
            if (p.y > greatest_ || std::abs(p.x) > kHalfSide || std::abs(p.z) > kHalfSide) break;
            gap = std::min(gap, (p.y - heightAt(p.x, p.z)) / (t * softness));
            if (gap <= -1) return 0;
        }
        return smooth(-1, 1, gap);
    }

    double skyReaching(double u, double v, const Imath::V3d& direction) const override {
        const auto column = static_cast<std::size_t>(std::lround(u * (kNodes - 1)));
        const auto row = static_cast<std::size_t>(std::lround(v * (kNodes - 1)));
        const double azimuth = wrappedAzimuth(std::atan2(direction.z, direction.x));
        const double place = azimuth / (2 * kPi) * kAzimuths;
        const auto k = static_cast<std::size_t>(place) % kAzimuths;
        const double t = place - std::floor(place);
        const auto& horizon = horizons_[row * kNodes + column];
        const double sine = (1 - t) * horizon[k] + t * horizon[(k + 1) % kAzimuths];
        return smooth(sine - 0.05, sine + 0.05, direction.y);
    }

    int nodesWide() const override { return kNodes; }
    int nodesHigh() const override { return kNodes; }

  private:
    static std::size_t index(int column, int row) {
        return static_cast<std::size_t>(row) * kHeights + static_cast<std::size_t>(column);
    }

    double heightAt(double x, double z) const {
        const auto place = [](double c) {
            return std::clamp((c / kHalfSide + 1) / 2, 0.0, 1.0) * (kHeights - 1);
        };
        const double px = place(x);
        const double pz = place(z);
        const int column = std::min(static_cast<int>(px), kHeights - 2);
        const int row = std::min(static_cast<int>(pz), kHeights - 2);
        const double tx = px - column;
        const double tz = pz - row;
        const double* a = &heights_[index(column, row)];
        const double* b = a + kHeights;
        return (1 - tz) * ((1 - tx) * a[0] + tx * a[1]) + tz * ((1 - tx) * b[0] + tx * b[1]);
    }

    bool throughBox(const Ray& ray, double& begin, double& end) const {
        begin = 0;
        end = 1e9;
        const std::array<std::array<double, 2>, 3> bounds{
            {{-kHalfSide, kHalfSide}, {least_ - 0.01, greatest_ + 0.01}, {-kHalfSide, kHalfSide}}};
        for (int axis = 0; axis < 3; ++axis) {
            const auto& [low, high] = bounds[static_cast<std::size_t>(axis)];
            const double inverse = 1 / ray.direction[axis];
            const double a = (low - ray.origin[axis]) * inverse;
            const double b = (high - ray.origin[axis]) * inverse;
            begin = std::max(begin, std::min(a, b));
            end = std::min(end, std::max(a, b));
        }
        return begin < end;
    }

    SurfacePoint pointBetween(const Ray& ray, double above, double below) const {
        for (int i = 0; i < 24; ++i) {
            const double middle = (above + below) / 2;
            const Imath::V3d p = ray.origin + ray.direction * middle;
            (p.y > heightAt(p.x, p.z) ? above : below) = middle;
        }
        SurfacePoint point;
        point.distance = below;
        point.position = ray.origin + ray.direction * below;
        point.u = std::clamp((point.position.x / kHalfSide + 1) / 2, 0.0, 1.0);
        point.v = std::clamp((point.position.z / kHalfSide + 1) / 2, 0.0, 1.0);
        point.frame = frameAt(point.u, point.v);
        return point;
    }

    /// Sine of the elevation below which the cloth hides the sky, from each node all around.
    void findHorizons() {
        horizons_.resize(static_cast<std::size_t>(kNodes) * kNodes);
        for (std::size_t node = 0; node < horizons_.size(); ++node) {
            const std::size_t column = node % kNodes;
            const std::size_t row = node / kNodes;
            const double x = kHalfSide * (2.0 * static_cast<double>(column) / (kNodes - 1) - 1);
            const double z = kHalfSide * (2.0 * static_cast<double>(row) / (kNodes - 1) - 1);
            const double y = heightAt(x, z);
            for (int k = 0; k < kAzimuths; ++k) {
                const double azimuth = 2 * kPi * k / kAzimuths;
                double tangent = -10;
                for (double t = 0.03; t < 1.4; t *= 1.12) {
                    const double px = x + t * std::cos(azimuth);
                    const double pz = z + t * std::sin(azimuth);
                    if (std::abs(px) > kHalfSide || std::abs(pz) > kHalfSide) break;
                    tangent = std::max(tangent, (heightAt(px, pz) - y) / t);
                }
                horizons_[node][static_cast<std::size_t>(k)] =
                    tangent / std::sqrt(1 + tangent * tangent);
            }
        }
    }

    std::vector<double> heights_;
    std::vector<std::array<double, kAzimuths>> horizons_;
    double least_ = 0;
    double greatest_ = 0;
};

}  // namespace

std::unique_ptr<Surface> makeDrape() {
    return std::make_unique<Drape>();
}

}  // namespace abrdf
