// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace abrdf {

/// Pairs of a grid by falling worth, and the Delta E that is expected after each.
struct ChosenPairs {
    std::vector<std::size_t> pairs;
    std::vector<double> errors;
};

/// What choose() returns; from the cache where the same key was asked for before, and into it.
/// key: all that the choice depends on, `count` pairs, below pairCount.
ChosenPairs cachedChoice(const std::string& key, std::size_t count, std::size_t pairCount,
                         const std::function<ChosenPairs()>& choose, const MessageSink& warn);

}  // namespace abrdf
