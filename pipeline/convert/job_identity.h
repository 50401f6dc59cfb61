// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/convert/convert_job.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace abrdf {

/// What the atlas's bytes depend on, as far as it is known without decoding an image: two jobs that
/// agree in it make the same atlas of the same images.
nlohmann::ordered_json askedOf(const ConvertJob& job, const ConvertOptions& options);

/// Adds what is known once the images were read: `hash` of their texels, and of what the method
/// makes of their mean.
nlohmann::ordered_json identityOf(nlohmann::ordered_json asked, std::uint64_t hash,
                                  std::span<const Rgb> meanSamples,
                                  const Reconstructor& reconstructor, std::size_t pairs);

}  // namespace abrdf
