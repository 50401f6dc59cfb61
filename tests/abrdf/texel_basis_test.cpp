// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/texel_basis.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <vector>

using namespace abrdf;

namespace {

/// Three rows of two columns; only luminance and green have centres.
TexelBasis smallBasis() {
    Eigen::MatrixXf luminance(3, 2);
    luminance << 1, 2, 3, 4, 7, 8;
    TexelBasis basis;
    basis.luminance = PackedMatrix(luminance);
    basis.chroma = PackedMatrix(Eigen::MatrixXf(-luminance));
    basis.logCenters[0] = {10, 20, 40};
    basis.chromaCenters[1] = {0.5F, 0.25F, 1};
    return basis;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("rows at some places are these rows, in their order, again where named again") {
    const TexelBasis some = smallBasis().atRows(std::vector<std::size_t>{2, 0, 2, 1});
    REQUIRE(some.rows() == 4);
    CHECK(some.luminance.at(0, 1) == 8);
    CHECK(some.luminance.at(1, 0) == 1);
    CHECK(some.luminance.at(2, 0) == 7);
    CHECK(some.chroma.at(3, 1) == -4);
    CHECK(some.logCenters[0] == std::vector<float>{40, 10, 40, 20});
    CHECK(some.chromaCenters[1] == std::vector<float>{1, 0.5F, 1, 0.25F});
    CHECK(some.logCenters[1].empty());
}

TEST_CASE("the means of groups are of their rows, in the first columns alone") {
    const TexelBasis means = smallBasis().groupMeans(std::vector<std::size_t>{1, 0, 1}, 2, 1);
    REQUIRE(means.rows() == 2);
    CHECK(means.luminance.columns() == 1);
    CHECK(means.luminance.at(0, 0) == 3);
    CHECK(means.luminance.at(1, 0) == 4);
    CHECK(means.chroma.at(1, 0) == -4);
    CHECK(means.logCenters[0] == std::vector<float>{20, 25});
    CHECK(means.chromaCenters[1] == std::vector<float>{0.25F, 0.75F});
    CHECK(means.logCenters[1].empty());
}

TEST_SUITE_END();
