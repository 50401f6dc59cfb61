// SPDX-License-Identifier: BSD-3-Clause
#include "color/color_config.h"
#include "color/delta_e.h"
#include "color/known_space.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

namespace abrdf {

namespace {

constexpr std::array kLinearSpaces{KnownSpace::kLinearRec709,  KnownSpace::kLinearP3D65,
                                   KnownSpace::kLinearRec2020, KnownSpace::kAcesCg,
                                   KnownSpace::kAces2065,      KnownSpace::kCieXyzD65};

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

Vector operator*(const Matrix& m, const Vector& v) {
    Vector result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) result[i] += m[i][j] * v[j];
    }
    return result;
}

Matrix operator*(const Matrix& a, const Matrix& b) {
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) result[i][j] += a[i][k] * b[k][j];
        }
    }
    return result;
}

// By cofactors: (M^-1)_ji = C_ij / det M.
Matrix inverse(const Matrix& m) {
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
            const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            result[j][i] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
        }
    }
    const double det = m[0][0] * result[0][0] + m[0][1] * result[1][0] + m[0][2] * result[2][0];
    for (Vector& row : result) {
        for (double& x : row) x /= det;
    }
    return result;
}

Matrix diagonal(const Vector& d) {
    return {{{d[0], 0, 0}, {0, d[1], 0}, {0, 0, d[2]}}};
}

// The decimal number that a float was written as: 0.3127F means 0.3127.
double decimal(float value) {
    return std::round(static_cast<double>(value) * 1e6) / 1e6;
}

Vector xyzFromXy(const std::array<float, 2>& xy) {
    const double x = decimal(xy[0]);
    const double y = decimal(xy[1]);
    return {x, y, 1 - x - y};
}

