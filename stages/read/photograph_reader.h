// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/btf_reader.h"
#include "stages/read/file_source.h"

#include <memory>
#include <string>
#include <vector>

namespace abrdf {

/// One image file of a database, and the directions that its name or a list gives it, in degrees.
struct Photograph {
    std::size_t file = 0;  ///< Index into FileSource::names().
    double thetaLight = 0;
    double phiLight = 0;
    double thetaView = 0;
    double phiView = 0;
};

/// What sets one database of image files apart from another.
struct PhotographFormat {
    std::string name;
    std::string source;                                 ///< The database's own name.
    std::string linearSpace = "Linear Rec.709 (sRGB)";  ///< Of EXR, HDR and PFM; else sRGB.
    std::string cosineFrom = "convention of photographs of a flat sample";
    std::vector<std::string> notes = {};  ///< For BtfDescription.
    bool isList = false;  ///< Pairs without an image are not missing: nobody promised a grid.
};

/// The reader that all databases of image files share: the grid is that of all light and all view
/// directions. Photographs from or to below the horizon (theta of 90 degrees and more) are counted
/// and left out. Throws std::runtime_error for impossible angles, for a grid out of all proportion
/// to the number of images, and where no image is left.
std::unique_ptr<BtfReader> makePhotographReader(std::shared_ptr<const FileSource> files,
                                                const std::vector<Photograph>& photographs,
                                                const PhotographFormat& format);

}  // namespace abrdf
