// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_chroma.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/matrix_product.h"
#include "abrdf/pair_features.h"
#include "color/delta_e.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abrdf {

namespace {

constexpr std::array kVectorShares = {0.0, 0.5};
constexpr std::array kNoises = {1e-3, 1e-2, 1e-1};

/// Of ln(luminance / median + 0.01) among the features.
constexpr double kLightnessWeight = 0.35;

/// As the choice of luminance: a kernel this much (relatively) worse has 1/e the weight.
constexpr double kSharpness = 0.06;
constexpr double kLeastWeight = 0.02;
constexpr double kEqualDeltaE = 1e-3;

double median(Eigen::VectorXd values) {
    double* const end = values.data() + values.size();
    double* const middle = values.data() + values.size() / 2;
    std::nth_element(values.data(), middle, end);
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.data(), middle)) / 2;
}

/// exp(-|w_i - w_i'|^2 / 2 - |w_o - w_o'|^2 / 2).
Eigen::MatrixXd vectorKernel(const std::vector<LightAndView>& a,
                             const std::vector<LightAndView>& b) {
    return (squaredDistances(vectorFeatures(a), vectorFeatures(b)).array() / -2).exp();
}

Rgb rgbOf(const Eigen::RowVector3d& color) {
    return {static_cast<float>(color(0)), static_cast<float>(color(1)),
            static_cast<float>(color(2))};
}

}  // namespace

Eigen::MatrixX3d chromaOf(const Eigen::MatrixX3d& colors) {
    Eigen::MatrixX3d chroma(colors.rows(), 3);
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    Eigen::Index lit = 0;
    for (Eigen::Index i = 0; i < colors.rows(); ++i) {
        const double luminance = colors.row(i).sum() / 3;
        if (luminance <= 0) continue;
        chroma.row(i) = colors.row(i) / luminance;
        sum += chroma.row(i);
        ++lit;
    }
    const Eigen::RowVector3d mean =
        lit > 0 ? Eigen::RowVector3d(sum / static_cast<double>(lit)) : Eigen::RowVector3d::Ones();
    for (Eigen::Index i = 0; i < colors.rows(); ++i) {
        if (colors.row(i).sum() <= 0) chroma.row(i) = mean;
    }
    return chroma;
}

Eigen::MatrixX3d normalizedChroma(const Eigen::MatrixX3d& chroma) {
    Eigen::MatrixX3d result = chroma.cwiseMax(0);
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
        result.row(i) *= 3 / std::max(result.row(i).sum(), 1e-9);
    }
    return result;
}

double meanDeltaE(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b, double exposure) {
    double sum = 0;
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        sum += deltaE76(labFromLinearRec709(rgbOf(exposure * a.row(i))),
                        labFromLinearRec709(rgbOf(exposure * b.row(i))));
    }
    return sum / static_cast<double>(a.rows());
}

ChromaKriging::ChromaKriging(const std::vector<LightAndView>& pairs, const Eigen::MatrixX3d& colors,
                             const std::vector<Eigen::MatrixX3d>& texels, double exposure)
    : pairs_(pairs) {
    const Eigen::VectorXd luminance = colors.rowwise().sum() / 3;
    medianLuminance_ = std::max(median(luminance), std::numeric_limits<double>::min());
    features_ = features(pairs, luminance);
    const Eigen::Index n = features_.rows();
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd distances = squaredDistances(features_, features_);
    const Eigen::MatrixXd vectors = vectorKernel(pairs, pairs);

    std::vector<Member> members;
    for (const Shape shape : {kExponential, kMatern, kWideMatern}) {
        for (const double share : kVectorShares) {
            for (const double noise : kNoises) members.push_back({shape, share, noise, {}, {}, 0});
        }
    }
    forEachImage(members.size(), [&](std::size_t i) {
        Member& member = members[i];
        const Eigen::MatrixXd covariance =
            (kernel(member.shape, distances) + member.vectorShare * vectors) /
                (1 + member.vectorShare) +
            member.noise * identity;
        member.inverse = covariance.llt().solve(identity);
        predict(member, texels, exposure);
    });
    mix(std::move(members));
}

void ChromaKriging::predict(Member& member, const std::vector<Eigen::MatrixX3d>& texels,
                            double exposure) const {
    for (const Eigen::MatrixX3d& colors : texels) {
        const Eigen::MatrixX3d chroma = chromaOf(colors);
        const Eigen::RowVector3d mean = chroma.colwise().mean();
        const Eigen::MatrixX3d a = member.inverse * (chroma.rowwise() - mean);
        member.leaveOneOut.push_back(normalizedChroma(
            chroma - Eigen::MatrixX3d(a.array().colwise() / member.inverse.diagonal().array())));
        const Eigen::ArrayXd luminance = colors.rowwise().sum() / 3;
        member.error +=
            meanDeltaE(member.leaveOneOut.back().array().colwise() * luminance, colors, exposure) /
            static_cast<double>(texels.size());
    }
}

