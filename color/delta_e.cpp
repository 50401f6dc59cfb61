// SPDX-License-Identifier: BSD-3-Clause
#include "color/delta_e.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abrdf {

namespace {

constexpr double kPi = std::numbers::pi;

double radians(double degrees) {
    return degrees * kPi / 180;
}

double clipped(float linear) {
    return std::clamp(static_cast<double>(linear), 0.0, 1.0);
}

// IEC 61966-2-1, with its four digits.
constexpr Xyz xyzFromLinearRec709(double r, double g, double b) {
    return {0.4124 * r + 0.3576 * g + 0.1805 * b,  //
            0.2126 * r + 0.7152 * g + 0.0722 * b,  //
            0.0193 * r + 0.1192 * g + 0.9505 * b};
}

// D65 as the matrix has it, so that greys have no chroma at all.
constexpr Xyz kWhite = xyzFromLinearRec709(1, 1, 1);

// CIE 15: the cube root, and its tangent below (6/29)^3.
double lightnessCurve(double t) {
    constexpr double kDelta = 6.0 / 29.0;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
}

double square(double x) {
    return x * x;
}

// sqrt(C^7 / (C^7 + 25^7)), which tells chromatic colours from greyish ones.
double chromaSaturation(double chroma) {
    const double c7 = std::pow(chroma, 7);
    return std::sqrt(c7 / (c7 + std::pow(25.0, 7)));
}

// Lightness, chroma and hue in degrees within [0, 360), hue 0 where there is no chroma.
struct Lch {
    double lightness, chroma, hue;
};

Lch lchFromLab(const Lab& color, double stretch) {
    const double a = color.a * stretch;
    const double degrees = std::atan2(color.b, a) * 180 / kPi;
    return {color.L, std::hypot(a, color.b), degrees < 0 ? degrees + 360 : degrees};
}

// Sharma et al., eq. 10: the short way round from one hue to the other.
double hueDifference(const Lch& p, const Lch& q) {
    if (p.chroma == 0 || q.chroma == 0) return 0;
    const double difference = q.hue - p.hue;
    if (difference > 180) return difference - 360;
    return difference < -180 ? difference + 360 : difference;
}

// Sharma et al., eq. 14: the middle of the shorter arc.
double meanHue(const Lch& p, const Lch& q) {
    const double sum = p.hue + q.hue;
    if (p.chroma == 0 || q.chroma == 0) return sum;
    if (std::abs(p.hue - q.hue) <= 180) return sum / 2;
    return sum < 360 ? (sum + 360) / 2 : (sum - 360) / 2;
}

}  // namespace

double srgbEncoded(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

double linearFromSrgb(double encoded) {
    const double c = std::clamp(encoded, 0.0, 1.0);
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double lightness(double luminance) {
    return 116 * lightnessCurve(std::clamp(luminance, 0.0, 1.0)) - 16;
}

Xyz xyzOfDisplayed(Rgb color) {
    return xyzFromLinearRec709(clipped(color.r), clipped(color.g), clipped(color.b));
}

Lab labFromXyz(const Xyz& color) {
    const double x = lightnessCurve(color.x / kWhite.x);
    const double y = lightnessCurve(color.y / kWhite.y);
    const double z = lightnessCurve(color.z / kWhite.z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Lab labFromLinearRec709(Rgb color) {
    return labFromXyz(xyzOfDisplayed(color));
}

double deltaE76(const Lab& a, const Lab& b) {
    return std::sqrt(square(a.L - b.L) + square(a.a - b.a) + square(a.b - b.b));
}

double deltaE2000(const Lab& a, const Lab& b) {
    // Eqs. 2 to 7: stretch a* so that greys become rounder.
    const double chroma = (std::hypot(a.a, a.b) + std::hypot(b.a, b.b)) / 2;
    const double stretch = 1 + 0.5 * (1 - chromaSaturation(chroma));
    const Lch p = lchFromLab(a, stretch);
    const Lch q = lchFromLab(b, stretch);

    // Eqs. 8 to 11: differences.
    const double dL = q.lightness - p.lightness;
    const double dC = q.chroma - p.chroma;
    const double dH =
        2 * std::sqrt(p.chroma * q.chroma) * std::sin(radians(hueDifference(p, q)) / 2);

    // Eqs. 12 to 21: weights at the mean colour.
    const double meanL = (p.lightness + q.lightness) / 2;
    const double meanC = (p.chroma + q.chroma) / 2;
    const double h = meanHue(p, q);
    const double t = 1 - 0.17 * std::cos(radians(h - 30)) + 0.24 * std::cos(radians(2 * h)) +
                     0.32 * std::cos(radians(3 * h + 6)) - 0.20 * std::cos(radians(4 * h - 63));
    const double sL = 1 + 0.015 * square(meanL - 50) / std::sqrt(20 + square(meanL - 50));
    const double sC = 1 + 0.045 * meanC;
    const double sH = 1 + 0.015 * meanC * t;
    const double turn = 30 * std::exp(-square((h - 275) / 25));
    const double rotation = -std::sin(radians(2 * turn)) * 2 * chromaSaturation(meanC);

    // Eq. 22.
    const double l = dL / sL;
    const double c = dC / sC;
    const double hue = dH / sH;
    return std::sqrt(square(l) + square(c) + square(hue) + rotation * c * hue);
}

}  // namespace abrdf
