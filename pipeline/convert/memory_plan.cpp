// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/memory_plan.h"

#include "color/rgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr std::uint64_t kMega = std::uint64_t{1} << 20;

/// Threads' stacks, and what the allocator keeps between blocks.
constexpr std::uint64_t kSlack = 12 * kMega;

/// A larger band is written in fewer pieces, but past this they are long enough.
constexpr std::uint64_t kLargestBand = 64 * kMega;

std::size_t divided(std::size_t a, std::size_t b) {
    return (a + b - 1) / b;
}

class Planner {
  public:
    explicit Planner(const MemoryTask& task)
        : task_(task),
          order_(tileOrderOf(task.layout)),
          spatial_(task.layout.kind == AtlasKind::kSpatial),
          texels_(task.layout.texelCount()) {
        const TileOrder::Tile largest = order_.tile(0);
        unitTexels_ = spatial_ ? 1 : largest.cells();
        units_ = spatial_ ? texels_ : order_.tiles();
        const auto pairs = static_cast<std::uint64_t>(task.layout.lights) *
                           static_cast<std::uint64_t>(task.layout.views);
        itemBytes_ = 3 * bytesOf(task.type);
        // Samples and what the method makes of them, its products, the finished values, and the
        // packed tile beside its chunk.
        texelBytes_ = sizeof(Rgb) * (3 * task.samples + 2 * task.reconstructed + pairs) +
                      2 * itemBytes_ * pairs;
        tableBytes_ = std::uint64_t{task.images} * texels_ * sizeof(Rgb);
        itemTableBytes_ = spatial_ ? pairs * texels_ * itemBytes_ : 0;
        tileItemBytes_ = spatial_ ? largest.cells() * texels_ * itemBytes_ : 0;
    }

    /// Nothing where it takes more than the budget.
    std::optional<MemoryPlan> planWith(std::size_t slots, std::size_t runTiles,
                                       std::uint64_t budget) const {
        MemoryPlan plan;
        plan.runTiles = std::clamp<std::size_t>(runTiles, 1, units_);
        plan.slots = std::min(slots, divided(units_, plan.runTiles));
        plan.readSlots = std::min(slots, std::max<std::size_t>(1, task_.images));
        const std::uint64_t runs = plan.slots * plan.runTiles * unitTexels_ * texelBytes_;
        const std::uint64_t reading = plan.readSlots * task_.imageBytes;
        const std::uint64_t fixed = task_.fixedBytes + kSlack;
        const std::uint64_t least = fixed + std::max(runs, reading);

        // Samples: all in memory, else two bands.
        const std::uint64_t bandLeast =
            2 * plan.slots * plan.runTiles * unitTexels_ * task_.images * sizeof(Rgb);
        const std::size_t allRuns = divided(units_, plan.runTiles);
        plan.samplesInMemory = least + tableBytes_ <= budget;
        plan.runsPerBand = allRuns;
        std::uint64_t samples = tableBytes_;
        if (!plan.samplesInMemory) {
            if (fixed + std::max(runs + bandLeast, reading) > budget) return {};
            const std::uint64_t room = std::min(budget - fixed - runs, 2 * kLargestBand);
            plan.runsPerBand = plan.slots * std::max<std::size_t>(1, room / bandLeast);
            samples = plan.runsPerBand / plan.slots * bandLeast;
            plan.scratchBytes += tableBytes_;
        }
        const std::uint64_t held = plan.samplesInMemory ? samples : 0;
        plan.peak = fixed + std::max(runs + samples, reading + held);
        if (spatial_ && !planItems(plan, budget, fixed, runs + samples)) return {};
        return plan;
    }

