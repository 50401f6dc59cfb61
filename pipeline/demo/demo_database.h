// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"

#include <cstdint>
#include <filesystem>

namespace abrdf {

struct DemoOptions {
    int size = 64;           ///< Texels each way, 1 .. 1024.
    std::uint64_t seed = 1;  ///< The same seed makes the same bytes, another one other colours.
    bool hdr = false;        ///< Half-float EXR with whole highlights; else JPEG clipped at 1.
    float relief = 1;        ///< Stretches the cloth's heights: 0 is flat, 1 as it is woven.
    double height = 0;       ///< Of its surface above the plane of rectification, in texels.
};

/// Writes a licence-free BTF database of a virtual cloth in UBO2003's layout: 81 x 81 images
/// tvTTT_pvPPP/NNNNN tlTTT plPPP tvTTT pvPPP.jpg, NNNNN = 81 light + view. `target` is a new or
/// empty folder, or a file *.zip, which is replaced. It appears whole or not at all.
/// Ticks: phase "render", unit "images". Throws std::invalid_argument for the options,
/// std::runtime_error for the target, Cancelled.
void writeDemoDatabase(const std::filesystem::path& target, const DemoOptions& options,
                       const ProgressSink& progress);

}  // namespace abrdf
