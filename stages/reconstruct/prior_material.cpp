// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_material.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/pair_features.h"
#include "abrdf/portable_math.h"
#include "color/delta_e.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

constexpr auto kFloor = static_cast<float>(kPriorFloor);
constexpr double kLeastChannel = 0.03;  ///< Of the luminance: exact zeros of a channel are noise.
constexpr float kLeastScale = 1e-30F;   ///< Of a channel that is not black.
constexpr std::array kBlends = {0.0F, 0.25F, 0.5F, 0.75F, 1.0F};

Eigen::MatrixX3d matrixOf(std::span<const Rgb> colors) {
    Eigen::MatrixX3d matrix(static_cast<Eigen::Index>(colors.size()), 3);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        matrix.row(static_cast<Eigen::Index>(i)) << static_cast<double>(colors[i].r),
            static_cast<double>(colors[i].g), static_cast<double>(colors[i].b);
    }
    return matrix;
}

/// A column a texel.
Eigen::MatrixXd luminancesOf(const std::vector<Eigen::MatrixX3d>& texels) {
    Eigen::MatrixXd luminances(texels.front().rows(), static_cast<Eigen::Index>(texels.size()));
    for (std::size_t t = 0; t < texels.size(); ++t) {
        luminances.col(static_cast<Eigen::Index>(t)) = texels[t].rowwise().sum() / 3;
    }
    return luminances;
}

/// Samples of channel c with the floor that keeps zeros from being outliers of logarithms.
Eigen::VectorXd channelSamples(const Eigen::MatrixX3d& colors, Eigen::Index c) {
    return colors.col(c).cwiseMax(kLeastChannel / 3 * colors.rowwise().sum());
}

/// How a material's texels are expected to vary about its mean, in logarithms: as random materials
/// of its classes do.
Eigen::MatrixXd covarianceOf(const PriorModel& model, const std::vector<PriorTerm>& terms) {
    constexpr double kNoise = 1e-2;
    const auto n = static_cast<Eigen::Index>(model.samples.size());
    Eigen::MatrixXd sum = kNoise * Eigen::MatrixXd::Identity(n, n);
    for (const PriorTerm& term : terms) {
        if (term.isLambert) continue;
        const PriorSpectrum& plain = model.classes[term.classIndex].spectra.front();
        sum += term.weight * plain.eigenvectors * plain.eigenvalues.asDiagonal() *
               plain.eigenvectors.transpose();
    }
    return sum;
}

}  // namespace

PriorMaterial::PriorMaterial(const PriorModel& model, std::span<const std::size_t> rowOf,
                             std::span<const Rgb> mean, const ReconstructOptions& options,
                             std::span<const Rgb> texels)
    : scaleFactor_(model.scaleFactor),
      sampleCount_(model.samples.size()),
      cap_(static_cast<float>(std::log(3 / model.scaleFactor) + 0.7)),
      rowOf_(rowOf.begin(), rowOf.end()) {
    Eigen::MatrixX3d colors = matrixOf(mean);
    const std::vector<Eigen::MatrixX3d> chosenBy = chooseModels(model, colors, texels, options);
    const Eigen::VectorXd luminance = colors.rowwise().sum() / 3;
    const double shown = choiceExposure(luminancesOf(chosenBy).reshaped());
    shownExposure_ = shown;
    const ChromaKriging kriging(model.samples, colors, chosenBy, shown);
    const PairGroups isotropic = isotropicPairs(model.outputs);
    const bool fewRows = isIsotropic(model, terms_) && !kriging.isAnisotropic();
    const std::vector<LightAndView>& outputs = fewRows ? isotropic.distinct : model.outputs;
    for (std::size_t& row : rowOf_) row = fewRows ? isotropic.rowOf[row] : row;
    rowsArePairs_ = rowOf_.size() == outputs.size();
    for (std::size_t i = 0; i < rowOf_.size(); ++i) rowsArePairs_ = rowsArePairs_ && rowOf_[i] == i;

    const PriorMap map = priorMap(model, terms_, outputs, isotropic.rowOf);
    luminance_ = LowRankMatrix(map.matrix, covarianceOf(model, terms_), options.rank);
    centerLogs(map, colors);
    chooseBlend(model, chosenBy, shown, kriging.leaveOneOut());
    // The material's own luminance at the outputs is a feature of its chroma.
    const std::vector<float>& x = logCenters_[0].output;
    Eigen::VectorXd atOutputs(static_cast<Eigen::Index>(x.size()));
    const double scale =
        scaleFactor_ * largestMean({luminance.data(), luminance.data() + luminance.size()});
    for (std::size_t i = 0; i < x.size(); ++i) {
        atOutputs(static_cast<Eigen::Index>(i)) =
            scale *
            std::max(std::exp(static_cast<double>(std::min(x[i], cap_))) - kPriorFloor, 0.0);
    }
    const Eigen::MatrixXf matrix = kriging.outputMatrix(outputs, atOutputs);
    chroma_ = LowRankMatrix(matrix, kriging.covariance(), options.rank);
    const Eigen::MatrixX3d chroma = chromaOf(colors);
    for (std::size_t c = 0; c < chromaCenters_.size(); ++c) {
        const Eigen::VectorXf own = chroma.col(static_cast<Eigen::Index>(c)).cast<float>();
        chromaCenters_[c] = centered(matrix, own.array() - own.mean());
    }
    if (!options.centered) uncenter(map);
}

