// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/reciprocity.h"

#include "abrdf/utia_encoding.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace abrdf;

namespace {

template <typename Value>
std::vector<Rgb> valuesOn(const AngularGrid& grid, const Value& value) {
    std::vector<Rgb> values;
    for (const LightAndView& p : pairsOf(grid)) {
        const auto v = static_cast<float>(value(p));
        values.push_back({v, v, v});
    }
    return values;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a reciprocal BRDF times the cosine is found out, and so is one without it") {
    const AngularGrid grid(ubo81Directions());
    const auto f = [](const LightAndView& p) {
        return 1 + 0.5 * std::cos(p.light.phi - p.view.phi);
    };
    const auto kept = reciprocityOf(
        grid, valuesOn(grid, [&](const LightAndView& p) { return f(p) * std::cos(p.light.theta); }),
        Cosine::kKept);
    CHECK(kept.pairs == 3240);
    CHECK(kept.rmsDivided < 1e-6);
    CHECK(kept.rmsAsStored > 0.3);
    CHECK(kept.largest < 1e-5);
    CHECK(cosineFromReciprocity(kept, Cosine::kAbsent) == Cosine::kKept);
    const auto absent = reciprocityOf(grid, valuesOn(grid, f), Cosine::kKept);
    CHECK(cosineFromReciprocity(absent, Cosine::kKept) == Cosine::kAbsent);
    // 75 degrees against the normal: 2 (1 - cos) / (1 + cos) of the two orders.
    const double c = std::cos(radiansFromDegrees(75));
    CHECK(absent.largest == doctest::Approx(2 * (1 - c) / (1 + c)));
}

TEST_CASE("pairs that cannot be compared are left out") {
    const AngularGrid other(ubo81Directions(), {{0.2, 0.1}});
    CHECK(reciprocityOf(other, std::vector<Rgb>(81, Rgb{1, 1, 1}), Cosine::kKept).pairs == 0);
    const AngularGrid grid(regularDirections(2, 2));
    std::vector<Rgb> values(16, Rgb{1, 1, 1});
    values[1].g = std::numeric_limits<float>::quiet_NaN();
    values[2] = {};
    CHECK(reciprocityOf(grid, values, Cosine::kAbsent).pairs == 4);
    CHECK(cosineFromReciprocity(reciprocityOf(grid, values, Cosine::kAbsent), Cosine::kDivided) ==
          Cosine::kDivided);
}

TEST_CASE("UTIA's encodings are inverses, exact where linear, for values below 0 and above 1 too") {
    for (const auto encoding :
         {UtiaEncoding::kLinear, UtiaEncoding::kSrgb, UtiaEncoding::kSrgb140}) {
        CHECK(utiaEncodingFromName(nameOf(encoding)) == encoding);
        for (const double v : {-2.0, -0.001, 0.0, 0.002, 0.18, 1.0, 30.0}) {
            CHECK(linearFromUtia(utiaFromLinear(v, encoding), encoding) == doctest::Approx(v));
        }
    }
    CHECK(linearFromUtia(0.1 + 0.2, UtiaEncoding::kLinear) == 0.1 + 0.2);
    CHECK(linearFromUtia(70, UtiaEncoding::kSrgb140) == doctest::Approx(0.2140411));
    CHECK_THROWS_AS(utiaEncodingFromName("gamma"), std::invalid_argument);
}

TEST_SUITE_END();
