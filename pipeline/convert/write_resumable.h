// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/transposed_table.h"
#include "pipeline/convert/convert_job.h"
#include "pipeline/convert/texel_maker.h"
#include "pipeline/convert/written_atlas.h"

#include <nlohmann/json.hpp>

namespace abrdf {

/// Makes and writes all tiles of an atlas from a table of its texels (rows images, columns texels
/// in the order of the job), with options.resume from where an earlier run of the same `identity`
/// stopped on. Begins anew as float where a half cannot hold a value and options.pixel is kAuto.
/// What an exception leaves unfinished goes, unless it is to be continued.
WrittenAtlas writeResumable(const ConvertJob& job, const ConvertOptions& options,
                            const MemoryPlan& memory, const TransposedTable& table,
                            const TexelMaker& maker, const nlohmann::ordered_json& identity,
                            const ProgressSink& progress);

}  // namespace abrdf
