// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace abrdf {

/// Bytes put together number by number, little-endian.
class ByteWriter {
  public:
    template <typename T>
    ByteWriter& put(T value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    ByteWriter& text(const std::string& text) {
        bytes_ += text;
        return *this;
    }
    /// A number of 2 (half), 4 or 8 bytes.
    ByteWriter& scalar(double value, unsigned bytes);

    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// A .btf of a few texels. Factors are small numbers that halfs hold exactly.
struct SmallBtf {
    std::string signature = "!DFMF08FCR";
    std::vector<Direction> lights = regularDirections(2, 3);
    std::vector<Direction> views = regularDirections(2, 2);
    unsigned width = 3;
    unsigned height = 2;
    std::uint32_t cosineFlag = 1;
    unsigned scalarBytes = 2;
    unsigned components = 2;
    bool imagesAsColumns = false;
    std::int32_t colorModel = 0;       ///< DFMF.
    std::array<float, 3> mean{};       ///< DFMF, model 3.
    std::array<float, 9> matrix{};     ///< DFMF, model 3.
    std::uint32_t logarithm = 0;       ///< FMF.
    std::vector<std::uint8_t> mask{};  ///< BDI; empty: full.
    std::uint32_t rotations = 0;
};

/// Entry (row, k) of the factor of direction pairs, and of texels, of every SmallBtf.
double pairFactor(std::size_t row, std::size_t k);
double texelFactor(std::size_t row, std::size_t k);

std::string btfBytes(const SmallBtf& btf);

/// An RGL tensor file whose visible normals are uniform, so that a sample is where its micronormal
/// is; rgb is `red` for channel 0, 2 and 3 times that for the others.
struct SmallRgl {
    std::vector<float> phiIn = {0};
    std::vector<float> thetaIn = {0, 1.5F};
    bool jacobian = false;
    float ndf = 2;
    float sigma = 0.5F;
    float red = 0.25F;
    /// Added to `red` in the tables of phi node i: i times this.
    float redStep = 0;
};
std::string rglBytes(const SmallRgl& rgl);

/// An MBSDF of thetas x thetas x phis cells; cell (i, o, p) holds the RGB i + 1, o + 1, p + 1.
std::string mbsdfBytes(unsigned thetas, unsigned phis, std::uint32_t type = 1);

/// A Radiance HDR of 4-byte pixels without run lengths: red of pixel k of the file is (128 + k) /
/// 256.
std::string hdrBytes(const std::string& sizeLine, unsigned pixels);

}  // namespace abrdf
