// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/microfacet_fit.h"

#include "stages/reconstruct/double_lobe.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace abrdf {

namespace {

/// ln of both roughnesses, azimuth, ln of grazing.
using Shape = Eigen::Vector4d;

const double kLeastRoughness = std::log(0.01);
const double kMostGrazing = std::log(50.0);

Shape bounded(Shape shape) {
    shape(0) = std::clamp(shape(0), kLeastRoughness, 0.0);
    shape(1) = std::clamp(shape(1), kLeastRoughness, 0.0);
    shape(3) = std::clamp(shape(3), 0.0, kMostGrazing);
    return shape;
}

MicrofacetFit fitOf(const Shape& shape) {
    return {{}, {}, std::exp(shape(0)), std::exp(shape(1)), shape(2), std::exp(shape(3))};
}

/// The lobe that reconstructs.
struct FloatLobe : PreparedLobe {
    using Pair = LocalPair;
    using PreparedLobe::PreparedLobe;
};

template <class Shine>
typename Shine::Pair localPair(const LightAndView& pair) {
    if constexpr (std::is_same_v<Shine, DoubleLobe>) {
        return pair;
    } else {
        return {Imath::V3f(vectorFromDirection(pair.light)),
                Imath::V3f(vectorFromDirection(pair.view))};
    }
}

template <class Shine>
Shine shineOf(const MicrofacetFit& fit) {
    if constexpr (std::is_same_v<Shine, DoubleLobe>) {
        return DoubleLobe(fit);
    } else {
        return Shine(fit.lobe());
    }
}

/// Shine: FloatLobe or DoubleLobe.
template <class Shine>
class Fitting {
  public:
    Fitting(const std::vector<LightAndView>& pairs, std::span<const Rgb> values) {
        const auto n = static_cast<Eigen::Index>(pairs.size());
        colors_.resize(n, 3);
        cosines_.resize(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto& [light, view] = pairs[static_cast<std::size_t>(i)];
            const Rgb& c = values[static_cast<std::size_t>(i)];
            colors_.row(i) << static_cast<double>(c.r), static_cast<double>(c.g),
                static_cast<double>(c.b);
            cosines_(i) = std::max(std::cos(light.theta), 0.0);
            local_.push_back(localPair<Shine>({light, view}));
        }
        colors_ = colors_.cwiseMax(0);
        // d(B^1/3) = B^-2/3 / 3 dB; a tenth of the mean keeps the darkest from ruling.
        const double mean = colors_.mean();
        weights_ = ((colors_.rowwise().sum().array() / 3 + 0.1 * mean) / mean).pow(-2.0 / 3);
        isBlack_ = !(mean > 0);
        unit_ = mean;
    }

    bool isBlack() const { return isBlack_; }

    /// Weighted residuals of the best colours for a shape; these, where asked for.
    Eigen::VectorXd residuals(const Shape& shape, MicrofacetFit* fit = nullptr) const {
        const Shine lobe = shineOf<Shine>(fitOf(shape));
        const Eigen::Index n = colors_.rows();
        Eigen::MatrixX2d basis(n, 2);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double factor =
                static_cast<double>(lobe.reflectanceFactor(local_[static_cast<std::size_t>(i)]));
            basis.row(i) << cosines_(i), cosines_(i) * factor;
        }
        basis.array().colwise() *= weights_;
        Eigen::VectorXd residual(3 * n);
        for (Eigen::Index c = 0; c < 3; ++c) {
            const Eigen::VectorXd wanted = colors_.col(c).array() * weights_ / unit_;
            const Eigen::Vector2d x = nonNegative(basis, wanted);
            residual.segment(c * n, n) = basis * x - wanted;
            if (fit == nullptr) continue;
            (&fit->diffuse.r)[c] = static_cast<float>(x(0) * unit_);
            (&fit->specular.r)[c] = static_cast<float>(x(1) * unit_);
        }
        return residual;
    }

  private:
    /// Least squares of two unknowns, none below 0: both, or the better one alone.
    static Eigen::Vector2d nonNegative(const Eigen::MatrixX2d& basis,
                                       const Eigen::VectorXd& wanted) {
        const Eigen::Matrix2d gram = basis.transpose() * basis;
        const Eigen::Vector2d right = basis.transpose() * wanted;
        const double determinant = gram.determinant();
        if (determinant > 1e-12 * gram(0, 0) * gram(1, 1)) {
            Eigen::Vector2d x = gram.inverse() * right;
            if (x.minCoeff() >= 0) return x;
        }
        const auto alone = [&](Eigen::Index i) {
            return gram(i, i) > 0 ? std::max(right(i) / gram(i, i), 0.0) : 0.0;
        };
        const Eigen::Vector2d body(alone(0), 0);
        const Eigen::Vector2d lobe(0, alone(1));
        return right.dot(body) >= right.dot(lobe) ? body : lobe;
    }

