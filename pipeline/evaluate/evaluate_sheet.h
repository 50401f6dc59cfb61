// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "stages/measure/contact_sheet.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace abrdf {

/// Mean over all texels, pair by pair: what the sheet shows.
std::vector<Rgb> meanAbrdf(const AbrdfTile& tile);

/// The image of a pair.
std::vector<Rgb> imageOf(const AbrdfTile& tile, std::size_t pair);

/// A method's row, without images. result: its part of the report.
SheetRow sheetRowOf(const nlohmann::ordered_json& result, const AbrdfTile& abrdfs);

}  // namespace abrdf
