// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace abrdf {

/// A message as one line that a terminal only shows: names of files from archives and folders may
/// hold new lines and the control characters that steer it; these come out as \n and \x1b.
/// UTF-8 stays as it is.
std::string printable(std::string_view message);

}  // namespace abrdf
