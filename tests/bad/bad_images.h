// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace abrdf {

/// What an image of any form is made of; its bytes as OpenImageIO writes them.
struct OddImage {
    std::string extension = "exr";
    std::vector<std::string> channels = {"R", "G", "B"};
    int width = 2;
    int height = 2;
    int bits = 32;  ///< 8, 16 (integers) or 32 (float).
    bool deep = false;
    int parts = 1;  ///< Alike; OpenEXR and TIFF.
    float value = 0.25F;
};
std::string bytesOf(const OddImage& image);

/// OpenEXR whose channels are sampled at every second pixel in both directions.
std::string subsampledExr();

/// A JPEG of four inks.
std::string cmykJpeg();

/// A progressive JPEG's header and first scan, then the same scan `count` times more.
std::string jpegOfScans(int count);

/// A PNG of `side` x `side` black pixels, which deflate packs to a thousandth.
std::string blackPng(std::uint32_t side);

/// The PNG with another width and height in its header, whose checksum fits.
std::string withPngSize(std::string png, std::uint32_t width, std::uint32_t height);

}  // namespace abrdf
