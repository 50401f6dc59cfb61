// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace abrdf {

/// The text of a file of stages/page/assets or stages/page/vendor, built into the program.
/// Throws std::out_of_range for other names.
std::string_view pageAsset(std::string_view name);

}  // namespace abrdf
