// SPDX-License-Identifier: BSD-3-Clause
//
// `measured`: no reconstruction. On the database's own grid its values as they are, on another
// one their interpolation. Its samples are all pairs of the database, or those that another grid
// needs: PairInterpolation::pairsFor().
#include "abrdf/pair_interpolation.h"
#include "stages/reconstruct/reconstructor.h"

#include <algorithm>

namespace abrdf {

namespace {

class Measured : public Reconstructor {
  public:
    explicit Measured(const ReconstructionTask& task)
        : samples_(task.samples.count()),
          isSame_(task.input == task.output),
          output_(task.output),
          interpolation_(task.input) {
        if (isSame_) return;
        if (samples_ < task.input.pairCount()) placeOf_ = interpolation_.pairsFor(task.output);
        for (const Direction& d : output_.lights()) lights_.push_back(interpolation_.lightPlace(d));
        for (const Direction& d : output_.views()) views_.push_back(interpolation_.viewPlace(d));
    }

    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdf) const override {
        if (isSame_) {
            std::ranges::copy(samples, abrdf.begin());
            return;
        }
        std::vector<Rgb> placed;
        if (!placeOf_.empty()) {
            placed.resize(placeOf_.back() + 1);
            for (std::size_t k = 0; k < samples_; ++k) placed[placeOf_[k]] = samples[k];
            samples = placed;
        }
        for (std::size_t pair = 0; pair < abrdf.size(); ++pair) {
            abrdf[pair] = interpolation_.value(lights_[output_.lightOf(pair)],
                                               views_[output_.viewOf(pair)], samples);
        }
    }

    double multiplyAdds() const override {
        if (isSame_) return 0;
        constexpr double kLinearTerms = 12;
        double lightTerms = 0;
        double viewTerms = 0;
        for (const auto& place : lights_)
            lightTerms += static_cast<double>(place.smooth.terms.size());
        for (const auto& place : views_)
            viewTerms += static_cast<double>(place.smooth.terms.size());
        return 3 *
               (lightTerms * viewTerms + kLinearTerms * static_cast<double>(output_.pairCount()));
    }

    double modelBytes() const override { return static_cast<double>(samples_ * sizeof(Rgb)); }

  private:
    std::size_t samples_;
    bool isSame_;
    AngularGrid output_;
    PairInterpolation interpolation_;
    std::vector<std::size_t> placeOf_;  ///< Of each sample, its pair; empty: all pairs are there.
    std::vector<PairInterpolation::Place> lights_;  ///< Of each output light; empty: the same grid.
    std::vector<PairInterpolation::Place> views_;
};

}  // namespace

std::unique_ptr<Reconstructor> makeMeasured(const ReconstructionTask& task) {
    return std::make_unique<Measured>(task);
}

}  // namespace abrdf