// SMPTE RP 177: primaries scaled so that (1, 1, 1) is the white; then Bradford to D65.
Matrix xyzD65FromRgb(const Primaries& p) {
    const auto whiteOf = [](const std::array<float, 2>& xy) {
        const Vector v = xyzFromXy(xy);
        return Vector{v[0] / v[1], 1, v[2] / v[1]};
    };
    const Vector r = xyzFromXy(p.red), g = xyzFromXy(p.green), b = xyzFromXy(p.blue);
    const Matrix columns = {{{r[0], g[0], b[0]}, {r[1], g[1], b[1]}, {r[2], g[2], b[2]}}};
    const Vector white = whiteOf(p.white);
    const Matrix xyz = columns * diagonal(inverse(columns) * white);

    const Matrix bradford = {
        {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
    const Vector from = bradford * white;
    const Vector to = bradford * whiteOf({0.3127F, 0.3290F});
    const Vector gain = {to[0] / from[0], to[1] / from[1], to[2] / from[2]};
    return inverse(bradford) * (diagonal(gain) * (bradford * xyz));
}

const ColorConfig& shipped() {
    static const ColorConfig config = [] {
        const char* ocio = std::getenv("OCIO");
        const std::string before = ocio ? ocio : "";
        unsetenv("OCIO");
        ColorConfig loaded = ColorConfig::load();
        if (ocio) setenv("OCIO", before.c_str(), 1);
        return loaded;
    }();
    return config;
}

Rgb converted(Rgb color, KnownSpace from, KnownSpace to) {
    shipped().transform(std::string(ocioName(from)), std::string(ocioName(to))).apply({&color, 1});
    return color;
}

double farthest(Rgb a, Rgb b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

Rgb rgb(const Vector& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("the config within the program is the file in the sources, byte for byte") {
        std::ifstream file(ABRDF_SOURCE_DIR "/color/config.ocio", std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        REQUIRE_FALSE(text.empty());
        CHECK(shippedColorConfig() == text);
    }

    TEST_CASE("the working space is Linear Rec.709") {
        CHECK(shipped().spaceName("scene_linear") == ocioName(KnownSpace::kLinearRec709));
    }

    TEST_CASE("every known space is there, under its name and its interop id") {
        for (int i = 0; i <= static_cast<int>(KnownSpace::kSrgbTexture); ++i) {
            const auto space = static_cast<KnownSpace>(i);
            CHECK(shipped().spaceName(std::string(ocioName(space))) == ocioName(space));
            CHECK(shipped().spaceName(std::string(interopId(space))) == ocioName(space));
            CHECK(knownSpace(shipped().aliases(std::string(ocioName(space)))) == space);
        }
        for (const char* other : {"Raw", "ACEScct", "sRGB - Display"}) {
            CHECK_FALSE(knownSpace(shipped().aliases(other)));
        }
    }

    TEST_CASE("sRGB texture is the IEC curve, channel by channel") {
        const ColorTransform transform = shipped().transform("srgb_tx", "lin_rec709");
        CHECK(transform.isPerChannel());
        CHECK(shipped().transform("lin_rec709", "srgb_tx").isPerChannel());
        constexpr double kFloat = std::numeric_limits<float>::epsilon();
        for (int code = 0; code <= 255; ++code) {
            CAPTURE(code);
            const double encoded = code / 255.0;
            const double expected = linearFromSrgb(encoded);
            std::array<Rgb, 1> color = {Rgb{static_cast<float>(encoded), 0, 1}};
            transform.apply(color);
            // OCIO's straight part has the slope of the tangent, 12.9232, for the standard's 12.92.
            const double tolerance = encoded <= 0.04045 ? 2.6e-4 : 6 * kFloat;
            CHECK(std::abs(color[0].r - expected) <= tolerance * expected);
            CHECK(color[0].g == 0);
            CHECK(color[0].b == 1);
        }
    }

    TEST_CASE("the primaries that files state are those by which the config converts") {
        const Matrix toRec709 = inverse(xyzD65FromRgb(primaries(KnownSpace::kLinearRec709)));
        for (const KnownSpace from : kLinearSpaces) {
            CAPTURE(ocioName(from));
            // XYZ is not scaled to its white: (1, 1, 1) stays (1, 1, 1).
            const bool xyz = from == KnownSpace::kCieXyzD65;
            const Matrix toXyz = xyz ? diagonal({1, 1, 1}) : xyzD65FromRgb(primaries(from));
            const Matrix expected = toRec709 * toXyz;
            for (const Vector& v : {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}}) {
                const Rgb got = converted(rgb(v), from, KnownSpace::kLinearRec709);
                CHECK(farthest(got, rgb(expected * v)) <= 1e-6);
            }
        }
    }

    TEST_CASE("ACEScg from Rec.709 has the matrix that ACES publishes") {
        const auto to = KnownSpace::kAcesCg;
        const auto from = KnownSpace::kLinearRec709;
        CHECK(farthest(converted({1, 0, 0}, from, to), {0.613097F, 0.070194F, 0.020616F}) <= 1e-6);
        CHECK(farthest(converted({0, 1, 0}, from, to), {0.339523F, 0.916354F, 0.109570F}) <= 1e-6);
        CHECK(farthest(converted({0, 0, 1}, from, to), {0.047379F, 0.013452F, 0.869815F}) <= 1e-6);
    }

    TEST_CASE("white stays white in every RGB space") {
        for (const KnownSpace from : kLinearSpaces) {
            for (const KnownSpace to : kLinearSpaces) {
                if (from == KnownSpace::kCieXyzD65 || to == KnownSpace::kCieXyzD65) continue;
                CHECK(farthest(converted({1, 1, 1}, from, to), {1, 1, 1}) <= 3e-7);
            }
        }
        const Rgb white = converted({1, 1, 1}, KnownSpace::kLinearRec709, KnownSpace::kCieXyzD65);
        CHECK(farthest(white, {0.3127F / 0.3290F, 1, 0.3583F / 0.3290F}) <= 3e-7);
    }

    TEST_CASE("a colour comes back from every space to every other") {
        for (const KnownSpace from : kLinearSpaces) {
            for (const KnownSpace to : kLinearSpaces) {
                for (const Rgb color : {Rgb{0.1F, 0.7F, 0.3F}, Rgb{12, 0.01F, 3}, Rgb{0, 0, 0}}) {
                    const Rgb back = converted(converted(color, from, to), to, from);
                    const double largest = std::max({color.r, color.g, color.b});
                    CHECK(farthest(back, color) <= 2e-6 * largest);
                }
            }
            const Rgb color = {0.1F, 0.7F, 0.3F};
            const Rgb encoded = converted(color, from, KnownSpace::kSrgbTexture);
            CHECK(farthest(converted(encoded, KnownSpace::kSrgbTexture, from), color) <= 2e-6);
        }
    }
}

}  // namespace abrdf
