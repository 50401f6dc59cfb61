// SPDX-License-Identifier: BSD-3-Clause
#include "stages/align/find_plane.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/mean_color.h"
#include "stages/align/search_images.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <numeric>
#include <optional>
#include <utility>

namespace abrdf {

namespace {

constexpr int kCoarsest = 32;  ///< Texels of the smaller side, at most twice as many.
constexpr int kLeastSide = 16;
constexpr std::size_t kNeighbours = 4;
constexpr double kStep = 0.25;  ///< Between heights, in texels of a level.
constexpr std::size_t kCandidates = 3;

struct Neighbour {
    std::size_t image;
    float weight;
};
using Neighbours = std::vector<std::vector<Neighbour>>;

/// Of each image its nearest others by inverse squared distance of both directions.
Neighbours neighboursOf(const std::vector<LightAndView>& directions) {
    Neighbours result(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i) {
        std::vector<std::pair<double, std::size_t>> others;
        for (std::size_t j = 0; j < directions.size(); ++j) {
            if (j != i) others.emplace_back(squaredDistance(directions[i], directions[j]), j);
        }
        std::ranges::partial_sort(others, others.begin() + kNeighbours);
        others.resize(kNeighbours);
        double sum = 0;
        // Two images at one place (a pole that is listed twice) have distance 0.
        for (auto& [distance, j] : others) sum += 1 / std::max(distance, 1e-6);
        for (const auto& [distance, j] : others) {
            result[i].push_back({j, static_cast<float>(1 / std::max(distance, 1e-6) / sum)});
        }
    }
    return result;
}

void removeMean(std::span<Rgb> image) {
    const Rgb mean = meanOfFinite(image);
    for (Rgb& c : image) c = c - mean;
}

/// Edges of shadows and yarns, which no plane explains, count less than in squares.
double length1(Rgb c) {
    return static_cast<double>(std::abs(c.r) + std::abs(c.g) + std::abs(c.b));
}

/// One resolution of the images.
class Level {
  public:
    Level(ImageStack images, Edges edges) : images_(std::move(images)), edges_(edges) {}

    int smallerSide() const { return std::min(images_.width(), images_.height()); }

    /// PlaneFit::residual at a height in texels of this level.
    double residual(double height, const std::vector<LightAndView>& directions,
                    const Neighbours& neighbours) const {
        ImageStack shifted(images_.pairs(), images_.width(), images_.height());
        forEachImage(directions.size(), [&](std::size_t i) {
            shiftImage(images_.image(i), images_.width(), images_.height(),
                       parallax(height, directions[i].view), edges_, shifted.image(i));
            removeMean(shifted.image(i));
        });
        std::vector<double> differences(directions.size());
        std::vector<double> deviations(directions.size());
        forEachImage(directions.size(), [&](std::size_t i) {
            const auto own = std::as_const(shifted).image(i);
            for (std::size_t t = 0; t < own.size(); ++t) {
                Rgb predicted;
                for (const Neighbour& n : neighbours[i]) {
                    predicted += n.weight * std::as_const(shifted).image(n.image)[t];
                }
                const double difference = length1(own[t] - predicted);
                if (!std::isfinite(difference)) continue;
                differences[i] += difference;
                deviations[i] += length1(own[t]);
            }
        });
        const double deviation = std::accumulate(deviations.begin(), deviations.end(), 0.0);
        const double sum = std::accumulate(differences.begin(), differences.end(), 0.0);
        return deviation > 0 ? sum / deviation : 0;
    }

