// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/batch/batch.h"

#include <filesystem>
#include <vector>

namespace abrdf {

/// The materials of a TOML job file for `abrdf run`. Keys are the options of convert; `input` holds
/// one or more patterns of paths (* ? [ ]), and in any text {name} stands for the input's name
/// without its ending. Keys at the top hold for all; each table [[material]] adds inputs with keys
/// of its own before those. Sorted within a pattern; paths are relative to the working folder.
/// Throws std::runtime_error that names the file and the line.
std::vector<BatchItem> batchFromFile(const std::filesystem::path& file);

}  // namespace abrdf
