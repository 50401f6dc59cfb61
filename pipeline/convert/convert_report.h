// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/convert/convert_job.h"
#include "pipeline/convert/written_atlas.h"

#include <nlohmann/json.hpp>

#include <string>

namespace abrdf {

/// The parts of a report that are known beforehand.
nlohmann::ordered_json reportOf(const ConvertJob& job, const ConvertOptions& options);

/// Wall clock of a conversion, seconds.
struct RunSeconds {
    double read = 0;   ///< Until all images were read, with planning and aligning.
    double total = 0;  ///< Until the atlas was in place.
};

/// The whole report of a conversion. remark: Reconstructor's, or empty.
nlohmann::ordered_json reportOf(const ConvertJob& job, const ConvertOptions& options,
                                const MemoryPlan& memory, const WrittenAtlas& written,
                                const std::string& remark, RunSeconds seconds);

}  // namespace abrdf
