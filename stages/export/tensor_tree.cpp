// SPDX-License-Identifier: BSD-3-Clause
#include "stages/export/tensor_tree.h"

#include "abrdf/direction.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

/// Cells that differ by less are equal.
constexpr double kRounding = 1e-5;

/// What is known of a cube of cells.
struct Cube {
    double low = 0;
    double high = 0;
    double sum = 0;  ///< Of weight times value.
    double weight = 0;
    double mean() const { return weight > 0 ? sum / weight : (low + high) / 2; }
};

class TreeMaker {
  public:
    TreeMaker(const std::vector<float>& cells, const std::vector<float>& weights,
              const TreeOptions& options)
        : options_(options),
          branches_(std::size_t{1} << options.rank),
          cubes_(cubesOf(cells, weights)) {}

    /// Live leaves at a bound on the differences within one.
    std::size_t leavesAt(double bound) const { return leaves(0, {}, bound); }

    std::string text(double bound) const { return text(0, {}, bound); }

    /// The largest difference within a leaf, over its mean: at most `bound`.
    double differenceAt(double bound) const { return difference(0, {}, bound); }

  private:
    using Place = std::array<std::size_t, 4>;  ///< Of a cube among those of its level.

    std::size_t side(int level) const { return std::size_t{1} << level; }

    std::size_t indexOf(int level, const Place& place) const {
        std::size_t index = 0;
        for (int d = 0; d < options_.rank; ++d) {
            index = (index << level) + place[static_cast<std::size_t>(d)];
        }
        return index;
    }

    /// Bit d of `branch` says which half along dimension d.
    Place child(const Place& place, std::size_t branch) const {
        Place result{};
        for (std::size_t d = 0; d < static_cast<std::size_t>(options_.rank); ++d) {
            result[d] = 2 * place[d] + ((branch >> d) & 1U);
        }
        return result;
    }

    std::vector<std::vector<Cube>> cubesOf(const std::vector<float>& cells,
                                           const std::vector<float>& weights) const {
        const auto levels = static_cast<std::size_t>(options_.levels);
        std::vector<std::vector<Cube>> cubes(levels + 1);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const auto v = static_cast<double>(cells[i]);
            const double w = weights.empty() ? 1 : static_cast<double>(weights[i]);
            cubes[levels].push_back({v, v, w * v, w});
        }
        for (int level = options_.levels - 1; level >= 0; --level) {
            std::vector<Cube>& here = cubes[static_cast<std::size_t>(level)];
            here.resize(std::size_t{1} << (options_.rank * level));
            for (std::size_t i = 0; i < here.size(); ++i) {
                here[i] = unionOf(cubes[static_cast<std::size_t>(level) + 1], level, i);
            }
        }
        return cubes;
    }

    Cube unionOf(const std::vector<Cube>& finer, int level, std::size_t index) const {
        Place place{};
        for (int d = options_.rank - 1; d >= 0; --d) {
            place[static_cast<std::size_t>(d)] = index & (side(level) - 1);
            index >>= level;
        }
        Cube sum = finer[indexOf(level + 1, child(place, 0))];
        for (std::size_t branch = 1; branch < branches_; ++branch) {
            const Cube& next = finer[indexOf(level + 1, child(place, branch))];
            sum.low = std::min(sum.low, next.low);
            sum.high = std::max(sum.high, next.high);
            sum.sum += next.sum;
            sum.weight += next.weight;
        }
        return sum;
    }

    const Cube& cubeAt(int level, const Place& place) const {
        return cubes_[static_cast<std::size_t>(level)][indexOf(level, place)];
    }

    bool isLeaf(int level, const Place& place, double bound) const {
        if (level == options_.levels) return true;
        const Cube& cube = cubeAt(level, place);
        return cube.high - cube.low <= bound * (cube.mean() + options_.floor);
    }

    double difference(int level, const Place& place, double bound) const {
        if (isLeaf(level, place, bound)) {
            const Cube& cube = cubeAt(level, place);
            const double size = cube.mean() + options_.floor;
            return cube.high > cube.low ? (cube.high - cube.low) / size : 0;
        }
        double largest = 0;
        for (std::size_t branch = 0; branch < branches_; ++branch) {
            largest = std::max(largest, difference(level + 1, child(place, branch), bound));
        }
        return largest;
    }

    std::size_t leaves(int level, const Place& place, double bound) const {
        if (isLeaf(level, place, bound)) {
            // Half of the cells is half of the first dimension.
            const std::size_t first = place[0] << (options_.levels - level);
            const std::size_t row = std::size_t{1} << ((options_.rank - 1) * options_.levels);
            return first * row < options_.live ? 1 : 0;
        }
        std::size_t sum = 0;
        for (std::size_t branch = 0; branch < branches_; ++branch) {
            sum += leaves(level + 1, child(place, branch), bound);
        }
        return sum;
    }

    std::string text(int level, const Place& place, double bound) const {
        if (isLeaf(level, place, bound))
            return fmt::format("{{{:.6g}}}", cubeAt(level, place).mean());
        bool isGrid = true;
        for (std::size_t branch = 0; branch < branches_; ++branch) {
            isGrid = isGrid && isLeaf(level + 1, child(place, branch), bound);
        }
        std::string result = "{";
        for (std::size_t branch = 0; branch < branches_; ++branch) {
            if (isGrid) {
                // In a grid of values the last dimension is the fastest, among branches the first.
                std::size_t turned = 0;
                for (int d = 0; d < options_.rank; ++d) {
                    turned |= ((branch >> d) & 1U) << (options_.rank - 1 - d);
                }
                result += fmt::format("{}{:.6g}", branch == 0 ? "" : " ",
                                      cubeAt(level + 1, child(place, turned)).mean());
            } else {
                result += (branch == 0 ? "" : "\n") + text(level + 1, child(place, branch), bound);
            }
        }
        return result + "}";
    }

    TreeOptions options_;
    std::size_t branches_;
    std::vector<std::vector<Cube>> cubes_;  ///< A list for each level, the whole first.
};

}  // namespace

DiskPlace diskFromSquare(double a, double b) {
    const double x = 2 * a - 1;
    const double y = 2 * b - 1;
    if (x == 0 && y == 0) return {};
    const bool isAlongX = std::abs(x) > std::abs(y);
    const double radius = isAlongX ? x : y;
    const double angle = isAlongX ? kPi / 4 * y / x : kPi / 2 - kPi / 4 * x / y;
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

TensorTree tensorTree(const std::vector<float>& cells, const std::vector<float>& weights,
                      const TreeOptions& options) {
    const TreeMaker maker(cells, weights, options);
    const auto share = (1 - options.cull) * static_cast<double>(options.live);
    const auto wanted = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(share)));
    TensorTree tree;
    // A leaf of everything is within the largest bound.
    double high = kRounding;
    while (maker.leavesAt(high) > wanted && high < 1e12) high *= 2;
    double low = high / 2;
    constexpr int kBisections = 20;
    for (int i = 0; i < kBisections && high > kRounding; ++i) {
        const double middle = (low + high) / 2;
        (maker.leavesAt(middle) > wanted ? low : high) = middle;
    }
    tree.bound = maker.differenceAt(high);
    tree.leaves = maker.leavesAt(high);
    tree.text = maker.text(high);
    return tree;
}

}  // namespace abrdf
