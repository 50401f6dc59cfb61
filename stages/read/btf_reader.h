// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/atlas_header.h"
#include "abrdf/brdf_table.h"
#include "abrdf/encoded_image.h"
#include "stages/read/read_options.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace abrdf {

/// What a database says of itself, known without decoding its images.
struct BtfDescription {
    std::string format;  ///< "UBO2003"
    std::string source;  ///< Its file's or folder's own name.
    AngularGrid grid;
    std::vector<std::uint8_t> present;    ///< One flag a pair of the grid.
    std::vector<std::string> duplicates;  ///< Sentences: which files stand for one pair.
    int width = 0;                        ///< Of every image, pixels.
    int height = 0;
    std::string
        colorSpace;  ///< OpenColorIO name of the values as stored, by the format's convention.
    Cosine cosine = Cosine::kKept;
    std::string cosineFrom;        ///< How that is known: "header", "convention ...", "guess ...".
    Radians maxMeasuredTheta = 0;  ///< Past it all values are extrapolated.
    std::size_t belowHorizon = 0;  ///< Images, or entries, from or to below the surface.
    bool isList = false;           ///< Pairs without an image are not missing.
    std::vector<std::string> notes;  ///< Sentences on what was assumed in reading.

    std::size_t imageCount() const;
    std::vector<std::size_t> missingPairs() const;  ///< None where isList.
};

/// One database, open for reading: a file of this folder for each format.
class BtfReader {
  public:
    virtual ~BtfReader() = default;

    virtual const BtfDescription& description() const = 0;

    /// The image of a present pair; from any thread. Throws std::runtime_error that names the file.
    virtual EncodedImage read(std::size_t pair) const = 0;

    /// The file of a present pair, for messages.
    virtual std::string fileOf(std::size_t pair) const = 0;

    /// Bytes of the file of a present pair, where known without reading it; for estimates.
    virtual std::uint64_t bytesOf(std::size_t pair) const = 0;

    /// Where the database is a BRDF in a table: its value at any pair of directions, not only at
    /// the grid's; else null. Its "images" are 1 x 1, evaluated from it.
    virtual const BrdfTable* table() const { return nullptr; }
};

/// Opens a database of any known format.
/// Throws std::runtime_error that lists the formats where none recognizes `path`.
std::unique_ptr<BtfReader> openBtf(const std::filesystem::path& path,
                                   const ReadOptions& options = {});

}  // namespace abrdf
