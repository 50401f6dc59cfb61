// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/stopwatch.h"

#include <algorithm>
#include <cstddef>
#include <vector>

/// Seconds of one call.
template <typename Work>
double secondsOf(Work work) {
    const abrdf::Stopwatch time;
    work();
    return time.seconds();
}

inline double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

/// Two things by turns, so that what disturbs the machine disturbs both: seconds of each, medians.
struct Duel {
    double ours = 0;
    double limit = 0;

    template <typename Ours, typename Limit>
    static Duel of(std::size_t rounds, Ours ours, Limit limit) {
        ours();  // What is built on first use is no part of it.
        limit();
        std::vector<double> a;
        std::vector<double> b;
        for (std::size_t i = 0; i < rounds; ++i) {
            a.push_back(secondsOf(ours));
            b.push_back(secondsOf(limit));
        }
        return {medianOf(a), medianOf(b)};
    }
};
