// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "color/rgb.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace abrdf {

enum class PixelType { kHalf, kFloat };

/// "half" or "float".
std::string nameOf(PixelType type);

enum class Compression { kNone, kZips, kZip, kPiz };

/// none | zips | zip | piz; throws std::invalid_argument for other names.
Compression compressionFromName(const std::string& name);

/// True where every value keeps finite as a half (at most 65504).
bool fitsHalf(std::span<const Rgb> values);

/// Writes an atlas as a tiled OpenEXR file: R, G, B in part 0. An angular atlas has a tile for
/// each texel, a spatial one a tile for each pair (at least 64 pixels wide and high in both).
/// The file appears under its name at finish() alone; without it nothing is left behind.
/// The same values give the same bytes. Throws std::runtime_error that names the file.
class AtlasWriter {
  public:
    AtlasWriter(const std::filesystem::path& path, const AtlasHeader& header, PixelType type,
                Compression compression);
    ~AtlasWriter();

    /// Rows [firstRow, firstRow + rows) of pixels, over the whole width; in ascending order, and
    /// each block but the last must end where a tile ends. A half above 65504 is cut to it.
    /// Returns how many values were cut.
    std::uint64_t writeRows(int firstRow, int rows, std::span<const Rgb> pixels);

    /// Rows of one row of tiles.
    int tileHeight() const;

    /// Puts the final counts into the header and the file in its place. Returns its size in bytes.
    std::uint64_t finish(const ValueCounts& counts);

  private:
    struct File;
    std::unique_ptr<File> file_;
};

}  // namespace abrdf
