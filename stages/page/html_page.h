// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/page/page_content.h"

#include <string>

namespace abrdf {

/// The page as one self-contained HTML file: data, viewer, charts, style and the licences of what
/// it carries. It asks no network for anything; the same content gives the same bytes.
std::string htmlPage(const PageContent& content);

}  // namespace abrdf
