// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"

#include <string>

namespace abrdf {

/// How progress is shown on stderr.
enum class ProgressStyle {
    kNone,
    kPlain,  ///< A line every ten seconds.
    kBar,    ///< One line that moves, with rate and time left.
    kJson,   ///< A JSON object a line, once a second and at the end of each phase, for farms.
};

/// auto | bar | plain | json | none; auto is a bar on a terminal, else plain.
/// Throws std::invalid_argument for other names.
ProgressStyle progressStyleFromName(const std::string& name);

/// A sink that shows ticks; clears its bar when a phase is done.
ProgressSink makeProgressDisplay(ProgressStyle style);

}  // namespace abrdf
