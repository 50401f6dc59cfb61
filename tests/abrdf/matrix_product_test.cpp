// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/matrix_product.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/random.h"
#include "abrdf/register_bytes.h"

#include <doctest/doctest.h>

using namespace abrdf;

namespace {

Eigen::MatrixXf randomMatrix(Eigen::Index rows, Eigen::Index columns) {
    Random random(3);
    return Eigen::MatrixXf::NullaryExpr(rows, columns,
                                        [&] { return static_cast<float>(random.uniform(-1, 1)); });
}

/// The slow twin: each sum in the order of the columns.
Eigen::MatrixXf slowProduct(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
    Eigen::MatrixXf c = Eigen::MatrixXf::Zero(a.rows(), b.cols());
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        for (Eigen::Index j = 0; j < b.cols(); ++j) {
            for (Eigen::Index k = 0; k < a.cols(); ++k) c(i, j) += a(i, k) * b(k, j);
        }
    }
    return c;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a product has the bits of its slow twin, for all sizes and registers") {
    for (const int bytes : {16, 32, 64}) {
        const RegisterLimit limit(bytes);
        for (const Eigen::Index rows : {1, 31, 32, 33, 100}) {
            for (const Eigen::Index vectors : {1, 2, 3, 7, 8, 9, 25}) {
                const Eigen::MatrixXf a = randomMatrix(rows, 17);
                const Eigen::MatrixXf b = randomMatrix(17, vectors);
                CHECK(product(a, b) == slowProduct(a, b));
            }
        }
    }
}

TEST_CASE("rows past the last are 0, and panels can be had one at a time") {
    const Eigen::MatrixXf a = randomMatrix(70, 5);
    const Eigen::MatrixXf b = randomMatrix(5, 4);
    const PackedMatrix packed(a);
    CHECK(packed.panels() == 3);
    std::vector<float> result(4 * 32, 9);
    packed.multiply({b.data(), 20}, 2, 1, result.data(), 32);
    for (std::size_t v = 0; v < 4; ++v) {
        CHECK(result[v * 32] == slowProduct(a, b)(64, static_cast<Eigen::Index>(v)));
        CHECK(result[v * 32 + 6] == 0);
        CHECK(result[v * 32 + 31] == 0);
    }
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("threads");

TEST_CASE("a product has the same bits on 1, 2 and 7 threads") {
    const Eigen::MatrixXf a = randomMatrix(1000, 30);
    const Eigen::MatrixXf b = randomMatrix(30, 40);
    const Eigen::MatrixXf expected = slowProduct(a, b);
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        CHECK(product(a, b) == expected);
    }
}

TEST_SUITE_END();
