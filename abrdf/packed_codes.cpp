// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/packed_codes.h"

#include <algorithm>

namespace abrdf {

PackedCodes::PackedCodes(TexelRule rule, std::size_t texels) : rule_(rule), texels_(texels) {}

void PackedCodes::store(std::size_t first, const TexelCodes& codes) {
    for (std::size_t t = 0; t < codes.count(); ++t) {
        Texel& texel = texels_[first + t];
        texel = {codes.scales[t], codes.ranks[t], {}};
        const auto add = [&](const std::vector<float>& vectors) {
            const auto begin = vectors.begin() + static_cast<std::ptrdiff_t>(t * codes.stride);
            texel.numbers.insert(texel.numbers.end(), begin, begin + texel.rank);
        };
        texel.numbers.reserve(rule_.vectors() * texel.rank);
        for (std::size_t i = 0; i < rule_.logVectors(); ++i) add(codes.logs[i]);
        for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) add(codes.chroma[c]);
    }
}

TexelCodes PackedCodes::unpacked(std::span<const std::size_t> texels) const {
    TexelCodes codes;
    for (const std::size_t t : texels) {
        codes.scales.push_back(texels_[t].scale);
        codes.ranks.push_back(texels_[t].rank);
        codes.stride = std::max<std::size_t>(codes.stride, texels_[t].rank);
    }
    const auto fill = [&](std::size_t which, std::vector<float>& to) {
        to.resize(texels.size() * codes.stride);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const Texel& texel = texels_[texels[i]];
            std::copy_n(texel.numbers.begin() + static_cast<std::ptrdiff_t>(which * texel.rank),
                        texel.rank, to.begin() + static_cast<std::ptrdiff_t>(i * codes.stride));
        }
    };
    for (std::size_t i = 0; i < rule_.logVectors(); ++i) fill(i, codes.logs[i]);
    for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) {
        fill(rule_.logVectors() + c, codes.chroma[c]);
    }
    return codes;
}

std::size_t PackedCodes::largestRank() const {
    std::size_t largest = 0;
    for (const Texel& texel : texels_) largest = std::max<std::size_t>(largest, texel.rank);
    return largest;
}

}  // namespace abrdf
