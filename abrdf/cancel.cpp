// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/cancel.h"

#include <atomic>

namespace abrdf {

namespace {

std::atomic<bool> gCancelRequested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers may not lock");

}  // namespace

void requestCancel() noexcept {
    gCancelRequested = true;
}

void throwIfCancelled() {
    if (gCancelRequested.load(std::memory_order_relaxed)) throw Cancelled();
}

}  // namespace abrdf
