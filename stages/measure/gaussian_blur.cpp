// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/gaussian_blur.h"

#include <cmath>

namespace abrdf {

Eigen::MatrixXf blurWeights(int count, double spread, bool isPeriodic) {
    const int period = isPeriodic ? count : 2 * count;
    const auto reach = static_cast<int>(std::ceil(4 * spread));
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(count, count);
    for (int to = 0; to < count; ++to) {
        for (int from = to - reach; from <= to + reach; ++from) {
            int place = ((from % period) + period) % period;
            if (place >= count) place = period - 1 - place;
            const double distance = (from - to) / spread;
            weights(to, place) += std::exp(-distance * distance);
        }
        weights.row(to) /= weights.row(to).sum();
    }
    return weights.cast<float>();
}

}  // namespace abrdf
