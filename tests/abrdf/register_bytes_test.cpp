// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/register_bytes.h"

#include "abrdf/display_difference.h"
#include "abrdf/logarithms.h"
#include "abrdf/portable_vector.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

using namespace abrdf;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Light of all sizes, some of it unreal.
std::vector<Rgb> randomColors(std::size_t count) {
    std::mt19937 random(17);
    std::lognormal_distribution<float> light(-2, 3);
    std::vector<Rgb> colors(count);
    for (Rgb& c : colors) c = {light(random), light(random), light(random)};
    const std::vector<Rgb> odd = {{0, 0, 0},          {1, 1, 1},
                                  {kNaN, 0.5F, 0.2F}, {0.1F, kInfinity, 0},
                                  {-1, -0.0F, 2},     {1e-40F, 6e-8F, 65505}};
    for (std::size_t i = 0; i < odd.size() && i < count; ++i) colors[count - 1 - i] = odd[i];
    return colors;
}

template <typename T>
bool haveSameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// Largest error in units of the last place of exp() of a register of one value, against double.
template <std::size_t kBytes>
double worstExp() {
    using V = portable::Vector<kBytes>;
    double worst = 0;
    for (float x = -86.9F; x < 88; x += 0.0037F) {
        std::vector<float> values(V::kCount, x);
        exp(V::at(values.data())).store(values.data());
        const double truth = std::exp(static_cast<double>(x));
        const auto nearest = static_cast<float>(truth);
        const double ulp =
            static_cast<double>(std::nextafter(nearest, kInfinity)) - static_cast<double>(nearest);
        worst = std::max(worst, std::abs(static_cast<double>(values.back()) - truth) / ulp);
        if (values.back() != portable::exp(x)) return kInfinity;
    }
    return worst;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("registers can be bounded, and are the processor's again afterwards") {
    const int widest = registerBytes();
    CHECK((widest == 16 || widest == 32 || widest == 64));
    {
        const RegisterLimit limit(16);
        CHECK(registerBytes() == 16);
    }
    CHECK(registerBytes() == widest);
}

TEST_CASE(
    "an exponential in registers is within 2 units of the last place, with the scalar's bits") {
    CHECK(worstExp<16>() < 2);
}

TEST_CASE("logarithms and L*a*b* of all registers have the bits of one number at a time") {
    for (const int bytes : {16, 32, 64}) {
        const RegisterLimit limit(bytes);
        for (const std::size_t count : {1U, 3U, 15U, 16U, 127U, 300U}) {
            const std::vector<Rgb> colors = randomColors(count);
            std::vector<float> logs;
            std::vector<float> slowLogs;
            std::vector<DisplayLab> labs(count);
            std::vector<DisplayLab> slowLabs;
            for (std::size_t i = 0; i < count; ++i) {
                logs.push_back(colors[i].r > 1e-30F ? colors[i].r : 1.0F);
                slowLogs.push_back(portable::log(logs.back()));
                slowLabs.push_back(displayLab(0.7F * colors[i]));
            }
            takeLogarithms(logs);
            displayLabs(colors.data(), count, 0.7F, labs.data());
            CHECK(haveSameBits(logs, slowLogs));
            CHECK(haveSameBits(labs, slowLabs));
        }
    }
}

TEST_SUITE_END();
