// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/texel_model.h"

#include "abrdf/pair_features.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace abrdf {

namespace {

constexpr std::size_t kPanels = 8;  ///< Their products stay in a core's own cache.

/// Vectors of some texels, cut to a rank; `from` itself where that is all of it.
std::span<const float> gathered(const std::vector<float>& from, std::size_t stride,
                                std::span<const std::size_t> texels, std::size_t rank,
                                std::vector<float>& buffer) {
    if (rank == stride && texels.size() * stride == from.size()) return from;
    buffer.clear();
    for (const std::size_t t : texels) {
        const auto begin = from.begin() + static_cast<std::ptrdiff_t>(t * stride);
        buffer.insert(buffer.end(), begin, begin + static_cast<std::ptrdiff_t>(rank));
    }
    return buffer;
}

float dot(const PackedMatrix& matrix, std::size_t row, const float* vector, std::size_t rank) {
    float sum = 0;
    for (std::size_t k = 0; k < rank; ++k) sum += matrix.at(row, k) * vector[k];
    return sum;
}

}  // namespace

TexelModel::TexelModel(TexelBasis basis, TexelRule rule, std::vector<std::size_t> rowOf,
                       std::span<const LightAndView> pairs)
    : rule_(rule), whole_(partOf(std::move(basis), std::move(rowOf))) {
    assert(pairs.size() == whole_.rowOf.size());
    for (const LightAndView& pair : pairs) {
        cosines_.push_back(static_cast<float>(std::cos(pair.light.theta)));
    }
}

TexelModel::Part TexelModel::partOf(TexelBasis basis, std::vector<std::size_t> rowOf) {
    Part part{std::move(basis), std::move(rowOf), false};
    part.rowsArePairs = part.rowOf.size() == part.basis.rows();
    for (std::size_t i = 0; i < part.rowOf.size(); ++i) {
        part.rowsArePairs = part.rowsArePairs && part.rowOf[i] == i;
    }
    return part;
}

void TexelModel::addSmall(TexelBasis small) {
    assert(small.rows() == whole_.basis.rows());
    small_ = partOf(std::move(small), whole_.rowOf);
}

void TexelModel::addIsotropic(std::span<const LightAndView> pairs) {
    const PairGroups twins = isotropicPairs(pairs);
    const TexelBasis& basis = small_ ? small_->basis : whole_.basis;
    std::vector<std::size_t> groupOf(basis.rows());
    for (std::size_t p = 0; p < pairs.size(); ++p) groupOf[whole_.rowOf[p]] = twins.rowOf[p];
    const auto columns = std::min<std::size_t>(kIsotropicRank, basis.luminance.columns());
    isotropic_ = partOf(basis.groupMeans(groupOf, twins.distinct.size(), columns), twins.rowOf);
}

TexelModel::Part TexelModel::restricted(const Part& part, std::span<const std::size_t> pairs) {
    std::vector<std::size_t> rows;
    for (const std::size_t pair : pairs) rows.push_back(part.rowOf[pair]);
    std::vector<std::size_t> own(rows.size());
    std::iota(own.begin(), own.end(), std::size_t{0});
    return partOf(part.basis.atRows(rows), std::move(own));
}

TexelModel TexelModel::restricted(std::span<const std::size_t> pairs) const {
    TexelModel result;
    result.rule_ = rule_;
    result.whole_ = restricted(whole_, pairs);
    if (small_) result.small_ = restricted(*small_, pairs);
    if (isotropic_) result.isotropic_ = restricted(*isotropic_, pairs);
    for (const std::size_t pair : pairs) result.cosines_.push_back(cosines_[pair]);
    return result;
}

const TexelModel::Part& TexelModel::partOf(std::size_t rank) const {
    if (isotropic_ && rank == kIsotropicRank) return *isotropic_;
    return small_ && rank < columns() ? *small_ : whole_;
}

void TexelModel::evaluate(const TexelCodes& codes, std::span<Rgb> abrdfs) const {
    std::vector<std::uint16_t> ranks = codes.ranks;
    std::ranges::sort(ranks);
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    std::vector<std::size_t> texels;
    for (const std::uint16_t rank : ranks) {
        texels.clear();
        for (std::size_t t = 0; t < codes.count(); ++t) {
            if (codes.ranks[t] == rank) texels.push_back(t);
        }
        if (rank != kConstantRank) {
            evaluate(partOf(rank), codes, texels, rank, abrdfs);
            continue;
        }
        for (const std::size_t t : texels) {
            for (std::size_t i = 0; i < pairs(); ++i) {
                abrdfs[t * pairs() + i] = cosines_[i] * codes.scales[t].channel;
            }
        }
    }
}

