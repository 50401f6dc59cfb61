// SPDX-License-Identifier: BSD-3-Clause
//
// `rbf`: radial basis functions phi(r) = r with a constant over all samples, r the distance of
// pairs as points on the product of two unit spheres. Interpolates B / cos(theta_i), each channel
// for itself. The weights depend on directions alone: one matrix for all texels.
#include "abrdf/matrix_product.h"
#include "abrdf/pair_features.h"
#include "stages/reconstruct/weighted_samples.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace abrdf {

namespace {

/// On the diagonal: two samples at one place are averaged instead of being a contradiction.
constexpr double kRidge = 1e-6;

struct Weights {
    Eigen::MatrixXd matrix;  ///< Row of an output: value = sum over samples of weight * B.
    double condition = 1;
};

Weights rbfWeights(const ReconstructionTask& task) {
    //  [ Phi  1 ] [ lambda ]   [ values ]
    //  [ 1'   0 ] [   c    ] = [   0    ]
    const std::vector<LightAndView> outputs = pairsOf(task.output);
    const Eigen::MatrixXd nodes = vectorFeatures(task.samples.directions);
    const Eigen::Index n = nodes.rows();
    Eigen::MatrixXd system = Eigen::MatrixXd::Ones(n + 1, n + 1);
    system(n, n) = 0;
    // -r is the one of the two signs that is conditionally positive definite.
    system.topLeftCorner(n, n) = -squaredDistances(nodes, nodes).cwiseSqrt();
    system.diagonal().head(n).setConstant(kRidge);
    Eigen::MatrixXd basis(static_cast<Eigen::Index>(outputs.size()), n + 1);
    basis.leftCols(n) = -squaredDistances(vectorFeatures(outputs), nodes).cwiseSqrt();
    basis.col(n).setOnes();
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(system);
    // The ridge keeps doubles far from this; directions that are no numbers do not.
    if (!(lu.rcond() >= 1e-12)) {
        throw std::invalid_argument(fmt::format(
            "the samples' directions make a singular system (reciprocal condition number {:.1e}, "
            "at least 1e-12 is needed); give each sample of the plan a direction of its own",
            lu.rcond()));
    }
    const Eigen::MatrixXd inverse = lu.inverse();
    Eigen::MatrixXd weights = product(basis, inverse.leftCols(n));
    for (Eigen::Index k = 0; k < n; ++k) {
        weights.col(k) /= boundedCosine(task.samples.directions[static_cast<std::size_t>(k)].light);
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        weights.row(static_cast<Eigen::Index>(i)) *= boundedCosine(outputs[i].light);
    }
    return {weights, 1 / lu.rcond()};
}

class RadialBasis : public Reconstructor {
  public:
    explicit RadialBasis(const Weights& weights)
        : weights_(weights.matrix.cast<float>().eval()), condition_(weights.condition) {}

    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdfs) const override {
        const std::size_t n = weights_.columns();
        const std::size_t texels = samples.size() / n;
        std::vector<float> vectors(3 * samples.size());
        for (std::size_t t = 0; t < texels; ++t) {
            for (std::size_t k = 0; k < n; ++k) {
                const Rgb c = samples[t * n + k];
                vectors[(3 * t) * n + k] = c.r;
                vectors[(3 * t + 1) * n + k] = c.g;
                vectors[(3 * t + 2) * n + k] = c.b;
            }
        }
        constexpr std::size_t kPanels = 8;  // Their products stay in a core's own cache.
        constexpr std::size_t kRows = kPanels * PackedMatrix::kPanel;
        std::vector<float> products(3 * texels * kRows);
        const std::size_t pairs = weights_.rows();
        for (std::size_t panel = 0; panel < weights_.panels(); panel += kPanels) {
            weights_.multiply(vectors, panel, std::min(kPanels, weights_.panels() - panel),
                              products.data(), kRows);
            const std::size_t first = panel * PackedMatrix::kPanel;
            const std::size_t count = std::min(kRows, pairs - first);
            for (std::size_t t = 0; t < texels; ++t) {
                const float* r = products.data() + 3 * t * kRows;
                for (std::size_t i = 0; i < count; ++i) {
                    abrdfs[t * pairs + first + i] = {r[i], r[i + kRows], r[i + 2 * kRows]};
                }
            }
        }
    }

    std::size_t texelsAtOnce() const override { return 32; }

    double multiplyAdds() const override {
        return 3 * static_cast<double>(weights_.rows() * weights_.columns());
    }

    double modelBytes() const override {
        return static_cast<double>(weights_.columns() * sizeof(Rgb));
    }

    double condition() const override { return condition_; }

  private:
    PackedMatrix weights_;
    double condition_;
};

}  // namespace

std::unique_ptr<Reconstructor> makeRadialBasis(const ReconstructionTask& task) {
    return std::make_unique<RadialBasis>(rbfWeights(task));
}

}  // namespace abrdf
