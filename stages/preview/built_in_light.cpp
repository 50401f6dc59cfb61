// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/built_in_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

constexpr int kWidth = 512;
constexpr int kHeight = 256;

template <typename Radiance>
EnvironmentMap mapOf(const Radiance& radiance) {
    EnvironmentMap map{kWidth, kHeight, {}};
    map.radiance.reserve(std::size_t{kWidth} * kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            map.radiance.push_back(radiance(directionInMap(map, x + 0.5, y + 0.5)));
        }
    }
    return map;
}

double smooth(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// A rectangular lamp, upright, that faces the object.
struct Softbox {
    double azimuth;  // Degrees, as is elevation.
    double elevation;
    double halfWidth;  // Tangents of half angles, as is halfHeight.
    double halfHeight;
    double radiance;

    double towards(const Imath::V3d& d) const {
        const Radians a = radiansFromDegrees(azimuth);
        const Imath::V3d centre = vectorFromAzimuthElevation(a, radiansFromDegrees(elevation));
        const double forward = d ^ centre;
        if (forward <= 0) return 0;
        const Imath::V3d right(std::cos(a), 0, -std::sin(a));
        const double x = std::abs((d ^ right) / forward);
        const double y = std::abs((d ^ right.cross(centre)) / forward);
        // Brighter in the middle, as a lamp behind cloth is.
        const double falloff = 1 - 0.35 * std::min(1.0, std::hypot(x / halfWidth, y / halfHeight));
        return radiance * falloff * (1 - smooth(halfWidth - 0.04, halfWidth + 0.04, x)) *
               (1 - smooth(halfHeight - 0.04, halfHeight + 0.04, y));
    }
};

constexpr std::array kStudio{
    Softbox{-48, 38, 0.46, 0.52, 14},  // key
    Softbox{62, 12, 0.42, 0.75, 2.2},  // fill
    Softbox{152, 28, 0.20, 0.85, 11},  // rim, right
    Softbox{-142, 18, 0.14, 0.80, 6},  // rim, left
    Softbox{10, 82, 0.50, 0.30, 3},    // ceiling
};

/// Perez' distribution: five coefficients, each linear in turbidity.
struct Perez {
    std::array<double, 5> c;

    double at(double cosTheta, double gamma) const {
        const double cosGamma = std::cos(gamma);
        return (1 + c[0] * std::exp(c[1] / std::max(cosTheta, 0.02))) *
               (1 + c[2] * std::exp(c[3] * gamma) + c[4] * cosGamma * cosGamma);
    }
};

constexpr double kTurbidity = 3;

double cubic(double t, double a, double b, double c, double d) {
    return ((a * t + b) * t + c) * t + d;
}

/// Linear Rec.709 of CIE xyY.
Rgb rec709FromXyY(double x, double y, double luminance) {
    const double X = x / y * luminance;
    const double Z = (1 - x - y) / y * luminance;
    const auto positive = [](double v) { return static_cast<float>(std::max(v, 0.0)); };
    return {positive(3.2404542 * X - 1.5371385 * luminance - 0.4985314 * Z),
            positive(-0.9692660 * X + 1.8760108 * luminance + 0.0415560 * Z),
            positive(0.0556434 * X - 0.2040259 * luminance + 1.0572252 * Z)};
}

/// The sky alone: colour at a direction above the horizon.
class Preetham {
  public:
    explicit Preetham(const Imath::V3d& sun) : sun_(sun) {
        const double s = std::acos(std::clamp(sun.y, 0.0, 1.0));
        const double chi = (4.0 / 9 - t / 120) * (kPi - 2 * s);
        zenith_ = {t * t * cubic(s, 0.00166, -0.00375, 0.00209, 0) +
                       t * cubic(s, -0.02903, 0.06377, -0.03202, 0.00394) +
                       cubic(s, 0.11693, -0.21196, 0.06052, 0.25886),
                   t * t * cubic(s, 0.00275, -0.00610, 0.00317, 0) +
                       t * cubic(s, -0.04214, 0.08970, -0.04153, 0.00516) +
                       cubic(s, 0.15346, -0.26756, 0.06670, 0.26688),
                   (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192};
        for (std::size_t i = 0; i < 3; ++i) zenith_[i] /= kPerez[i].at(1, s);
    }

    Rgb at(const Imath::V3d& d) const {
        const double gamma = std::acos(std::clamp(d ^ sun_, -1.0, 1.0));
        std::array<double, 3> xyY{};
        for (std::size_t i = 0; i < 3; ++i) xyY[i] = zenith_[i] * kPerez[i].at(d.y, gamma);
        return rec709FromXyY(xyY[0], xyY[1], xyY[2]);
    }

  private:
    static constexpr double t = kTurbidity;
    // x, y and luminance.
    static constexpr std::array<Perez, 3> kPerez{
        {{{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
           -0.0033 * t + 0.0452}},
         {{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
           -0.0109 * t + 0.0529}},
         {{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
           -0.0670 * t + 0.3703}}}};

    Imath::V3d sun_;
    std::array<double, 3> zenith_{};
};

}  // namespace

EnvironmentMap studioEnvironment() {
    return mapOf([](const Imath::V3d& d) {
        double radiance = d.y > 0 ? 0.16 + 0.5 * d.y * d.y : 0.16 + 0.10 * d.y;
        for (const Softbox& box : kStudio) radiance += box.towards(d);
        const auto grey = static_cast<float>(radiance);
        return Rgb{grey, grey, grey};
    });
}

Imath::V3d skySunDirection() {
    return vectorFromAzimuthElevation(radiansFromDegrees(-42), radiansFromDegrees(40));
}

EnvironmentMap skyEnvironment(const Imath::V3d& sun) {
    const Preetham sky(sun);
    return mapOf([&](const Imath::V3d& d) {
        if (d.y >= 0) return sky.at(d);
        // The ground sends back a fifth of what it gets, more or less that of the whole sky.
        return 0.2F * (sky.at({0, 1, 0}) + 0.35F * sky.at({-sun.x, 0.1, -sun.z}));
    });
}

Light skySun(const EnvironmentMap& sky) {
    // On a clear day at this height the sun lights the ground some four times as much as its sky,
    // and the air has taken a part of its blue.
    const Imath::V3d direction = skySunDirection();
    const Rgb ground = whiteShows(lightsOf(sky, 256), {0, 1, 0});
    const double level = 4 * static_cast<double>(ground.g) / direction.y;
    const auto tinted = [&](double tint) { return static_cast<float>(level * tint); };
    return {direction, {tinted(1.06), tinted(1.0), tinted(0.86)}, 0.0047};
}

}  // namespace abrdf
