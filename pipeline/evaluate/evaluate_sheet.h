// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "pipeline/evaluate/evaluated_method.h"
#include "pipeline/evaluate/reference.h"
#include "stages/measure/contact_sheet.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace abrdf {

/// Mean over all texels, pair by pair: what the sheet shows.
std::vector<Rgb> meanAbrdf(const AbrdfTile& tile);

/// A method's row, without images. result: its part of the report.
SheetRow sheetRowOf(const nlohmann::ordered_json& result, const AbrdfTile& abrdfs);

/// Measurement and reconstruction at the measured pairs nearest to those that were asked for.
std::vector<SheetImage> sheetImages(const Reference& reference,
                                    const EvaluatedMethod& reconstruction, const AngularGrid& grid,
                                    const std::vector<LightAndView>& wanted);

}  // namespace abrdf
