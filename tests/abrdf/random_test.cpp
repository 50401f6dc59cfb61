// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/random.h"

#include "abrdf/portable_math.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

namespace abrdf {

TEST_SUITE("unit") {
    TEST_CASE("a seed always gives the same numbers, on every machine") {
        Random random(1);
        const std::array<std::uint32_t, 3> first = {random.next(), random.next(), random.next()};
        CHECK(first == std::array<std::uint32_t, 3>{937058232U, 2502130041U, 211321544U});
        CHECK(hashOf({1, 2, 3}) == 311187881747258822U);
        Random normals(7);
        CHECK(normals.normal() == -0.88426046989150453);
    }

    TEST_CASE("other seeds and other streams give other numbers") {
        CHECK(Random(1).next() != Random(2).next());
        CHECK(Random(1, 0).next() != Random(1, 1).next());
    }

    TEST_CASE("a hash depends on the order of what it is made of") {
        CHECK(hashOf({1, 2}) != hashOf({2, 1}));
        CHECK(hashOf({0}) != hashOf({0, 0}));
        CHECK(uniformFromHash(hashOf({5})) < 1);
    }

    TEST_CASE("uniform numbers have the moments of the interval they fill") {
        Random random(3);
        constexpr int kCount = 100000;
        double sum = 0;
        double squares = 0;
        for (int i = 0; i < kCount; ++i) {
            const double x = random.uniform(2, 4);
            REQUIRE(x >= 2);
            REQUIRE(x < 4);
            sum += x;
            squares += (x - 3) * (x - 3);
        }
        CHECK(sum / kCount == doctest::Approx(3).epsilon(0.003));
        CHECK(squares / kCount == doctest::Approx(1.0 / 3).epsilon(0.01));
    }

    TEST_CASE("normal numbers have the moments and the tail of the normal distribution") {
        Random random(4);
        constexpr int kCount = 200000;
        double sum = 0;
        double squares = 0;
        double fourth = 0;
        int pastTwo = 0;
        for (int i = 0; i < kCount; ++i) {
            const double x = random.normal();
            sum += x;
            squares += x * x;
            fourth += x * x * x * x;
            pastTwo += std::fabs(x) > 2 ? 1 : 0;
        }
        CHECK(std::fabs(sum / kCount) < 0.01);
        CHECK(squares / kCount == doctest::Approx(1).epsilon(0.01));
        CHECK(fourth / kCount == doctest::Approx(3).epsilon(0.03));
        CHECK(static_cast<double>(pastTwo) / kCount == doctest::Approx(0.0455).epsilon(0.05));
    }

    TEST_CASE("log-uniform numbers fall on both sides of the geometric mean alike") {
        Random random(5);
        int below = 0;
        for (int i = 0; i < 20000; ++i) below += random.logUniform(0.01, 1) < 0.1 ? 1 : 0;
        CHECK(below == doctest::Approx(10000).epsilon(0.03));
    }

    TEST_CASE("below() reaches each number, and none past the last") {
        Random random(6);
        std::array<int, 5> counts{};
        for (int i = 0; i < 5000; ++i) ++counts.at(random.below(5));
        for (const int count : counts) CHECK(count == doctest::Approx(1000).epsilon(0.15));
    }

    TEST_CASE("the portable functions are those of the library, to a few units in the last place") {
        for (int i = -1000; i <= 1000; ++i) {
            const float x = static_cast<float>(i) / 1000;
            CHECK(portable::exp(80 * x) ==
                  doctest::Approx(std::exp(static_cast<double>(80 * x))).epsilon(1e-6));
            CHECK(portable::cos(100 * x) == doctest::Approx(std::cos(100.0F * x)).epsilon(1e-6));
            CHECK(portable::asin(x) == doctest::Approx(std::asin(x)).epsilon(1e-6));
            const float y = std::exp(80 * x);
            CHECK(portable::log(y) == doctest::Approx(std::log(y)).epsilon(1e-6));
        }
        CHECK(portable::exp(0) == 1);
        CHECK(portable::log(1) == 0);
        CHECK(portable::asin(2) == portable::asin(1));
        CHECK(std::isfinite(portable::exp(1000)));
        CHECK(portable::exp(-1000) > 0);
    }
}

}  // namespace abrdf
