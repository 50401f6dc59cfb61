// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/texel_model.h"

#include "abrdf/angular_grid.h"
#include "abrdf/packed_codes.h"
#include "abrdf/random.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

using namespace abrdf;

namespace {

constexpr std::size_t kColumns = 7;
constexpr std::size_t kSmall = 5;

const std::vector<LightAndView>& pairs() {
    static const std::vector<LightAndView> all = pairsOf(gridFromName("regular:3x4"));
    return all;
}

Eigen::MatrixXf randomMatrix(std::size_t rows, std::size_t columns, Random& random) {
    Eigen::MatrixXf m(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    for (float& x : m.reshaped()) x = static_cast<float>(random.uniform(-0.3, 0.3));
    return m;
}

TexelBasis randomBasis(std::size_t columns, Random& random) {
    const std::size_t rows = pairs().size();
    TexelBasis basis;
    basis.luminance = PackedMatrix(randomMatrix(rows, columns, random));
    basis.chroma = PackedMatrix(randomMatrix(rows, columns, random));
    const auto fill = [&](std::vector<float>& center) {
        for (std::size_t i = 0; i < rows; ++i) {
            center.push_back(static_cast<float>(random.uniform(-1, 0)));
        }
    };
    for (auto& center : basis.logCenters) fill(center);
    for (auto& center : basis.chromaCenters) fill(center);
    return basis;
}

TexelModel randomModel(float blend) {
    Random random(5);
    std::vector<std::size_t> rowOf(pairs().size());
    std::iota(rowOf.begin(), rowOf.end(), std::size_t{0});
    TexelModel model(randomBasis(kColumns, random), {2, 1e-5F, blend}, rowOf, pairs());
    model.addSmall(randomBasis(kSmall, random));
    model.addIsotropic(pairs());
    return model;
}

/// Texels of each rank that the model knows.
TexelCodes randomCodes(const TexelRule& rule) {
    Random random(9);
    TexelCodes codes;
    codes.stride = kColumns;
    constexpr std::array<std::uint16_t, 7> kRanks = {7, 0, 2, 5, 7, 3, 2};
    for (const std::uint16_t rank : kRanks) {
        codes.ranks.push_back(rank);
        codes.scales.push_back({0.4F, {0.5F, 0.3F, 0.2F}, {1.1F, 0.9F}});
        const auto add = [&](std::vector<float>& vectors) {
            for (std::size_t k = 0; k < kColumns; ++k) {
                const double x = random.uniform(-1, 1);
                vectors.push_back(k < rank ? static_cast<float>(x) : 0.0F);
            }
        };
        for (std::size_t i = 0; i < rule.logVectors(); ++i) add(codes.logs[i]);
        for (std::size_t c = 0; c < rule.chromaVectors(); ++c) add(codes.chroma[c]);
    }
    return codes;
}

bool haveSameBits(const Rgb& a, const Rgb& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a block of texels of mixed ranks has the bits of single values") {
    for (const float blend : {0.0F, 0.5F, 1.0F}) {
        const TexelModel model = randomModel(blend);
        const TexelCodes codes = randomCodes(model.rule());
        std::vector<Rgb> all(codes.count() * model.pairs());
        model.evaluate(codes, all);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Rgb one = model.at(codes, i / model.pairs(), i % model.pairs());
            wrong += haveSameBits(one, all[i]) ? 0U : 1U;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("a model of some pairs gives their values") {
    const TexelModel model = randomModel(0.5F);
    const TexelCodes codes = randomCodes(model.rule());
    std::vector<Rgb> all(codes.count() * model.pairs());
    model.evaluate(codes, all);
    const std::vector<std::size_t> some = {17, 3, 90, 3};
    std::vector<Rgb> few(codes.count() * some.size());
    model.restricted(some).evaluate(codes, few);
    for (std::size_t t = 0; t < codes.count(); ++t) {
        for (std::size_t i = 0; i < some.size(); ++i) {
            CHECK(haveSameBits(few[t * some.size() + i], all[t * model.pairs() + some[i]]));
        }
    }
}

TEST_CASE("a constant texel obeys Lambert's law, an isotropic one is the same for all twins") {
    const TexelModel model = randomModel(0.5F);
    const TexelCodes codes = randomCodes(model.rule());
    const AngularGrid grid = gridFromName("regular:3x4");
    for (std::size_t pair = 0; pair < model.pairs(); ++pair) {
        const float cosine = static_cast<float>(std::cos(pairs()[pair].light.theta));
        CHECK(model.at(codes, 1, pair).g == doctest::Approx(0.3F * cosine));
    }
    const auto at = [&](double thetaI, double phiI, double thetaV, double phiV) {
        const auto direction = [](double theta, double phi) {
            return Direction{radiansFromDegrees(theta), radiansFromDegrees(phi)};
        };
        return model.at(codes, 2,
                        grid.pairIndex(nearestDirection(grid.lights(), direction(thetaI, phiI)),
                                       nearestDirection(grid.views(), direction(thetaV, phiV))));
    };
    const double theta = degreesFromRadians(grid.maxTheta());
    CHECK(haveSameBits(at(theta, 0, theta, 90), at(theta, 90, theta, 180)));
    CHECK(haveSameBits(at(theta, 0, theta, 90), at(theta, 90, theta, 0)));
    CHECK_FALSE(haveSameBits(at(theta, 0, theta, 90), at(theta, 0, theta, 180)));
}

TEST_CASE("packed codes come back, in any order") {
    const TexelModel model = randomModel(0.5F);
    const TexelCodes codes = randomCodes(model.rule());
    PackedCodes packed(model.rule(), codes.count());
    packed.store(0, codes);
    CHECK(packed.largestRank() == kColumns);
    const std::vector<std::size_t> order = {3, 0, 6};
    const TexelCodes back = packed.unpacked(order);
    for (std::size_t i = 0; i < order.size(); ++i) {
        CHECK(haveSameBits(model.at(back, i, 40), model.at(codes, order[i], 40)));
    }
    CHECK(packed.number(5, 0, 2) == codes.logs[0][5 * kColumns + 2]);
    CHECK(packed.number(5, 0, 3) == 0);
}

TEST_SUITE_END();