void PriorMaterial::uncenter(const PriorMap& map) {
    for (Center& center : logCenters_) {
        std::ranges::fill(center.input, 0.0F);
        std::ranges::copy(map.offset, center.output.begin());
    }
    for (Center& center : chromaCenters_) {
        std::ranges::fill(center.input, 0.0F);
        std::ranges::fill(center.output, 0.0F);
    }
}

/// Terms, and what restores clipped samples: of `colors` too, and of the texels that are returned.
std::vector<Eigen::MatrixX3d> PriorMaterial::chooseModels(const PriorModel& model,
                                                          Eigen::MatrixX3d& colors,
                                                          std::span<const Rgb> texels,
                                                          const ReconstructOptions& options) {
    std::vector<Eigen::MatrixX3d> chosenBy;
    for (std::size_t first = 0; first < texels.size(); first += sampleCount_) {
        chosenBy.push_back(matrixOf(texels.subspan(first, sampleCount_)));
    }
    if (chosenBy.empty()) chosenBy = {colors};
    terms_ = chooseTerms(model, luminancesOf(chosenBy), options.noise);
    if (options.saturated > 0) {
        const CensoredSamples censored(model, terms_, options.saturated);
        colors = censored.restored(colors);
        for (Eigen::MatrixX3d& texel : chosenBy) texel = censored.restored(texel);
        terms_ = chooseTerms(model, luminancesOf(chosenBy), options.noise);
        censored_.emplace(model, terms_, options.saturated);
    }
    return chosenBy;
}

void PriorMaterial::centerLogs(const PriorMap& map, const Eigen::MatrixX3d& colors) {
    for (std::size_t i = 0; i < logCenters_.size(); ++i) {
        const Eigen::VectorXd values =
            i == 0 ? Eigen::VectorXd(colors.rowwise().sum() / 3)
                   : channelSamples(colors, static_cast<Eigen::Index>(i) - 1);
        Eigen::VectorXf z = Eigen::VectorXf::Zero(values.size());
        const double scale =
            scaleFactor_ * largestMean({values.data(), values.data() + values.size()});
        if (scale > 0) {
            z = (values.array().max(0.0) / scale + kPriorFloor).log().cast<float>();
        }
        logCenters_[i] = centered(map.matrix, z);
        for (std::size_t row = 0; row < logCenters_[i].output.size(); ++row) {
            logCenters_[i].output[row] += map.offset(static_cast<Eigen::Index>(row));
        }
    }
}

PriorMaterial::Center PriorMaterial::centered(const Eigen::MatrixXf& matrix,
                                              const Eigen::VectorXf& input) {
    const Eigen::VectorXf output = matrix * input;
    return {{input.data(), input.data() + input.size()},
            {output.data(), output.data() + output.size()}};
}

