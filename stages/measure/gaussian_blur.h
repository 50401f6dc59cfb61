// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace abrdf {

/// Weights exp(-d^2 / spread^2) over distance d along one axis of an image, each row summing to 1:
/// a matrix from its `count` texels to blurred ones. Past its edges the image goes on periodically,
/// or mirrored. spread: in texels, > 0.
Eigen::MatrixXf blurWeights(int count, double spread, bool isPeriodic);

/// A blur of images (rows, columns) that is built once.
class GaussianBlur {
  public:
    GaussianBlur(int width, int height, double spread, bool isPeriodic)
        : ofRows_(blurWeights(height, spread, isPeriodic)),
          ofColumns_(blurWeights(width, spread, isPeriodic).transpose()) {}

    Eigen::MatrixXf operator()(const Eigen::MatrixXf& image) const {
        return ofRows_ * image * ofColumns_;
    }

  private:
    Eigen::MatrixXf ofRows_;
    Eigen::MatrixXf ofColumns_;
};

}  // namespace abrdf
