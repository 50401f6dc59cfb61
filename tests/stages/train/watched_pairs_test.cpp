// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/watched_pairs.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <vector>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("a scene of many pairs is watched at some of them, by weight") {
    std::vector<LightAndView> scene(3000, {{0.3, 0}, {0.4, 0}});
    std::vector<double> weights(3000, 0.5 / 2999);
    scene[17] = {{0.5, 0}, {0.6, 0}};
    weights[17] = 0.5;
    const WatchedPairs watched = watchedPairs(AngularGrid(regularDirections(3, 5)), scene, weights);
    CHECK(watched.others.size() < 2000);
    CHECK(watched.share.sum() == doctest::Approx(1));
    double own = 0;
    for (std::size_t i = 0; i < watched.others.size(); ++i) {
        if (watched.others[i] == scene[17]) own += watched.share(static_cast<Eigen::Index>(i));
    }
    CHECK(own == doctest::Approx(0.5).epsilon(0.01));
}

TEST_SUITE_END();
