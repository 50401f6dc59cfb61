// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace abrdf {

/// Thrown between two blocks of work after requestCancel(); what is half done is undone on the way.
struct Cancelled : std::runtime_error {
    Cancelled() : std::runtime_error("interrupted: nothing was written") {}
};

/// Asks every running job to stop soon. May be called from a signal handler.
void requestCancel() noexcept;

/// Throws Cancelled once requestCancel() was called.
void throwIfCancelled();

}  // namespace abrdf
