// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/stress/stress_setup.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace abrdf {

/// One case on all materials, with every method.
class StressRun {
  public:
    /// All of them must outlive the run.
    StressRun(const StressCase& stressCase, const std::vector<StressMaterial>& materials,
              const std::vector<StressMethod>& methods, const AngularGrid& grid,
              const StressOptions& options)
        : case_(stressCase),
          materials_(materials),
          methods_(methods),
          grid_(grid),
          options_(options) {}

    /// Every trial, in parallel. Ticks: the case's name as phase. Throws as stress().
    void run(const ProgressSink& progress, const MessageSink& warn);

    /// After run(): a row of the report's "results", with the steps and the breakdown of a method.
    nlohmann::ordered_json resultOf(std::size_t method) const;

  private:
    struct KeptModel {
        std::vector<LightAndView> samples;
        AngularGrid output;
        std::shared_ptr<const PriorModel> model;
    };

    std::uint64_t hashOfName() const;
    std::shared_ptr<const PriorModel> modelOf(const SampleSet& samples, const AngularGrid& output,
                                              const ProgressSink& progress,
                                              const MessageSink& warn);

    const StressCase& case_;
    const std::vector<StressMaterial>& materials_;
    const std::vector<StressMethod>& methods_;
    const AngularGrid& grid_;
    const StressOptions& options_;
    std::vector<KeptModel> models_;
    std::vector<StressOutcome> outcomes_;  ///< [step][material][method]
};

}  // namespace abrdf
