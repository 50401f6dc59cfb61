// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace abrdf {

/// How far one phase of a job is: `done` of `total` `unit`s ("images", "texels").
struct ProgressTick {
    std::string_view phase;
    std::string_view unit;
    std::size_t done = 0;
    std::size_t total = 0;
};

/// Receives ticks from any thread, out of order; may be empty.
using ProgressSink = std::function<void(const ProgressTick&)>;

/// Receives what a user should know though the job goes on, a sentence each; may be empty.
using MessageSink = std::function<void(const std::string&)>;

}  // namespace abrdf
