// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/preview/preview.h"

namespace abrdf {

/// Draws and writes the kinds sheet and polar; adds what was done to `report`.
void drawFigure(const PreviewOptions& options, const ColorConfig& colors,
                nlohmann::ordered_json& report);

}  // namespace abrdf