    /// The same for the pairs' turn of a spatial atlas; false where it takes more than the budget.
    bool planItems(MemoryPlan& plan, std::uint64_t budget, std::uint64_t fixed,
                   std::uint64_t making) const {
        const std::uint64_t tiles = 2 * plan.slots * tileItemBytes_;  // Packed, and its chunk.
        plan.itemTiles = 1;
        plan.itemRunsPerBand = order_.tiles();
        plan.itemsInMemory = fixed + std::max(making, tiles) + itemTableBytes_ <= budget;
        if (plan.itemsInMemory) {
            plan.peak = fixed + std::max(making, tiles) + itemTableBytes_;
            return true;
        }
        const std::uint64_t bandLeast = 2 * plan.slots * tileItemBytes_;
        if (fixed + tiles + bandLeast > budget) return false;
        const std::uint64_t room = std::min(budget - fixed - tiles, 2 * kLargestBand);
        plan.itemRunsPerBand = plan.slots * std::max<std::size_t>(1, room / bandLeast);
        plan.scratchBytes += itemTableBytes_;
        plan.peak =
            std::max(plan.peak, fixed + tiles + plan.itemRunsPerBand / plan.slots * bandLeast);
        return true;
    }

    std::size_t unitTexels() const { return unitTexels_; }

  private:
    const MemoryTask& task_;
    TileOrder order_;
    bool spatial_;
    std::size_t texels_;
    std::size_t unitTexels_;  ///< Texels of what runs are counted in: a tile, or a texel.
    std::size_t units_;
    std::uint64_t itemBytes_;
    std::uint64_t texelBytes_;
    std::uint64_t tableBytes_;
    std::uint64_t itemTableBytes_;
    std::uint64_t tileItemBytes_;
};

}  // namespace

std::uint64_t bytesFromText(const std::string& text) {
    std::uint64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [unit, error] = std::from_chars(text.data(), end, number);
    const std::string_view rest(unit, static_cast<std::size_t>(end - unit));
    int shift = -1;
    if (rest.empty() || rest == "B") shift = 0;
    if (rest == "K" || rest == "k" || rest == "KB" || rest == "KiB") shift = 10;
    if (rest == "M" || rest == "m" || rest == "MB" || rest == "MiB") shift = 20;
    if (rest == "G" || rest == "g" || rest == "GB" || rest == "GiB") shift = 30;
    if (rest == "T" || rest == "t" || rest == "TB" || rest == "TiB") shift = 40;
    if (error != std::errc() || shift < 0 || number == 0 || number > (UINT64_MAX >> shift)) {
        throw std::invalid_argument(fmt::format(
            "the size '{}' is not understood: write a number with K, M or G, as 500M or 2G", text));
    }
    return number << shift;
}

MemoryPlan planMemory(const MemoryTask& task, std::uint64_t budget) {
    const Planner planner(task);
    const auto threads = static_cast<std::size_t>(task.threads);
    const std::size_t wish = std::max<std::size_t>(1, task.texelsAtOnce / planner.unitTexels());
    // Smaller runs first, then fewer of them, then fewer threads at work.
    for (std::size_t slots = 2 * threads; slots > 0; --slots) {
        const std::size_t leastRun = slots > 1 ? std::max<std::size_t>(1, wish / 4) : 1;
        for (std::size_t run = wish; run >= leastRun; run /= 2) {
            if (const auto plan = planner.planWith(slots, run, budget)) return *plan;
        }
    }
    std::uint64_t smallest = task.fixedBytes / kMega;
    while (!planner.planWith(1, 1, smallest * kMega)) smallest += 1 + smallest / 64;
    constexpr std::uint64_t kFromRunToRun = 4;  // What of the libraries is resident differs.
    smallest += kFromRunToRun;
    throw std::invalid_argument(
        fmt::format("--memory {}M is too small for this job; the smallest that works is {}M",
                    budget / kMega, smallest));
}

std::vector<std::size_t> bandBegins(const TileOrder& order, std::size_t tilesPerBand) {
    std::vector<std::size_t> begins;
    for (std::size_t tile = 0; tile < order.tiles(); tile += tilesPerBand) {
        begins.push_back(order.firstCell(tile));
    }
    begins.push_back(order.cells());
    return begins;
}

}  // namespace abrdf