/// Chroma by kriging and chroma of channels that are estimated like luminance: the blend by which
/// the samples predict one another best.
void PriorMaterial::chooseBlend(const PriorModel& model,
                                const std::vector<Eigen::MatrixX3d>& texels, double shown,
                                const std::vector<Eigen::MatrixX3d>& kriged) {
    std::vector<Eigen::MatrixX3d> ofChannels(texels.size());
    std::vector<Eigen::VectorXd> predicted(texels.size());
    forEachImage(texels.size(), [&](std::size_t t) {
        ofChannels[t].resize(texels[t].rows(), 3);
        for (Eigen::Index c = 0; c < 3; ++c) {
            ofChannels[t].col(c) =
                leaveOneOut(model, terms_, channelSamples(texels[t], c)).cwiseMax(1e-9 / shown);
        }
        ofChannels[t] = normalizedChroma(ofChannels[t]);
        predicted[t] = leaveOneOut(model, terms_, texels[t].rowwise().sum() / 3);
    });
    const auto chroma = [&](std::size_t t, double share) {
        return Eigen::MatrixX3d((1 - share) * kriged[t] + share * ofChannels[t]);
    };
    double best = -1;
    for (const float blend : kBlends) {
        double error = 0;
        for (std::size_t t = 0; t < texels.size(); ++t) {
            const Eigen::ArrayXd luminance = texels[t].rowwise().sum() / 3;
            error += meanDeltaE(chroma(t, static_cast<double>(blend)).array().colwise() * luminance,
                                texels[t], shown);
        }
        error /= static_cast<double>(texels.size());
        if (best >= 0 && error >= best - 1e-9) continue;
        best = error;
        blend_ = blend;
    }
    leaveOneOutError_ = 0;
    for (std::size_t t = 0; t < texels.size(); ++t) {
        leaveOneOutError_ += meanDeltaE(chroma(t, static_cast<double>(blend_)).array().colwise() *
                                            predicted[t].array(),
                                        texels[t], shown) /
                             static_cast<double>(texels.size());
    }
}

void PriorMaterial::addTexel(std::span<const Rgb> samples, Inputs& inputs) const {
    const Eigen::MatrixX3d measured = matrixOf(samples);
    const Eigen::MatrixX3d colors = censored_ ? censored_->restored(measured) : measured;
    TexelScale scale;
    const auto addLogs = [&](const Eigen::VectorXd& values, std::size_t which) {
        std::vector<float>& logs = inputs.logs[which];
        const float* center = logCenters_[which].input.data();
        const double s = scaleFactor_ * largestMean({values.data(), values.data() + values.size()});
        const auto inverse = static_cast<float>(s > 0 ? 1 / s : 0);
        for (const double value : values) {
            const float relative = std::max(static_cast<float>(value) * inverse, 0.0F);
            logs.push_back(portable::log(relative + kFloor) - *center++);
        }
        return static_cast<float>(s);
    };
    scale.luminance = addLogs(colors.rowwise().sum() / 3, 0);
    const Eigen::MatrixX3d chroma = chromaOf(colors);
    const Eigen::RowVector3d mean = chroma.colwise().mean();
    std::array<float, 3> channel{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto column = static_cast<Eigen::Index>(c);
        if (blend_ > 0) channel[c] = addLogs(channelSamples(colors, column), c + 1);
        channel[c] = colors.col(column).maxCoeff() > 0 ? std::max(channel[c], kLeastScale) : 0;
        if (c == 2) break;
        scale.meanChroma[c] = static_cast<float>(mean(column));
        for (Eigen::Index i = 0; i < chroma.rows(); ++i) {
            inputs.chroma[c].push_back(static_cast<float>(chroma(i, column) - mean(column)) -
                                       chromaCenters_[c].input[static_cast<std::size_t>(i)]);
        }
    }
    scale.channel = {channel[0], channel[1], channel[2]};
    inputs.scales.push_back(scale);
}

/// Rows of some panels: x of each texel's luminance and channels, and its chroma about its mean.
struct PriorMaterial::Products {
    std::size_t stride = 0;
    std::array<std::vector<float>, 4> logs;
    std::array<std::vector<float>, 2> chroma;
    std::size_t firstRow = 0;
};

