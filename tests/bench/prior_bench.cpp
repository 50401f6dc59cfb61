// SPDX-License-Identifier: BSD-3-Clause
//
// `prior`'s kernel against the machine: a block of texels beside sgemm of the same shapes and flops
// (one core), all cores beside the peak of sgemm, and low rank with half output beside writing the
// same bytes. sgemm is OpenBLAS's where libopenblas.so.0 is there, else Eigen's.
#include "abrdf/for_each_texel.h"
#include "abrdf/packed_lines.h"
#include "abrdf/sample_plan.h"
#include "pipeline/plan/plan_choice.h"
#include "pipeline/train/prior_cache.h"
#include "stages/reconstruct/prior_choice.h"
#include "stages/reconstruct/prior_material.h"
#include "stages/train/random_material.h"
#include "tests/bench/duel.h"

#include <Eigen/Core>
#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <random>

namespace {

using abrdf::AngularGrid;
using abrdf::PriorMaterial;
using abrdf::Rgb;

constexpr std::size_t kBlock = 32;     ///< Texels that the stage does together.
constexpr std::size_t kTexels = 4096;  ///< Of the runs on all cores: more halfs than caches hold.
constexpr std::size_t kRounds = 9;

const AngularGrid& grid() {
    static const AngularGrid kGrid(abrdf::ubo81Directions());
    return kGrid;
}

/// C = A B of column-major matrices m x k and k x n, on so many threads.
class Sgemm {
  public:
    Sgemm() {
        void* library = dlopen("libopenblas.so.0", RTLD_NOW);
        if (library == nullptr) return;
        multiply_ = reinterpret_cast<Multiply>(dlsym(library, "cblas_sgemm"));
        setThreads_ = reinterpret_cast<SetThreads>(dlsym(library, "openblas_set_num_threads"));
    }
    const char* name() const { return multiply_ != nullptr ? "OpenBLAS" : "Eigen"; }

    void operator()(int threads, const Eigen::MatrixXf& a, const Eigen::MatrixXf& b,
                    Eigen::MatrixXf& c) const {
        if (multiply_ == nullptr) {
            c.noalias() = a * b;
            return;
        }
        setThreads_(threads);
        const auto m = static_cast<int>(a.rows());
        const auto k = static_cast<int>(a.cols());
        const auto n = static_cast<int>(b.cols());
        multiply_(102, 111, 111, m, n, k, 1, a.data(), m, b.data(), k, 0, c.data(), m);
    }

