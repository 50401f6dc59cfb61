// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/seen_images.h"

#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"
#include "stages/measure/gaussian_blur.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cassert>
#include <numbers>
#include <vector>

namespace abrdf {

namespace {

using Planes = std::array<Eigen::MatrixXf, 3>;

/// X. Zhang, B. Wandell, "A spatial extension of CIELAB for digital color image reproduction",
/// 1996: the eye blurs each opponent colour by a sum of Gaussians; weights, and spreads in degrees.
struct Gaussian {
    int plane;  ///< Luminance, red-green, blue-yellow.
    double weight;
    double spread;
};
constexpr std::array kEye = {Gaussian{0, 0.921, 0.0283}, Gaussian{0, 0.105, 0.133},
                             Gaussian{0, -0.108, 4.336}, Gaussian{1, 0.531, 0.0392},
                             Gaussian{1, 0.330, 0.494},  Gaussian{2, 0.488, 0.0536},
                             Gaussian{2, 0.371, 0.386}};

Eigen::Matrix3f opponentFromXyz() {
    Eigen::Matrix3f matrix;
    matrix << 0.279F, 0.720F, -0.107F,  //
        -0.449F, 0.290F, -0.077F,       //
        0.086F, -0.590F, 0.501F;
    return matrix;
}

/// The weights of a plane sum to 1.
double weightSum(int plane) {
    double sum = 0;
    for (const Gaussian& g : kEye) sum += g.plane == plane ? g.weight : 0;
    return sum;
}

/// What the eye makes of an image, and the windows of the structural similarity.
class Eye {
  public:
    Eye(int width, int height, const SeenOptions& options)
        : window_(width, height, 1.5 * std::numbers::sqrt2, options.isPeriodic) {
        for (const Gaussian& g : kEye) {
            blurs_.emplace_back(width, height, g.spread * options.texelsPerDegree,
                                options.isPeriodic);
        }
    }

    /// Colours of an image that is shown, in XYZ, as they look from afar.
    Planes seen(const Planes& xyz) const {
        const Planes opponent = transformed(opponentFromXyz(), xyz);
        Planes blurred;
        for (Eigen::MatrixXf& plane : blurred) plane.setZero(xyz[0].rows(), xyz[0].cols());
        for (std::size_t i = 0; i < kEye.size(); ++i) {
            const auto plane = static_cast<std::size_t>(kEye[i].plane);
            const auto weight = static_cast<float>(kEye[i].weight / weightSum(kEye[i].plane));
            blurred[plane] += weight * blurs_[i](opponent[plane]);
        }
        return transformed(opponentFromXyz().inverse(), blurred);
    }

    /// Structural similarity at each texel, of lumas in 0 .. 1.
    Eigen::ArrayXXf similarity(const Eigen::MatrixXf& x, const Eigen::MatrixXf& y) const {
        constexpr float kC1 = 0.01F * 0.01F;
        constexpr float kC2 = 0.03F * 0.03F;
        const Eigen::ArrayXXf meanX = window_(x).array();
        const Eigen::ArrayXXf meanY = window_(y).array();
        const Eigen::ArrayXXf xx = window_(x.cwiseProduct(x)).array() - meanX.square();
        const Eigen::ArrayXXf yy = window_(y.cwiseProduct(y)).array() - meanY.square();
        const Eigen::ArrayXXf xy = window_(x.cwiseProduct(y)).array() - meanX * meanY;
        return (2 * meanX * meanY + kC1) * (2 * xy + kC2) /
               ((meanX.square() + meanY.square() + kC1) * (xx + yy + kC2));
    }

  private:
    static Planes transformed(const Eigen::Matrix3f& matrix, const Planes& from) {
        Planes to;
        for (int c = 0; c < 3; ++c) {
            to[static_cast<std::size_t>(c)] =
                matrix(c, 0) * from[0] + matrix(c, 1) * from[1] + matrix(c, 2) * from[2];
        }
        return to;
    }

