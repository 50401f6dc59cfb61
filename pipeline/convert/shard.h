// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace abrdf {

/// A part of a job: 1 .. count.
struct Shard {
    int index = 1;
    int count = 1;
};

/// "I/N". Throws std::invalid_argument.
Shard shardFromText(const std::string& text);

}  // namespace abrdf
