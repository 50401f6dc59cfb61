// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/greedy_pairs.h"

#include "abrdf/for_each_texel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

using namespace abrdf;

namespace {

const AngularGrid& smallGrid() {
    static const AngularGrid kGrid(regularDirections(3, 5));
    return kGrid;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("pairs are chosen once each, a shorter plan is a prefix, and uncertainty falls") {
    const GreedyChoice longer = greedyPairs(smallGrid(), {}, {.count = 20, .materials = 20}, {});
    const GreedyChoice shorter = greedyPairs(smallGrid(), {}, {.count = 7, .materials = 20}, {});
    CHECK(longer.pairs.size() == 20);
    CHECK(std::set<std::size_t>(longer.pairs.begin(), longer.pairs.end()).size() == 20);
    CHECK(std::equal(shorter.pairs.begin(), shorter.pairs.end(), longer.pairs.begin()));
    CHECK(std::is_sorted(longer.variance.rbegin(), longer.variance.rend()));
    CHECK(longer.variance.front() < 1);
    CHECK(longer.variance.back() < 0.5 * longer.variance.front());
}

TEST_CASE("where one pair is watched, off the grid, the nearest ones are chosen for it") {
    const LightAndView wanted = {{0.62, 1.1}, {0.7, 5.8}};
    const WatchedPairs watched =
        watchedPairs(smallGrid(), {wanted, {{0.1, 0}, {0.2, 0}}}, std::vector<double>{1, 0});
    const GreedyChoice choice =
        greedyPairs(smallGrid(), {}, watched, {.count = 6, .materials = 40}, {});
    std::vector<double> distances;
    for (const LightAndView& pair : pairsOf(smallGrid())) {
        distances.push_back(squaredDistance(pair, wanted));
    }
    std::ranges::sort(distances);
    // The first is among the nearest tenth, and much is known after six.
    const double first = squaredDistance(smallGrid().pair(choice.pairs[0]), wanted);
    CHECK(first <= distances[distances.size() / 10]);
    // What pairs that were chosen for the whole grid leave open there.
    const GreedyChoice whole = greedyPairs(smallGrid(), {}, {.count = 6, .materials = 40}, {});
    const GreedyChoice other = greedyPairs(smallGrid(), {}, watched,
                                           {.count = 6, .materials = 40, .first = whole.pairs}, {});
    CHECK(choice.variance.back() < other.variance.back());
}

TEST_CASE("a plan goes on from pairs that are given, and keeps to its candidates") {
    const std::vector<std::size_t> candidates = {3, 40, 41, 90, 91, 120, 200};
    const GreedyChoice choice =
        greedyPairs(smallGrid(), candidates, {.count = 6, .materials = 10, .first = {90, 3}}, {});
    CHECK(choice.pairs[0] == 90);
    CHECK(choice.pairs[1] == 3);
    for (const std::size_t pair : choice.pairs) {
        CHECK(std::ranges::find(candidates, pair) != candidates.end());
    }
    CHECK_THROWS_AS(greedyPairs(smallGrid(), candidates, {.count = 8, .materials = 10}, {}),
                    std::invalid_argument);
    CHECK_THROWS_AS(greedyPairs(smallGrid(), {}, {.count = 0, .materials = 10}, {}),
                    std::invalid_argument);
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("threads");

TEST_CASE("the same pairs are chosen on 1, 2 and 7 threads") {
    std::vector<std::size_t> first;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        const auto pairs = greedyPairs(smallGrid(), {}, {.count = 12, .materials = 15}, {}).pairs;
        if (first.empty()) first = pairs;
        CHECK(pairs == first);
    }
}

TEST_SUITE_END();