void PriorMaterial::multiply(const Inputs& inputs, std::size_t firstPanel, std::size_t panels,
                             Products& products) const {
    products.stride = panels * PackedMatrix::kPanel;
    products.firstRow = firstPanel * PackedMatrix::kPanel;
    const auto apply = [&](const LowRankMatrix& matrix, const std::vector<float>& vectors,
                           std::vector<float>& result) {
        result.resize(inputs.scales.size() * products.stride);
        matrix.multiply(vectors, firstPanel, panels, result.data(), products.stride);
    };
    for (std::size_t i = 0; i < (blend_ > 0 ? 4 : 1); ++i) {
        apply(luminance_, inputs.logs[i], products.logs[i]);
    }
    for (std::size_t c = 0; c < (blend_ < 1 ? 2 : 0); ++c) {
        apply(chroma_, inputs.chroma[c], products.chroma[c]);
    }
}

PriorRows PriorMaterial::rowsOf(const Products& products, const TexelScale& scale,
                                std::size_t texel) const {
    PriorRows rows;
    const auto pieceOf = [&](const std::vector<float>& product) {
        return product.empty() ? nullptr : product.data() + texel * products.stride;
    };
    for (std::size_t i = 0; i < rows.logs.size(); ++i) {
        rows.logs[i] = pieceOf(products.logs[i]);
        rows.logCenters[i] = logCenters_[i].output.data() + products.firstRow;
    }
    for (std::size_t c = 0; c < rows.chroma.size(); ++c) {
        rows.chroma[c] = pieceOf(products.chroma[c]);
        rows.chromaCenters[c] = chromaCenters_[c].output.data() + products.firstRow;
    }
    rows.meanChroma = scale.meanChroma;
    rows.luminance = scale.luminance;
    rows.channel = scale.channel;
    rows.cap = cap_;
    rows.floor = kFloor;
    rows.blend = blend_;
    return rows;
}

void PriorMaterial::reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdfs) const {
    Inputs inputs;
    for (std::size_t first = 0; first < samples.size(); first += sampleCount_) {
        addTexel(samples.subspan(first, sampleCount_), inputs);
    }
    for (std::vector<float>& logs : inputs.logs) logs = luminance_.reduced(logs);
    for (std::vector<float>& chroma : inputs.chroma) chroma = chroma_.reduced(chroma);

    const std::size_t texels = inputs.scales.size();
    const std::size_t rows = luminance_.rows();
    // Where each pair has a row of its own they are written in place.
    std::vector<Rgb> shared(rowsArePairs_ ? 0 : texels * rows);
    Rgb* colors = rowsArePairs_ ? abrdfs.data() : shared.data();
    Products products;
    constexpr std::size_t kPanels = 8;  // Their products stay in a core's own cache.
    for (std::size_t panel = 0; panel < luminance_.panels(); panel += kPanels) {
        multiply(inputs, panel, std::min(kPanels, luminance_.panels() - panel), products);
        const std::size_t first = products.firstRow;
        const std::size_t count = std::min(products.stride, rows - first);
        for (std::size_t t = 0; t < texels; ++t) {
            priorColors(rowsOf(products, inputs.scales[t], t), count, colors + t * rows + first);
        }
    }
    const std::size_t pairs = rowOf_.size();
    for (std::size_t t = 0; !rowsArePairs_ && t < texels; ++t) {
        for (std::size_t i = 0; i < pairs; ++i) {
            abrdfs[t * pairs + i] = shared[t * rows + rowOf_[i]];
        }
    }
}

double PriorMaterial::multiplyAdds() const {
    return (blend_ > 0 ? 4 : 1) * luminance_.multiplyAdds() +
           (blend_ < 1 ? 2 : 0) * chroma_.multiplyAdds();
}

double PriorMaterial::modelBytes() const {
    const double vectors = (blend_ > 0 ? 4 : 1) * static_cast<double>(luminance_.vectorSize()) +
                           (blend_ < 1 ? 2 : 0) * static_cast<double>(chroma_.vectorSize());
    const double scales = blend_ > 0 ? 6 : 3;
    return sizeof(float) * (vectors + scales);
}

}  // namespace abrdf
