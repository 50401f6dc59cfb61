// SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress_display.h"

#include "abrdf/stopwatch.h"
#include "pipeline/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace abrdf {

namespace {

class Display {
  public:
    explicit Display(ProgressStyle style) : style_(style) {}

    void show(const ProgressTick& tick) {
        const std::lock_guard lock(mutex_);
        if (phase_ != tick.phase) {
            phase_ = tick.phase;
            begin_ = {};
            first_ = tick.done;
            shown_ = {};
            most_ = 0;
        }
        // Ticks come from many threads; the bar never runs backwards.
        if (tick.done <= most_) return;
        most_ = tick.done;
        const double interval = style_ == ProgressStyle::kBar    ? 0.1
                                : style_ == ProgressStyle::kJson ? 1.0
                                                                 : 10.0;
        const bool last = tick.done == tick.total;
        if (style_ == ProgressStyle::kBar && last) {
            std::fputs("\r\033[K", stderr);
        } else if (shown_.seconds() >= interval || (style_ == ProgressStyle::kJson && last)) {
            shown_ = {};
            print(tick, begin_.seconds());
        }
    }

  private:
    void print(const ProgressTick& tick, double seconds) const {
        // What an earlier run did says nothing of this one's speed.
        const double rate =
            static_cast<double>(tick.done - std::min(tick.done, first_)) / std::max(seconds, 1e-9);
        const double left = static_cast<double>(tick.total - tick.done) / std::max(rate, 1e-9);
        if (style_ == ProgressStyle::kJson) {
            const nlohmann::ordered_json line = {{"phase", tick.phase}, {"unit", tick.unit},
                                                 {"done", tick.done},   {"total", tick.total},
                                                 {"seconds", seconds},  {"rate", rate},
                                                 {"seconds_left", left}};
            std::fputs((jsonText(line) + "\n").c_str(), stderr);
            return;
        }
        const std::string facts =
            fmt::format("{} {}/{} {}, {:.0f} a second, {:.0f} s left", tick.phase, tick.done,
                        tick.total, tick.unit, rate, left);
        if (style_ == ProgressStyle::kPlain) {
            std::fputs((facts + "\n").c_str(), stderr);
            return;
        }
        constexpr std::size_t kWidth = 24;
        const std::size_t filled = kWidth * tick.done / tick.total;
        const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
        std::fputs(fmt::format("\r\033[K[{}] {}", bar, facts).c_str(), stderr);
        std::fflush(stderr);
    }

    ProgressStyle style_;
    std::mutex mutex_;
    std::string phase_;
    Stopwatch begin_;
    Stopwatch shown_;
    std::size_t first_ = 0;  ///< Done at begin_.
    std::size_t most_ = 0;
};

}  // namespace

ProgressStyle progressStyleFromName(const std::string& name) {
    if (name == "none") return ProgressStyle::kNone;
    if (name == "plain") return ProgressStyle::kPlain;
    if (name == "json") return ProgressStyle::kJson;
    if (name == "bar") return ProgressStyle::kBar;
    if (name == "auto")
        return isatty(STDERR_FILENO) != 0 ? ProgressStyle::kBar : ProgressStyle::kPlain;
    throw std::invalid_argument(
        fmt::format("there is no progress '{}': use auto, bar, plain, json or none", name));
}

ProgressSink makeProgressDisplay(ProgressStyle style) {
    if (style == ProgressStyle::kNone) return {};
    auto display = std::make_shared<Display>(style);
    return [display](const ProgressTick& tick) { display->show(tick); };
}

}  // namespace abrdf
