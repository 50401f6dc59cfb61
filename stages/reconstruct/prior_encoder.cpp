// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_encoder.h"

#include "abrdf/logarithms.h"
#include "abrdf/prior_model.h"
#include "stages/reconstruct/prior_chroma.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abrdf {

namespace {

constexpr auto kFloor = static_cast<float>(kPriorFloor);
constexpr double kLeastChannel = 0.03;  ///< Of the luminance: exact zeros of a channel are noise.
constexpr float kLeastScale = 1e-30F;   ///< Of a channel that is not black.

double scaleOf(const Eigen::VectorXd& values, double scaleFactor) {
    return scaleFactor * largestMean({values.data(), values.data() + values.size()});
}

}  // namespace

Eigen::MatrixX3d matrixOf(std::span<const Rgb> colors) {
    Eigen::MatrixX3d matrix(static_cast<Eigen::Index>(colors.size()), 3);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        matrix.row(static_cast<Eigen::Index>(i)) << static_cast<double>(colors[i].r),
            static_cast<double>(colors[i].g), static_cast<double>(colors[i].b);
    }
    return matrix;
}

Eigen::VectorXd channelSamples(const Eigen::MatrixX3d& colors, Eigen::Index c) {
    return colors.col(c).cwiseMax(kLeastChannel / 3 * colors.rowwise().sum());
}

PriorEncoder::PriorEncoder(double scaleFactor, Centers centers, TexelRule rule,
                           std::optional<CensoredSamples> censored)
    : scaleFactor_(scaleFactor),
      centers_(std::move(centers)),
      rule_(rule),
      censored_(std::move(censored)) {}

PriorEncoder::Centers PriorEncoder::centersOf(const Eigen::MatrixX3d& colors, double scaleFactor) {
    Centers centers;
    for (std::size_t i = 0; i < centers.logs.size(); ++i) {
        const Eigen::VectorXd values =
            i == 0 ? Eigen::VectorXd(colors.rowwise().sum() / 3)
                   : channelSamples(colors, static_cast<Eigen::Index>(i) - 1);
        centers.logs[i] = Eigen::VectorXf::Zero(values.size());
        const double scale = scaleOf(values, scaleFactor);
        if (scale > 0) {
            centers.logs[i] =
                (values.array().max(0.0) / scale + kPriorFloor).log().cast<float>().matrix();
        }
    }
    const Eigen::MatrixX3d chroma = chromaOf(colors);
    for (std::size_t c = 0; c < centers.chroma.size(); ++c) {
        const Eigen::VectorXf own = chroma.col(static_cast<Eigen::Index>(c)).cast<float>();
        centers.chroma[c] = own.array() - own.mean();
    }
    return centers;
}

void PriorEncoder::addTexel(const Eigen::MatrixX3d& colors, TexelCodes& codes) const {
    TexelScale scale;
    const auto addLogs = [&](const Eigen::VectorXd& values, std::size_t which) {
        std::vector<float>& logs = codes.logs[which];
        const std::size_t begin = logs.size();
        logs.resize(begin + static_cast<std::size_t>(values.size()));
        Eigen::Map<Eigen::ArrayXf> own(logs.data() + begin, values.size());
        const double s = scaleOf(values, scaleFactor_);
        const auto inverse = static_cast<float>(s > 0 ? 1 / s : 0);
        own = (values.array().cast<float>() * inverse).max(0.0F) + kFloor;
        takeLogarithms(std::span(logs).subspan(begin));
        own -= centers_.logs[which].array();
        return static_cast<float>(s);
    };
    scale.luminance = addLogs(colors.rowwise().sum() / 3, 0);
    const Eigen::MatrixX3d chroma = chromaOf(colors);
    const Eigen::RowVector3d mean = chroma.colwise().mean();
    std::array<float, 3> channel{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto column = static_cast<Eigen::Index>(c);
        if (rule_.blend > 0) channel[c] = addLogs(channelSamples(colors, column), c + 1);
        channel[c] = colors.col(column).maxCoeff() > 0 ? std::max(channel[c], kLeastScale) : 0;
        if (c == 2) break;
        scale.meanChroma[c] = static_cast<float>(mean(column));
        if (rule_.blend >= 1) continue;
        const Eigen::VectorXf own =
            (chroma.col(column).array() - mean(column)).cast<float>().matrix() - centers_.chroma[c];
        codes.chroma[c].insert(codes.chroma[c].end(), own.begin(), own.end());
    }
    scale.channel = {channel[0], channel[1], channel[2]};
    codes.scales.push_back(scale);
}

TexelCodes PriorEncoder::encode(std::span<const Rgb> samples, std::vector<Rgb>& restored) const {
    TexelCodes codes;
    codes.stride = static_cast<std::size_t>(centers_.logs[0].size());
    restored.assign(samples.begin(), samples.end());
    for (std::size_t first = 0; first < samples.size(); first += codes.stride) {
        Eigen::MatrixX3d colors = matrixOf(samples.subspan(first, codes.stride));
        if (censored_) {
            colors = censored_->restored(colors);
            for (std::size_t k = 0; k < codes.stride; ++k) {
                const Eigen::RowVector3f color =
                    colors.row(static_cast<Eigen::Index>(k)).cast<float>();
                restored[first + k] = {color(0), color(1), color(2)};
            }
        }
        addTexel(colors, codes);
    }
    codes.ranks.assign(codes.count(), static_cast<std::uint16_t>(codes.stride));
    return codes;
}

}  // namespace abrdf
