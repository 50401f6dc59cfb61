// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"
#include "abrdf/reciprocity.h"
#include "stages/average/average_image.h"
#include "stages/read/btf_reader.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace abrdf {

/// What all images of a database tell, read once each.
struct StackFacts {
    float least = std::numeric_limits<float>::infinity();  ///< As stored; codes as code / 255.
    float greatest = -std::numeric_limits<float>::infinity();
    std::uint64_t nonfinite = 0;          ///< Stored numbers.
    std::vector<std::string> unreadable;  ///< Sentences.
    Reciprocity reciprocity;              ///< Of the images' means in linear light.
};

/// Decodes every present image, in parallel. Ticks: phase "inspect", unit "images".
StackFacts stackFacts(const BtfReader& reader, const Linearizer& linearizer,
                      const ProgressSink& progress);

}  // namespace abrdf