    std::vector<GaussianBlur> blurs_;
    GaussianBlur window_;
};

/// One image of a tile as a display shows it.
struct ShownImage {
    Planes xyz;
    Eigen::MatrixXf luma;

    ShownImage(Eigen::Index height, Eigen::Index width) : luma(height, width) {
        for (Eigen::MatrixXf& plane : xyz) plane.resize(height, width);
    }
    void set(Eigen::Index y, Eigen::Index x, Rgb color) {
        const Xyz c = xyzOfDisplayed(color);
        xyz[0](y, x) = static_cast<float>(c.x);
        xyz[1](y, x) = static_cast<float>(c.y);
        xyz[2](y, x) = static_cast<float>(c.z);
        luma(y, x) =
            static_cast<float>(0.2126 * srgbEncoded(color.r) + 0.7152 * srgbEncoded(color.g) +
                               0.0722 * srgbEncoded(color.b));
    }
};

Lab labAt(const Planes& xyz, Eigen::Index i) {
    return labFromXyz({static_cast<double>(xyz[0](i)), static_cast<double>(xyz[1](i)),
                       static_cast<double>(xyz[2](i))});
}

SeenMeasures measureImage(const AbrdfTile& truth, const AbrdfTile& reconstruction, std::size_t pair,
                          int width, int height, const Eye& eye, double exposure) {
    ShownImage measured(height, width);
    ShownImage restored(height, width);
    Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> known(height, width);
    for (std::size_t t = 0; t < truth.texelCount(); ++t) {
        const auto y = static_cast<Eigen::Index>(t) / width;
        const auto x = static_cast<Eigen::Index>(t) % width;
        known(y, x) = isFinite(truth[t][pair]);
        const Rgb color = static_cast<float>(exposure) * reconstruction[t][pair];
        measured.set(y, x, known(y, x) ? static_cast<float>(exposure) * truth[t][pair] : color);
        restored.set(y, x, color);
    }
    const Planes seenMeasured = eye.seen(measured.xyz);
    const Planes seenRestored = eye.seen(restored.xyz);
    const Eigen::ArrayXXf similarity = eye.similarity(measured.luma, restored.luma);
    SeenMeasures sum{0, 0, 0};
    for (Eigen::Index i = 0; i < known.size(); ++i) {
        if (!known(i)) continue;
        sum.sCielab += deltaE76(labAt(seenMeasured, i), labAt(seenRestored, i));
        sum.ssim += static_cast<double>(similarity(i));
        ++sum.images;  // Texels, until they are divided by.
    }
    if (sum.images == 0) return sum;
    const auto count = static_cast<double>(sum.images);
    return {sum.sCielab / count, sum.ssim / count, 1};
}

}  // namespace

SeenMeasures measureSeenImages(const AbrdfTile& truth, const AbrdfTile& reconstruction, int width,
                               int height, std::span<const std::uint8_t> mask,
                               const SeenOptions& options) {
    assert(truth.texelCount() ==
           static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::vector<std::size_t> pairs;
    for (std::size_t pair = 0; pair < mask.size(); ++pair) {
        if (mask[pair] != 0) pairs.push_back(pair);
    }
    const std::size_t count = std::min(pairs.size(), options.mostImages);
    const Eye eye(width, height, options);
    std::vector<SeenMeasures> images(count);
    forEachImage(count, [&](std::size_t i) {
        const std::size_t pair = pairs[(2 * i + 1) * pairs.size() / (2 * count)];
        images[i] = measureImage(truth, reconstruction, pair, width, height, eye, options.exposure);
    });
    SeenMeasures mean{0, 0, 0};
    for (const SeenMeasures& image : images) {
        mean.sCielab += image.sCielab;
        mean.ssim += image.ssim;
        mean.images += image.images;
    }
    if (mean.images == 0) return {};
    const auto total = static_cast<double>(mean.images);
    return {mean.sCielab / total, mean.ssim / total, mean.images};
}

}  // namespace abrdf
