// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/model_parts.h"

#include <fmt/format.h>

namespace abrdf {

std::vector<std::string> vectorNames(const TexelRule& rule) {
    std::vector<std::string> names = {"Y"};
    if (rule.logVectors() > 1) names.insert(names.end(), {"R", "G", "B"});
    if (rule.chromaVectors() > 0) names.insert(names.end(), {"cR", "cG"});
    return names;
}

std::string coefficientName(const std::string& vector, std::size_t k) {
    return fmt::format("{}.{:03}", vector, k);
}

}  // namespace abrdf
