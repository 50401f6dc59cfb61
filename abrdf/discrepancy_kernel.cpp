// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/discrepancy_kernel.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/pair_features.h"

namespace abrdf {

namespace {

/// Of the unit vectors beside the isotropic features.
constexpr double kVectorWeight = 0.7;

Eigen::MatrixXd allFeatures(MaterialClass materialClass, const std::vector<LightAndView>& pairs) {
    Eigen::MatrixXd isotropic = isotropicFeatures(pairs);
    if (materialClass == MaterialClass::kIso) return isotropic;
    Eigen::MatrixXd all(isotropic.rows(), 10);
    all << isotropic, kVectorWeight * vectorFeatures(pairs);
    return all;
}

}  // namespace

Eigen::MatrixXd discrepancyKernel(MaterialClass materialClass, const std::vector<LightAndView>& a,
                                  const std::vector<LightAndView>& b, double length) {
    const Eigen::MatrixXd ofA = allFeatures(materialClass, a);
    const Eigen::MatrixXd ofB = allFeatures(materialClass, b);
    const auto near = [&](const Eigen::MatrixXd& x, const Eigen::MatrixXd& y) {
        return (-squaredDistances(x, y).array().sqrt() / length).exp().eval();
    };
    Eigen::MatrixXd kernel(ofA.rows(), ofB.rows());
    constexpr std::size_t kRows = 128;
    forEachTexelBlock(a.size(), kRows, [&](std::size_t begin, std::size_t end) {
        const auto first = static_cast<Eigen::Index>(begin);
        const auto count = static_cast<Eigen::Index>(end - begin);
        const auto rows = ofA.middleRows(first, count);
        kernel.middleRows(first, count) =
            0.25 * (near(rows.leftCols(1), ofB.leftCols(1)) +            // Half angle.
                    near(rows.middleCols(2, 2), ofB.middleCols(2, 2)) +  // Elevations.
                    2 * near(rows, ofB));
    });
    return kernel;
}

}  // namespace abrdf
