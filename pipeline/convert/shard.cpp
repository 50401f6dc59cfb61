// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/shard.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <system_error>

namespace abrdf {

Shard shardFromText(const std::string& text) {
    Shard shard;
    const char* end = text.data() + text.size();
    const auto [slash, error] = std::from_chars(text.data(), end, shard.index);
    if (error == std::errc() && slash != end && *slash == '/') {
        const auto [rest, countError] = std::from_chars(slash + 1, end, shard.count);
        if (countError == std::errc() && rest == end && shard.index >= 1 &&
            shard.index <= shard.count) {
            return shard;
        }
    }
    throw std::invalid_argument(fmt::format(
        "the shard '{}' is not understood: write I/N with I from 1 to N, as 1/4", text));
}

}  // namespace abrdf
