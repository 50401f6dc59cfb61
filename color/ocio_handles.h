// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/color_config.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <string>

namespace abrdf {

// What stands behind color_config.h, for its sources alone: no other file sees OpenColorIO.

struct ColorTransform::Processor {
    OCIO_NAMESPACE::ConstCPUProcessorRcPtr cpu;
};

struct ColorConfig::Loaded {
    OCIO_NAMESPACE::ConstConfigRcPtr config;
};

/// Only foldings that leave the values alone: no approximate powers, no baking into tables.
inline OCIO_NAMESPACE::ConstCPUProcessorRcPtr exactCpu(
    const OCIO_NAMESPACE::ConstProcessorRcPtr& processor) {
    return processor->getOptimizedCPUProcessor(OCIO_NAMESPACE::BIT_DEPTH_F32,
                                               OCIO_NAMESPACE::BIT_DEPTH_F32,
                                               OCIO_NAMESPACE::OPTIMIZATION_LOSSLESS);
}

/// OpenColorIO's message as the middle of a sentence: one line, no full stop.
inline std::string reason(const std::exception& error) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.erase(text.find_last_not_of(". ") + 1);
    return text;
}

}  // namespace abrdf