void ChromaKriging::mix(std::vector<Member> members) {
    const double least = std::ranges::min_element(members, {}, &Member::error)->error;
    const auto weight = [&](const Member& member) {
        return std::exp(-(member.error - least) / (kSharpness * (least + kEqualDeltaE)));
    };
    double sum = 0;
    for (const Member& member : members) sum += weight(member);
    std::erase_if(members, [&](const Member& m) { return weight(m) < kLeastWeight * sum; });
    sum = 0;
    for (const Member& member : members) sum += weight(member);

    const Eigen::Index n = features_.rows();
    ofShape_.assign(kShapes, {});
    leaveOneOut_.assign(members.front().leaveOneOut.size(), Eigen::MatrixX3d::Zero(n, 3));
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(n, n);
    const auto add = [&](Eigen::MatrixXd& target, double factor, const Eigen::MatrixXd& matrix) {
        if (target.size() == 0) target = Eigen::MatrixXd::Zero(n, n);
        target += factor * matrix;
    };
    for (const Member& member : members) {
        const double share = weight(member) / sum / (1 + member.vectorShare);
        add(ofShape_[member.shape], share, member.inverse);
        if (member.vectorShare > 0) add(ofVectors_, share * member.vectorShare, member.inverse);
        for (std::size_t t = 0; t < leaveOneOut_.size(); ++t) {
            leaveOneOut_[t] += weight(member) / sum * member.leaveOneOut[t];
        }
        inverse += weight(member) / sum * member.inverse;
        weights_.push_back(weight(member) / sum);
        inverses_.push_back(member.inverse);
    }
    covariance_ = inverse.llt().solve(Eigen::MatrixXd::Identity(n, n));
}

Eigen::MatrixXd ChromaKriging::leaveOut(const SampleBlocks& blocks) const {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(features_.rows(), features_.rows());
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        matrix += weights_[i] * leaveOutMatrix(inverses_[i], blocks);
    }
    return matrix;
}

/// Exponential of reach 6; Matern 3/2 of reach 0.8 and 1.6.
Eigen::MatrixXd ChromaKriging::kernel(Shape shape, const Eigen::MatrixXd& squaredDistances) {
    const Eigen::ArrayXXd r = squaredDistances.array().sqrt();
    if (shape == kExponential) return (-r / 6).exp();
    const Eigen::ArrayXXd q = std::sqrt(3.0) / (shape == kMatern ? 0.8 : 1.6) * r;
    return (1 + q) * (-q).exp();
}

Eigen::MatrixXd ChromaKriging::features(const std::vector<LightAndView>& pairs,
                                        const Eigen::VectorXd& luminance) const {
    Eigen::MatrixXd result(static_cast<Eigen::Index>(pairs.size()), 5);
    result << isotropicFeatures(pairs),
        kLightnessWeight * (luminance.array().max(0.0) / medianLuminance_ + 1e-2).log().matrix();
    return result;
}

Eigen::MatrixXf ChromaKriging::outputMatrix(const std::vector<LightAndView>& outputs,
                                            const Eigen::VectorXd& outputLuminance,
                                            const Eigen::MatrixXd* vectors) const {
    const auto rightOf = [&](const Eigen::MatrixXd& matrix) {
        return vectors != nullptr && matrix.size() > 0 ? product(matrix, *vectors) : matrix;
    };
    std::array<Eigen::MatrixXd, kShapes> ofShape;
    std::ranges::transform(ofShape_, ofShape.begin(), rightOf);
    const Eigen::MatrixXd ofVectors = rightOf(ofVectors_);
    Eigen::MatrixXf result =
        Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(outputs.size()),
                              vectors != nullptr ? vectors->cols() : features_.rows());
    // Some rows at a time: what is made on the way stays in a core's cache.
    constexpr std::size_t kRowsAtOnce = 128;
    forEachTexelBlock(outputs.size(), kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
        const auto first = static_cast<Eigen::Index>(begin);
        const auto count = static_cast<Eigen::Index>(end - begin);
        const std::vector<LightAndView> own(outputs.begin() + static_cast<std::ptrdiff_t>(begin),
                                            outputs.begin() + static_cast<std::ptrdiff_t>(end));
        auto rows = result.middleRows(first, count);
        const Eigen::MatrixXd distances =
            squaredDistances(features(own, outputLuminance.segment(first, count)), features_);
        for (const Shape shape : {kExponential, kMatern, kWideMatern}) {
            if (ofShape[shape].size() == 0) continue;
            rows += product(kernel(shape, distances), ofShape[shape]).cast<float>();
        }
        if (isAnisotropic()) rows += product(vectorKernel(own, pairs_), ofVectors).cast<float>();
    });
    return result;
}

}  // namespace abrdf