  private:
    using Multiply = void (*)(int, int, int, int, int, int, float, const float*, int, const float*,
                              int, float, float*, int);
    using SetThreads = void (*)(int);
    Multiply multiply_ = nullptr;
    SetThreads setThreads_ = nullptr;
};

/// Samples of a random material with a colour, for some texels that vary about it.
std::vector<Rgb> samplesOf(const abrdf::PriorModel& model, abrdf::MaterialClass materialClass,
                           std::size_t texels) {
    const auto material = abrdf::randomMaterials(materialClass, 1, 5).front();
    std::vector<Rgb> mean;
    for (const abrdf::LightAndView& pair : model.samples) {
        const float v = evaluate(material, Imath::V3f(vectorFromDirection(pair.light)),
                                 Imath::V3f(vectorFromDirection(pair.view)));
        mean.push_back({1.1F * v + 0.01F, v + 0.01F, 0.8F * v + 0.02F});
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<float> factor(0.7F, 1.3F);
    std::vector<Rgb> samples;
    for (std::size_t t = 0; t < texels; ++t) {
        const float f = t == 0 ? 1 : factor(random);
        for (const Rgb& c : mean) samples.push_back(f * c);
    }
    return samples;
}

struct Case {
    const char* name;
    abrdf::MaterialClass materialClass;
    int rank;
};

/// One core, a block of texels: time a texel, beside sgemm of the same shapes.
void oneCore(const Case& c, const abrdf::PriorModel& model, const Sgemm& sgemm) {
    const std::size_t pairs = grid().pairCount();
    std::vector<std::size_t> rowOf(pairs);
    for (std::size_t i = 0; i < pairs; ++i) rowOf[i] = i;
    const std::vector<Rgb> samples = samplesOf(model, c.materialClass, kBlock);
    abrdf::ReconstructOptions options;
    options.rank = c.rank;
    const std::span<const Rgb> mean(samples.data(), model.samples.size());
    const double setUp = secondsOf([&] { PriorMaterial(model, rowOf, mean, options); });
    Eigen::VectorXd luminance(static_cast<Eigen::Index>(mean.size()));
    for (std::size_t i = 0; i < mean.size(); ++i) {
        luminance(static_cast<Eigen::Index>(i)) =
            static_cast<double>(mean[i].r + mean[i].g + mean[i].b) / 3;
    }
    const double choice = secondsOf([&] { abrdf::chooseTerms(model, luminance, 0); });
    const PriorMaterial material(model, rowOf, mean, options);

    // The same flops in products of the map's depth.
    const auto depth = static_cast<Eigen::Index>(c.rank > 0 ? static_cast<std::size_t>(c.rank)
                                                            : model.samples.size());
    const auto rows =
        static_cast<Eigen::Index>(material.multiplyAdds() / static_cast<double>(depth));
    const Eigen::MatrixXf a = Eigen::MatrixXf::Random(rows, depth);
    const Eigen::MatrixXf b = Eigen::MatrixXf::Random(depth, kBlock);
    Eigen::MatrixXf product(rows, kBlock);
    std::vector<Rgb> abrdfs(kBlock * pairs);
    const Duel duel = Duel::of(
        kRounds * 3, [&] { material.reconstruct(samples, abrdfs); },
        [&] { sgemm(1, a, b, product); });
    const double flops = 2 * material.multiplyAdds() * kBlock;
    fmt::print("{:<18}{:>9.0f}{:>9.0f}{:>9.1f}{:>9.1f}{:>8.0f} %{:>10.1f}{:>10.1f}\n", c.name,
               1e6 * duel.ours / kBlock, 1e6 * duel.limit / kBlock, flops / duel.ours / 1e9,
               flops / duel.limit / 1e9, 100 * duel.limit / duel.ours, 1e3 * choice, 1e3 * setUp);
}

/// All cores: blocks of texels into memory that is there, as halfs or not at all.
void allCores(const Case& c, const abrdf::PriorModel& model, const Sgemm& sgemm) {
    const std::size_t pairs = grid().pairCount();
    std::vector<std::size_t> rowOf(pairs);
    for (std::size_t i = 0; i < pairs; ++i) rowOf[i] = i;
    const std::size_t count = model.samples.size();
    const std::vector<Rgb> samples = samplesOf(model, c.materialClass, kTexels);
    abrdf::ReconstructOptions options;
    options.rank = c.rank;
    const PriorMaterial material(model, rowOf, std::span(samples).first(count), options);
    std::vector<std::uint16_t> halfs(3 * kTexels * pairs);
    const auto make = [&] {
        abrdf::forEachTexelBlock(kTexels, kBlock, [&](std::size_t begin, std::size_t end) {
            thread_local std::vector<Rgb> abrdfs;
            abrdfs.resize((end - begin) * pairs);
            material.reconstruct(std::span(samples).subspan(begin * count, (end - begin) * count),
                                 abrdfs);
            abrdf::halfsFrom(abrdfs.data(), abrdfs.size(), &halfs[3 * begin * pairs]);
        });
    };
    const double flops = 2 * material.multiplyAdds() * kTexels;
    const int threads = abrdf::threadsInUse();
    if (c.rank == 0) {
        constexpr Eigen::Index kSize = 4096;
        const Eigen::MatrixXf a = Eigen::MatrixXf::Random(kSize, kSize);
        const Eigen::MatrixXf b = Eigen::MatrixXf::Random(kSize, kSize);
        Eigen::MatrixXf product(kSize, kSize);
        const Duel duel = Duel::of(kRounds, make, [&] { sgemm(threads, a, b, product); });
        const double rate = flops / duel.ours / 1e9;
        const double peak = 2 * std::pow(static_cast<double>(kSize), 3) / duel.limit / 1e9;
        fmt::print("{:<18}{:>9.0f} us a texel, {:.1f} of {:.1f} GFlop/s: {:.0f} %\n", c.name,
                   1e6 * duel.ours / kTexels, rate, peak, 100 * rate / peak);
        return;
    }
    std::vector<char> target(halfs.size() * sizeof halfs[0]);
    const Duel duel = Duel::of(kRounds, make, [&] {
        abrdf::forEachTexelBlock(kTexels, kBlock, [&](std::size_t begin, std::size_t end) {
            std::memset(target.data() + begin * pairs * 6, 1, (end - begin) * pairs * 6);
        });
    });
    fmt::print("{:<18}{:>9.0f} us a texel, {:.2f} of {:.2f} GB/s written: {:.0f} %\n", c.name,
               1e6 * duel.ours / kTexels, static_cast<double>(target.size()) / duel.ours / 1e9,
               static_cast<double>(target.size()) / duel.limit / 1e9, 100 * duel.limit / duel.ours);
}

/// The packing of halfs alone, one core.
void halfsAlone() {
    std::vector<Rgb> colors(grid().pairCount() * kBlock, Rgb{0.1F, 0.2F, 0.3F});
    std::vector<std::uint16_t> halfs(3 * colors.size());
    std::vector<std::uint16_t> copy(halfs.size());
    const Duel duel = Duel::of(
        kRounds * 3, [&] { abrdf::halfsFrom(colors.data(), colors.size(), halfs.data()); },
        [&] { std::memcpy(copy.data(), halfs.data(), halfs.size() * 2); });
    fmt::print("halfs of floats, one core: {:.1f} us a texel, {:.1f} x memcpy of the halfs\n",
               1e6 * duel.ours / kBlock, duel.ours / duel.limit);
}

}  // namespace

int main() {
    const auto greedy = abrdf::greedyPairsOfUbo81();
    std::vector<abrdf::LightAndView> samples;
    for (std::size_t i = 0; i < 204; ++i) samples.push_back(grid().pair(greedy[i]));
    const auto model = abrdf::priorFor(samples, pairsOf(grid()), {}, {}, {});
    const Sgemm sgemm;
    const std::vector<Case> cases = {
        {"iso, rank 32", abrdf::MaterialClass::kIso, 32},
        {"iso, full rank", abrdf::MaterialClass::kIso, 0},
        {"aniso, rank 32", abrdf::MaterialClass::kAniso, 32},
        {"aniso, full rank", abrdf::MaterialClass::kAniso, 0},
    };
    fmt::print("81 x 81 pairs from 204 samples; sgemm is {}'s\n\none core, {} texels at once\n",
               sgemm.name(), kBlock);
    fmt::print("{:<18}{:>9}{:>9}{:>9}{:>9}{:>10}{:>10}{:>10}\n", "", "us/texel", "sgemm", "GFlop/s",
               "sgemm", "of it", "choice ms", "set-up ms");
    for (const Case& c : cases) oneCore(c, *model, sgemm);
    fmt::print("\n{} cores, half output\n", abrdf::threadsInUse());
    for (const Case& c : cases) allCores(c, *model, sgemm);
    halfsAlone();
    return 0;
}
