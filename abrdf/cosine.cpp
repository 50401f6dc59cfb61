// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/cosine.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

std::string nameOf(Cosine cosine) {
    switch (cosine) {
        case Cosine::kKept:
            return "kept";
        case Cosine::kDivided:
            return "divided";
        case Cosine::kAbsent:
            return "absent";
    }
    return "kept";
}

Cosine cosineFromName(const std::string& name) {
    for (const Cosine cosine : {Cosine::kKept, Cosine::kDivided, Cosine::kAbsent}) {
        if (nameOf(cosine) == name) return cosine;
    }
    throw std::invalid_argument(fmt::format("'{}' is not kept, divided or absent", name));
}

}  // namespace abrdf
