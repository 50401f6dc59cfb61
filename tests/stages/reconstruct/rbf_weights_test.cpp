// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/rbf_weights.h"

#include "abrdf/random.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

using namespace abrdf;

namespace {

Eigen::MatrixX2d scattered(Random& random, Eigen::Index count) {
    Eigen::MatrixX2d nodes(count, 2);
    for (Eigen::Index i = 0; i < count; ++i) {
        nodes.row(i) << random.uniform(0, 1.5), random.uniform(0, 1.5);
    }
    return nodes;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("any scattered nodes are met exactly, and every plane through them") {
    Random random(3);
    for (const Eigen::Index count : {3, 4, 9, 30}) {
        const Eigen::MatrixX2d nodes = scattered(random, count);
        const RbfWeights rbf(nodes);
        for (Eigen::Index n = 0; n < count; ++n) {
            CHECK((rbf.at(nodes.row(n)) - Eigen::VectorXd::Unit(count, n)).norm() < 1e-7);
        }
        for (int k = 0; k < 20; ++k) {
            const Eigen::RowVector2d place(random.uniform(-1, 3), random.uniform(-1, 3));
            const Eigen::VectorXd w = rbf.at(place);
            CHECK(w.sum() == doctest::Approx(1));
            CHECK((w.transpose() * nodes - place).norm() < 1e-7);
        }
    }
}

TEST_CASE("weights are those of the places, however these are shifted, turned, scaled or named") {
    Random random(4);
    const Eigen::MatrixX2d nodes = scattered(random, 6);
    const RbfWeights rbf(nodes);
    Eigen::Matrix2d turn;
    turn << std::cos(0.7), -std::sin(0.7), std::sin(0.7), std::cos(0.7);
    const Eigen::RowVector2d shift(0.3, -2);
    const Eigen::MatrixX2d moved = (2.5 * nodes * turn).rowwise() + shift;
    const Eigen::MatrixX2d reversed = nodes.colwise().reverse();
    const RbfWeights movedRbf(moved);
    const RbfWeights reversedRbf(reversed);
    for (int k = 0; k < 20; ++k) {
        const Eigen::RowVector2d place(random.uniform(0, 1.5), random.uniform(0, 1.5));
        const Eigen::VectorXd expected = rbf.at(place);
        CHECK((movedRbf.at(2.5 * place * turn + shift) - expected).norm() < 1e-8);
        CHECK((reversedRbf.at(place).reverse() - expected).norm() < 1e-8);
    }
}

TEST_CASE("at the middle of the poster's square all four corners count the same") {
    Eigen::MatrixX2d nodes(4, 2);
    nodes << 0.5, 0.5, 0.5, 1.3, 1.3, 0.5, 1.3, 1.3;
    const Eigen::VectorXd middle = RbfWeights(nodes).at({0.9, 0.9});
    for (Eigen::Index n = 0; n < 4; ++n) CHECK(middle(n) == doctest::Approx(0.25));
    // Light and view exchanged exchange two corners.
    const Eigen::VectorXd a = RbfWeights(nodes).at({0.2, 1.1});
    const Eigen::VectorXd b = RbfWeights(nodes).at({1.1, 0.2});
    CHECK(a(1) == doctest::Approx(b(2)));
    CHECK(a(0) == doctest::Approx(b(0)));
}

TEST_CASE("nodes on one line are refused") {
    Eigen::MatrixX2d nodes(4, 2);
    nodes << 0.1, 0.2, 0.2, 0.4, 0.3, 0.6, 0.4, 0.8;
    CHECK_THROWS_AS(RbfWeights{nodes}, std::invalid_argument);
    nodes << 0.1, 0.2, 0.1, 0.2, 0.3, 0.6, 0.4, 0.1;
    CHECK_THROWS_AS(RbfWeights{nodes}, std::invalid_argument);
}

TEST_SUITE_END();
