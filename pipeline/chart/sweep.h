// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "pipeline/chart/method_time.h"
#include "pipeline/reconstruction.h"
#include "stages/measure/measures.h"

#include <string>
#include <vector>

namespace abrdf {

/// One method at one size.
struct MethodSize {
    std::string method;
    std::size_t samples = 0;  ///< At most: a plan may take a few less.
    int rank = 0;             ///< Of `prior`'s maps; 0: full.

    bool operator==(const MethodSize&) const = default;
};

/// Every method but `measured` at each count, and `prior` at each rank below that as well.
std::vector<MethodSize> methodSizes(const std::vector<std::string>& methods,
                                    const std::vector<std::size_t>& counts,
                                    const std::vector<int>& ranks);

/// A material that is known at all pairs of a grid.
struct Subject {
    std::string name;
    AngularGrid grid;
    ImageStack truth;  ///< An image of 1 x 1 for each pair, linear Rec.709.
    double noise = 0;  ///< As ReconstructOptions has it.
    double saturated = 0;
};

/// The average texel of a database, all its pairs. Throws where one is missing.
Subject readSubject(const InputOptions& options, const ProgressSink& progress);

/// What one method at one size makes of one subject.
struct Trial {
    MethodSize size;
    std::string plan;
    std::size_t samples = 0;
    std::size_t images = 0;  ///< Measured pairs that it needs.
    Accuracy accuracy;
    MethodTime time;
    double multiplyAdds = 0;
    double modelBytes = 0;
    double setUpMilliseconds = 0;  ///< Once a material; a prior's training is not in it.
};

struct TrialOptions {
    double exposure = 1;    ///< At which errors are meant.
    double seconds = 0.02;  ///< To spend on timing.
    PriorSource prior;
};

/// Throws as planFor(); Cancelled.
Trial tryMethod(const MethodSize& size, const Subject& subject, const TrialOptions& options,
                const ProgressSink& progress, const MessageSink& warn);

}  // namespace abrdf