TexelRows TexelModel::rowsOf(const Part& part, const TexelScale& scale,
                             std::size_t firstRow) const {
    TexelRows rows;
    const auto pieceOf = [&](const std::vector<float>& center) {
        return center.empty() ? nullptr : center.data() + firstRow;
    };
    for (std::size_t i = 0; i < 4; ++i) rows.logCenters[i] = pieceOf(part.basis.logCenters[i]);
    for (std::size_t c = 0; c < 2; ++c) {
        rows.chromaCenters[c] = pieceOf(part.basis.chromaCenters[c]);
    }
    rows.meanChroma = scale.meanChroma;
    rows.luminance = scale.luminance;
    rows.channel = scale.channel;
    rows.cap = rule_.cap;
    rows.floor = rule_.floor;
    rows.blend = rule_.blend;
    return rows;
}

/// What some texels become at rows [firstRow, firstRow + rows): products of each kind of vector.
struct TexelModel::Products {
    std::size_t stride = 0;
    std::size_t firstRow = 0;
    std::array<std::vector<float>, 6> of;  ///< Logs, then chroma.

    const float* piece(std::size_t which, std::size_t texel) const {
        return of[which].empty() ? nullptr : of[which].data() + texel * stride;
    }
};

void TexelModel::multiply(const Part& part, std::span<const std::span<const float>, 6> vectors,
                          std::size_t rank, std::size_t firstPanel, Products& products) {
    const std::size_t panels = std::min(kPanels, part.basis.luminance.panels() - firstPanel);
    products.stride = panels * PackedMatrix::kPanel;
    products.firstRow = firstPanel * PackedMatrix::kPanel;
    for (std::size_t which = 0; which < vectors.size(); ++which) {
        if (vectors[which].empty()) continue;
        products.of[which].resize(vectors[which].size() / rank * products.stride);
        const PackedMatrix& matrix = which < 4 ? part.basis.luminance : part.basis.chroma;
        matrix.multiplyFirst(rank, vectors[which], firstPanel, panels, products.of[which].data(),
                             products.stride);
    }
}

void TexelModel::evaluate(const Part& part, const TexelCodes& codes,
                          std::span<const std::size_t> texels, std::size_t rank,
                          std::span<Rgb> abrdfs) const {
    std::array<std::vector<float>, 6> cut;
    std::array<std::span<const float>, 6> vectors;
    for (std::size_t i = 0; i < rule_.logVectors(); ++i) {
        vectors[i] = gathered(codes.logs[i], codes.stride, texels, rank, cut[i]);
    }
    for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) {
        vectors[4 + c] = gathered(codes.chroma[c], codes.stride, texels, rank, cut[4 + c]);
    }
    const std::size_t rows = part.basis.rows();
    // Where each pair has a row of its own, and all texels are meant, they are written in place.
    const bool inPlace = part.rowsArePairs && texels.size() == codes.count();
    std::vector<Rgb> shared(inPlace ? 0 : texels.size() * rows);
    Rgb* colors = inPlace ? abrdfs.data() : shared.data();
    Products products;
    for (std::size_t panel = 0; panel < part.basis.luminance.panels(); panel += kPanels) {
        multiply(part, vectors, rank, panel, products);
        const std::size_t first = products.firstRow;
        for (std::size_t k = 0; k < texels.size(); ++k) {
            TexelRows piece = rowsOf(part, codes.scales[texels[k]], first);
            for (std::size_t i = 0; i < 4; ++i) piece.logs[i] = products.piece(i, k);
            for (std::size_t c = 0; c < 2; ++c) piece.chroma[c] = products.piece(4 + c, k);
            texelColors(piece, std::min(products.stride, rows - first), colors + k * rows + first);
        }
    }
    for (std::size_t k = 0; !inPlace && k < texels.size(); ++k) {
        for (std::size_t i = 0; i < pairs(); ++i) {
            abrdfs[texels[k] * pairs() + i] = shared[k * rows + part.rowOf[i]];
        }
    }
}

Rgb TexelModel::at(const TexelCodes& codes, std::size_t texel, std::size_t pair) const {
    const std::size_t rank = codes.ranks[texel];
    const TexelScale& scale = codes.scales[texel];
    if (rank == kConstantRank) return cosines_[pair] * scale.channel;
    const Part& part = partOf(rank);
    const std::size_t row = part.rowOf[pair];
    std::array<float, 6> products{};
    TexelRows one = rowsOf(part, scale, row);
    for (std::size_t i = 0; i < rule_.logVectors(); ++i) {
        products[i] = dot(part.basis.luminance, row, &codes.logs[i][texel * codes.stride], rank);
        one.logs[i] = &products[i];
    }
    for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) {
        products[4 + c] = dot(part.basis.chroma, row, &codes.chroma[c][texel * codes.stride], rank);
        one.chroma[c] = &products[4 + c];
    }
    return slowTexelColor(one, 0);
}

double TexelModel::multiplyAdds(std::size_t rank) const {
    if (rank == kConstantRank) return 3 * static_cast<double>(pairs());
    return static_cast<double>(rule_.vectors() * partOf(rank).basis.rows() * rank);
}

double TexelModel::bytes(std::size_t rank) const {
    if (rank == kConstantRank) return 3 * sizeof(float);
    const std::size_t scales = rule_.blend > 0 ? 6 : 3;
    return static_cast<double>(sizeof(float) * (scales + rule_.vectors() * rank));
}

}  // namespace abrdf
