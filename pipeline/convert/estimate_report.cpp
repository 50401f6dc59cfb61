// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/estimate_report.h"

#include "stages/measure/quantile.h"

#include <cmath>
#include <numeric>

namespace abrdf {

void addEstimate(std::vector<float> deltaE, nlohmann::ordered_json& report) {
    std::erase_if(deltaE, [](float value) { return std::isnan(value); });
    if (deltaE.empty()) return;
    const double mean =
        std::accumulate(deltaE.begin(), deltaE.end(), 0.0) / static_cast<double>(deltaE.size());
    report["estimate"] = {{"delta_e", mean}, {"delta_e_95", quantile(std::move(deltaE), 0.95)}};
}

}  // namespace abrdf
