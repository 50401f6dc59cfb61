// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace abrdf {

/// Work that comes and goes in order and is done at once: what one item needs is fetched, worked on
/// and delivered, while others are on their way. `slot` (below `slots`) is the item's own while it
/// is under way, so that buffers can be kept and used again.
struct Flow {
    using Step = std::function<void(std::size_t item, std::size_t slot)>;

    std::size_t items = 0;
    std::size_t slots = 1;  ///< Most items under way; bounds what their buffers take.
    Step fetch;             ///< One item after the other, in order; may be empty.
    Step work;              ///< On any thread, many at once.
    Step deliver;           ///< One item after the other, in order; may be empty.
};

/// Runs all items on the threads of forEachTexel(). What is thrown inside is thrown again here; a
/// cancelled job stops between two items.
void runFlow(const Flow& flow);

}  // namespace abrdf