    Eigen::MatrixX3d colors_;
    Eigen::ArrayXd cosines_;
    Eigen::ArrayXd weights_;
    std::vector<typename Shine::Pair> local_;
    bool isBlack_ = false;
    double unit_ = 1;
};

struct Solution {
    Shape shape;
    double error = 0;
    double condition = 1;  ///< Of the last normal equations, damped.
};

/// Largest over smallest eigenvalue.
double conditionOf(const Eigen::Matrix4d& matrix) {
    const Eigen::Vector4d values =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(matrix, Eigen::EigenvaluesOnly)
            .eigenvalues();
    return values(3) / std::max(values(0), 1e-300);
}

/// Levenberg and Marquardt with differences for derivatives, from one shape.
template <class Shine>
Solution descend(const Fitting<Shine>& fitting, Shape shape) {
    constexpr int kSteps = 20;
    constexpr double kDifference = 1e-3;
    Eigen::VectorXd residual = fitting.residuals(shape);
    double error = residual.squaredNorm();
    double damping = 1e-2;
    Eigen::Matrix4d solved = Eigen::Matrix4d::Identity();
    for (int step = 0; step < kSteps; ++step) {
        Eigen::MatrixX4d jacobian(residual.size(), 4);
        for (Eigen::Index p = 0; p < 4; ++p) {
            Shape moved = shape;
            moved(p) += moved(p) + kDifference > 0 && p < 2 ? -kDifference : kDifference;
            jacobian.col(p) = (fitting.residuals(moved) - residual) / (moved(p) - shape(p));
        }
        const Eigen::Matrix4d gram = jacobian.transpose() * jacobian;
        const Eigen::Vector4d gradient = jacobian.transpose() * residual;
        const double before = error;
        for (int attempt = 0; attempt < 5; ++attempt) {
            Eigen::Matrix4d damped = gram;
            damped.diagonal() *= 1 + damping;
            damped.diagonal().array() += 1e-12 + 1e-6 * gram.diagonal().maxCoeff();
            solved = damped;
            const Shape next = bounded(shape - damped.ldlt().solve(gradient));
            const Eigen::VectorXd attempted = fitting.residuals(next);
            if (attempted.squaredNorm() < error) {
                shape = next;
                residual = attempted;
                error = residual.squaredNorm();
                damping *= 0.3;
                break;
            }
            damping *= 5;
        }
        if (error > before * (1 - 1e-4)) break;
    }
    return {shape, error, conditionOf(solved)};
}

}  // namespace

Lobe MicrofacetFit::lobe() const {
    Lobe lobe;
    lobe.strength = 1;
    lobe.fresnel = {1, static_cast<float>(grazing), 5};
    lobe.roughnessX = static_cast<float>(roughnessX);
    lobe.roughnessY = static_cast<float>(roughnessY);
    lobe.azimuth = azimuth;
    return lobe;
}

template <class Shine>
static MicrofacetFit fitted(const std::vector<LightAndView>& pairs, std::span<const Rgb> values) {
    const Fitting<Shine> fitting(pairs, values);
    if (fitting.isBlack()) return {};
    Solution best{{}, -1};
    for (const double roughness : {0.05, 0.2, 0.5}) {
        // A little anisotropy to begin with: at none its azimuth says nothing.
        const Shape start(std::log(roughness * 1.1), std::log(roughness / 1.1), 0.4, 0.5);
        const Solution found = descend(fitting, start);
        if (best.error < 0 || found.error < best.error) best = found;
    }
    MicrofacetFit fit = fitOf(best.shape);
    fit.condition = best.condition;
    fitting.residuals(best.shape, &fit);
    return fit;
}

MicrofacetFit fitMicrofacet(const std::vector<LightAndView>& pairs, std::span<const Rgb> values) {
    return fitted<FloatLobe>(pairs, values);
}

MicrofacetFit fitMicrofacetInDouble(const std::vector<LightAndView>& pairs,
                                    std::span<const Rgb> values) {
    return fitted<DoubleLobe>(pairs, values);
}

}  // namespace abrdf
