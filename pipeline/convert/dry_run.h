// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/convert/convert.h"

#include <nlohmann/json.hpp>

namespace abrdf {

/// What a job would do, without decoding a pixel: images to be read, bytes, memory, scratch files,
/// output size. Throws as convert().
nlohmann::ordered_json planConvert(const ConvertOptions& options);

}  // namespace abrdf