  private:
    ImageStack images_;
    Edges edges_;
};

struct Candidate {
    double height;
    double residual;
};

/// The lowest of the local minima among heights at even steps.
std::vector<Candidate> lowestMinima(const std::vector<Candidate>& heights) {
    std::vector<Candidate> minima;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const bool isMinimum =
            (i == 0 || heights[i].residual <= heights[i - 1].residual) &&
            (i + 1 == heights.size() || heights[i].residual < heights[i + 1].residual);
        if (isMinimum) minima.push_back(heights[i]);
    }
    std::ranges::stable_sort(minima, {}, &Candidate::residual);
    minima.resize(std::min(minima.size(), kCandidates));
    return minima;
}

/// Where the parabola through residuals at even steps, as many on either side of the middle one, is
/// least, in steps from there; 0 where it has no minimum among them.
double vertex(std::span<const double> residuals) {
    const std::size_t middle = residuals.size() / 2;
    const auto half = static_cast<double>(middle);
    double slope = 0;
    double curvature = 0;
    double squares = 0;
    double spread = 0;  // Of the squares of places, about their mean.
    const auto placeOf = [&](std::size_t i) { return static_cast<double>(i) - half; };
    for (std::size_t i = 0; i < residuals.size(); ++i) squares += placeOf(i) * placeOf(i);
    const double meanSquare = squares / static_cast<double>(residuals.size());
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        const double x = placeOf(i);
        slope += x * residuals[i] / squares;
        curvature += (x * x - meanSquare) * residuals[i];
        spread += (x * x - meanSquare) * (x * x - meanSquare);
    }
    if (curvature <= 0) return 0;
    const double place = -slope * spread / (2 * curvature);
    return std::abs(place) <= half ? place : 0;
}

/// Downhill from `start` in steps; then the middle of the valley, as the residual is a little
/// rough: shifts by whole texels blur less.
template <typename Residual>
Candidate refined(double start, const Residual& residual) {
    constexpr std::size_t kHalf = 3;
    std::deque<double> valley;
    for (std::size_t i = 0; i <= 2 * kHalf; ++i) {
        valley.push_back(residual(start + (static_cast<double>(i) - kHalf) * kStep));
    }
    constexpr int kMostSteps = 12;
    for (int step = 0; step < kMostSteps; ++step) {
        const auto least = std::ranges::min_element(valley) - valley.begin();
        if (least == kHalf) break;
        if (least > static_cast<std::ptrdiff_t>(kHalf)) {
            start += kStep;
            valley.push_back(residual(start + kHalf * kStep));
            valley.pop_front();
        } else {
            start -= kStep;
            valley.push_front(residual(start - kHalf * kStep));
            valley.pop_back();
        }
    }
    const double height = start + kStep * vertex(std::vector<double>(valley.begin(), valley.end()));
    return {height, residual(height)};
}

}  // namespace

PlaneFit findPlane(const ImageStack& images, const std::vector<LightAndView>& directions,
                   const PlaneSearch& search) {
    assert(images.pairs().size() == directions.size());
    const int side = std::min(images.width(), images.height());
    Radians steepest = 0;
    for (const LightAndView& pair : directions) steepest = std::max(steepest, pair.view.theta);
    if (side < kLeastSide || directions.size() <= kNeighbours || steepest < 1e-3) return {};

    const Neighbours neighbours = neighboursOf(directions);
    std::vector<Level> levels;  // The finest first.
    for (ImageStack level = cubeRoots(images);; level = halved(level)) {
        levels.emplace_back(smoothed(level, search.edges), search.edges);
        if (std::min(level.width(), level.height()) < 2 * kCoarsest) break;
    }
    const auto residualAt = [&](const Level& level) {
        return [&](double height) { return level.residual(height, directions, neighbours); };
    };
    // A shift of half an image, or of a quarter where what leaves it is lost, is the most.
    const double most = levels.back().smallerSide() *
                        (search.edges == Edges::kPeriodic ? 0.5 : 0.25) /
                        -parallax(1, {steepest, 0}).x;
    std::vector<Candidate> heights;
    const auto steps = static_cast<int>(most / kStep);
    for (int step = -steps; step <= steps; ++step) {
        heights.push_back({step * kStep, residualAt(levels.back())(step * kStep)});
    }
    std::optional<Candidate> best;
    for (Candidate candidate : lowestMinima(heights)) {
        for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
            if (level != levels.rbegin()) candidate.height *= 2;
            candidate = refined(candidate.height, residualAt(*level));
        }
        if (!best || candidate.residual < best->residual) best = candidate;
    }
    PlaneFit fit;
    fit.best = best->height;
    fit.residual = best->residual;
    fit.residualAtZero = residualAt(levels.front())(0);
    if (fit.drop() >= search.leastDrop) fit.height = fit.best;
    return fit;
}

}  // namespace abrdf
