// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/train_prior.h"

#include "abrdf/angular_grid.h"
#include "abrdf/for_each_texel.h"
#include "stages/train/model_file.h"
#include "stages/train/training_values.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

using namespace abrdf;

namespace {

const std::vector<LightAndView>& somePairs() {
    static const std::vector<LightAndView> kPairs = [] {
        std::vector<LightAndView> pairs;
        const AngularGrid grid(regularDirections(4, 5));
        for (std::size_t i = 2; i < grid.pairCount(); i += 13) pairs.push_back(grid.pair(i));
        return pairs;
    }();
    return kPairs;
}

Eigen::MatrixXd covarianceOf(const PriorClass& c) {
    const PriorSpectrum& s = c.spectra.front();
    return s.eigenvectors * s.eigenvalues.asDiagonal() * s.eigenvectors.transpose();
}

bool areEqual(const PriorModel& a, const PriorModel& b) {
    if (a.scaleFactor != b.scaleFactor || a.classes.size() != b.classes.size()) return false;
    for (std::size_t c = 0; c < a.classes.size(); ++c) {
        if (a.classes[c].cross != b.classes[c].cross ||
            a.classes[c].outputMean != b.classes[c].outputMean ||
            a.classes[c].sampleMean != b.classes[c].sampleMean ||
            a.classes[c].spectra.back().eigenvectors != b.classes[c].spectra.back().eigenvectors) {
            return false;
        }
    }
    return true;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("outputs that are the samples have the samples' own moments") {
    const PriorModel model = trainPrior(somePairs(), somePairs(), {80, 2}, {});
    for (const PriorClass& c : model.classes) {
        if (c.materialClass == MaterialClass::kIso) continue;  // Twins share rows there.
        CAPTURE(nameOf(c.materialClass));
        // But for the cap on highlights that all samples miss, which these cannot exceed much.
        CHECK((c.outputMean.cast<double>() - c.sampleMean).cwiseAbs().maxCoeff() < 0.02);
        const Eigen::MatrixXd difference = c.cross.cast<double>() - covarianceOf(c);
        CHECK(difference.norm() < 0.02 * covarianceOf(c).norm());
    }
}

TEST_CASE("class iso has one row for all its twins") {
    const AngularGrid grid(regularDirections(3, 8));
    const PriorModel model = trainPrior(somePairs(), pairsOf(grid), {20, 2}, {});
    CHECK(model.classes[0].cross.rows() < 100);
    CHECK(model.classes[1].cross.rows() == static_cast<Eigen::Index>(grid.pairCount()));
}

TEST_CASE("nothing to learn from is an error") {
    CHECK_THROWS_AS(trainPrior({}, somePairs(), {}, {}), std::invalid_argument);
    CHECK_THROWS_AS(trainPrior(somePairs(), {}, {}, {}), std::invalid_argument);
    CHECK_THROWS_AS(trainPrior(somePairs(), somePairs(), {1, 1}, {}), std::invalid_argument);
}

TEST_CASE("a model survives its file, and no damaged file is taken for one") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "model";
    const PriorModel model = trainPrior(somePairs(), somePairs(), {10, 1}, {});
    writeModel(file, model);
    const PriorModel back = readModel(file);
    CHECK(areEqual(model, back));
    CHECK(back.samples == model.samples);

    const std::string whole = bytesOf(file);
    const auto faultOf = [&](const std::string& bytes) {
        std::ofstream(file, std::ios::binary) << bytes;
        try {
            readModel(file);
            return std::string();
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
    };
    for (const std::size_t length : {std::size_t{0}, std::size_t{10}, std::size_t{24},
                                     std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
        CHECK(faultOf(whole.substr(0, length)).find("not a whole model") != std::string::npos);
    }
    for (const std::size_t place :
         {std::size_t{3}, std::size_t{17}, std::size_t{30}, whole.size() / 3, whole.size() - 2}) {
        std::string damaged = whole;
        damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
        CHECK(faultOf(damaged).find("model") != std::string::npos);
    }
    CHECK(faultOf(whole).empty());
}

TEST_CASE("a model's key changes with all that the model depends on") {
    const std::uint64_t key = modelKey(somePairs(), somePairs(), {10, 1});
    std::vector<LightAndView> other = somePairs();
    other[3].view.phi += 1e-6;
    CHECK(key == modelKey(somePairs(), somePairs(), {10, 1}));
    CHECK(key != modelKey(other, somePairs(), {10, 1}));
    CHECK(key != modelKey(somePairs(), other, {10, 1}));
    CHECK(key != modelKey(somePairs(), somePairs(), {11, 1}));
    CHECK(key != modelKey(somePairs(), somePairs(), {10, 2}));
}

TEST_CASE("the quantile of a column is that of its sorted values") {
    Eigen::MatrixXf values(5, 2);
    values << 5, 1, 4, 1, 3, 1, 2, 1, 1, 9;
    const Eigen::VectorXd median = quantileOfColumns(values, 0.5);
    CHECK(median(0) == 3);
    CHECK(median(1) == 1);
    CHECK(quantileOfColumns(values, 0.875)(0) == doctest::Approx(4.5));
    CHECK(quantileOfColumns(values, 1)(1) == 9);
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("threads");

TEST_CASE("training gives the same bits on 1, 2 and 7 threads") {
    std::optional<PriorModel> first;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        PriorModel model = trainPrior(somePairs(), somePairs(), {30, 1}, {});
        if (first) {
            CHECK(areEqual(*first, model));
        } else {
            first = std::move(model);
        }
    }
}

TEST_SUITE_END();
