// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/code_projection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace abrdf {

CodeProjection::CodeProjection(const Eigen::MatrixXf& luminance, const Eigen::MatrixXf& chroma,
                               TexelRule rule, std::size_t stride)
    : luminance_(luminance), chroma_(chroma), rule_(rule), stride_(stride) {}

TexelCodes CodeProjection::projected(const TexelCodes& whole) const {
    TexelCodes codes;
    codes.stride = stride_;
    codes.scales = whole.scales;
    codes.ranks.assign(whole.count(), static_cast<std::uint16_t>(stride_));
    const auto apply = [&](const PackedMatrix& projection, const std::vector<float>& from,
                           std::vector<float>& to) {
        const std::size_t padded = projection.panels() * PackedMatrix::kPanel;
        std::vector<float> products(whole.count() * padded);
        projection.multiply(from, 0, projection.panels(), products.data(), padded);
        to.resize(whole.count() * stride_);
        for (std::size_t t = 0; t < whole.count(); ++t) {
            std::copy_n(products.begin() + static_cast<std::ptrdiff_t>(t * padded),
                        projection.rows(), to.begin() + static_cast<std::ptrdiff_t>(t * stride_));
        }
    };
    for (std::size_t i = 0; i < rule_.logVectors(); ++i) {
        apply(luminance_, whole.logs[i], codes.logs[i]);
    }
    for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) {
        apply(chroma_, whole.chroma[c], codes.chroma[c]);
    }
    return codes;
}

double CodeProjection::multiplyAdds() const {
    return static_cast<double>(rule_.logVectors() * luminance_.rows() * luminance_.columns() +
                               rule_.chromaVectors() * chroma_.rows() * chroma_.columns());
}

void cutToRanks(const TexelCodes& whole, TexelCodes& projected) {
    const auto cut = [&](const std::vector<float>& from, std::vector<float>& to) {
        for (std::size_t t = 0; t < projected.count() && !to.empty(); ++t) {
            const auto begin = to.begin() + static_cast<std::ptrdiff_t>(t * projected.stride);
            const std::size_t rank = projected.ranks[t];
            if (rank == whole.stride) {
                std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(t * rank), rank, begin);
            } else {
                std::fill(begin + static_cast<std::ptrdiff_t>(rank),
                          begin + static_cast<std::ptrdiff_t>(projected.stride), 0.0F);
            }
        }
    };
    for (std::size_t i = 0; i < 4; ++i) cut(whole.logs[i], projected.logs[i]);
    for (std::size_t c = 0; c < 2; ++c) cut(whole.chroma[c], projected.chroma[c]);
}

TexelCodes codesOfCenter(const TexelCodes& whole, const TexelRule& rule) {
    constexpr float kRounding = 1e-4F;  ///< Of logarithms.
    TexelCodes codes;
    codes.stride = 1;
    codes.scales = whole.scales;
    codes.ranks.assign(whole.count(), 1);
    for (std::size_t i = 0; i < rule.logVectors(); ++i) codes.logs[i].resize(whole.count());
    for (std::size_t c = 0; c < rule.chromaVectors(); ++c) codes.chroma[c].resize(whole.count());
    for (std::size_t i = 0; i < whole.logs[0].size(); ++i) {
        if (whole.scales[i / whole.stride].luminance > 0 &&
            std::abs(whole.logs[0][i]) > kRounding) {
            throw std::logic_error("a material of one texel was asked for another");
        }
    }
    return codes;
}

}  // namespace abrdf
