// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/discrepancy_kernel.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/pair_features.h"
#include "abrdf/random.h"
#include "abrdf/register_bytes.h"
#include "stages/measure/measures.h"
#include "stages/reconstruct/leave_out.h"
#include "stages/reconstruct/low_rank.h"
#include "stages/reconstruct/prior_map.h"
#include "stages/reconstruct/prior_material.h"
#include "stages/reconstruct/reconstructor.h"
#include "tests/support/small_prior.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace abrdf;

namespace {

/// The grid's pairs are all distinct.
std::vector<std::size_t> rows() {
    return distinctPairs(pairsOf(smallPrior().grid)).rowOf;
}

std::vector<Rgb> estimated(const std::vector<Rgb>& samples,
                           const ReconstructOptions& options = {}) {
    std::vector<Rgb> abrdf(smallPrior().grid.pairCount());
    PriorMaterial(*smallPrior().model, rows(), samples, options).reconstruct(samples, abrdf);
    return abrdf;
}

double deltaEOf(const std::vector<Rgb>& truth, const std::vector<Rgb>& abrdf) {
    return measureAccuracy(truth, abrdf, {}, {}).natural.deltaE;
}

ReconstructionTask taskFor(const std::vector<Rgb>& mean) {
    const SmallPrior& prior = smallPrior();
    return {{}, prior.samples, prior.grid, prior.grid, mean, {}, prior.model, {}};
}

/// The slow twin: the mixture of conditional means in double precision, term by term.
Eigen::VectorXd slowLogs(const PriorModel& model, const std::vector<PriorTerm>& terms,
                         const Eigen::VectorXd& z) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.outputs.size()));
    const std::vector<std::size_t> rowOf = isotropicPairs(model.outputs).rowOf;
    for (const PriorTerm& term : terms) {
        if (term.isLambert) {
            const double level = (z - lambertLogs(model.samples)).mean();
            x.array() += term.weight * (lambertLogs(model.outputs).array() + level);
            continue;
        }
        const PriorClass& c = model.classes[term.classIndex];
        const PriorSpectrum& spectrum = c.spectra[term.spectrum];
        const PriorSpectrum& plain = c.spectra.front();
        const auto n = z.size();
        Eigen::MatrixXd covariance =
            plain.eigenvectors * plain.eigenvalues.asDiagonal() * plain.eigenvectors.transpose();
        Eigen::MatrixXd cross = c.cross.cast<double>();
        Eigen::VectorXd mean = c.outputMean.cast<double>();
        if (c.materialClass == MaterialClass::kIso) {
            cross = cross(rowOf, Eigen::all).eval();
            mean = mean(rowOf).eval();
        }
        if (spectrum.sigma > 0) {
            const double variance = spectrum.sigma * spectrum.sigma;
            covariance += variance * discrepancyKernel(c.materialClass, model.samples,
                                                       model.samples, spectrum.length);
            cross += variance * discrepancyKernel(c.materialClass, model.outputs, model.samples,
                                                  spectrum.length);
        }
        covariance += term.nu * Eigen::MatrixXd::Identity(n, n);
        x += term.weight * (mean + cross * covariance.fullPivLu().solve(z - c.sampleMean));
    }
    return x;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("the map of a mixture is its slow twin in double precision") {
    const PriorModel& model = *smallPrior().model;
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    Eigen::VectorXd luminance(static_cast<Eigen::Index>(samples.size()));
    for (std::size_t k = 0; k < samples.size(); ++k) {
        luminance(static_cast<Eigen::Index>(k)) =
            static_cast<double>(samples[k].r + samples[k].g + samples[k].b) / 3;
    }
    const Eigen::VectorXd z = logSamples(model, luminance).z;
    const PairGroups isotropic = isotropicPairs(model.outputs);
    const std::vector<std::vector<PriorTerm>> mixtures = {
        chooseTerms(model, luminance, 0),
        {{false, 0, 1, 3e-4, 0.5}, {false, 3, 4, 3e-3, 0.3}, {true, 0, 0, 0, 0.2}},
        {{false, 2, 0, 3e-4, 1}}};
    for (const std::vector<PriorTerm>& terms : mixtures) {
        const PriorMap map = priorMap(model, terms, model.outputs, isotropic.rowOf);
        const Eigen::VectorXf x = map.offset + map.matrix * z.cast<float>();
        CHECK((x.cast<double>() - slowLogs(model, terms, z)).cwiseAbs().maxCoeff() < 2e-3);
        const Eigen::MatrixXd vectors = z;
        const PriorMap ofOne = priorMap(model, terms, model.outputs, isotropic.rowOf, &vectors);
        CHECK((ofOne.offset + ofOne.matrix - x).cwiseAbs().maxCoeff() < 1e-3F);
    }
}

TEST_CASE("samples predict one another as if each had been left out") {
    const PriorModel& model = *smallPrior().model;
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    Eigen::VectorXd green(static_cast<Eigen::Index>(samples.size()));
    for (std::size_t k = 0; k < samples.size(); ++k) {
        green(static_cast<Eigen::Index>(k)) = static_cast<double>(samples[k].g);
    }
    const std::vector<PriorTerm> terms = {{false, 1, 2, 3e-3, 1}};
    const Eigen::VectorXd predicted = leaveOneOut(model, terms, green);
    const LogSamples logs = logSamples(model, green);
    const PriorClass& c = model.classes[1];
    const Eigen::MatrixXd covariance = precisionOf(model, terms[0]).inverse();
    for (const Eigen::Index left : {0, 7, 30}) {
        std::vector<Eigen::Index> others(static_cast<std::size_t>(green.size()));
        std::iota(others.begin(), others.end(), Eigen::Index{0});
        others.erase(others.begin() + left);
        const Eigen::VectorXd centered = logs.z - c.sampleMean;
        const Eigen::RowVectorXd toOthers = covariance(left, others);
        const Eigen::MatrixXd between = covariance(others, others);
        const Eigen::VectorXd known = centered(others);
        const double z = c.sampleMean(left) + (toOthers * between.llt().solve(known)).value();
        const double value = std::max(std::exp(z) - kPriorFloor, 0.0) * logs.scale;
        CHECK(predicted(left) == doctest::Approx(value).epsilon(1e-6));
    }
}

TEST_CASE("a Lambertian comes back, whatever its colour and unit") {
    for (const double unit : {1.0, 1e-3, 400.0}) {
        const auto lambert = [&](const LightAndView& pair) {
            const auto c = static_cast<float>(unit * std::cos(pair.light.theta));
            return Rgb{0.8F * c, 0.4F * c, 0.1F * c};
        };
        const std::vector<Rgb> truth = smallPrior().abrdfOf(lambert);
        const std::vector<Rgb> abrdf = estimated(smallPrior().samplesOf(lambert));
        for (std::size_t i = 0; i < truth.size(); ++i) {
            CHECK(abrdf[i].r == doctest::Approx(truth[i].r).epsilon(0.002));
            CHECK(abrdf[i].b == doctest::Approx(truth[i].b).epsilon(0.002));
        }
    }
}

TEST_CASE("the samples themselves are reproduced, and the rest is near the truth") {
    const std::vector<Rgb> truth = smallPrior().abrdfOf(plastic);
    const std::vector<Rgb> abrdf = estimated(smallPrior().samplesOf(plastic));
    CHECK(deltaEOf(truth, abrdf) < 2.5);
    double worst = 0;
    for (const auto& sources : smallPrior().samples.sources) {
        const std::size_t pair = sources[0].pair;
        worst = std::max(worst, static_cast<double>(std::abs(abrdf[pair].g / truth[pair].g - 1)));
    }
    CHECK(worst < 0.05);
}

TEST_CASE("models are chosen by texels where there are some, else by the mean") {
    // A texel that is half plastic, half its shadow side: unlike the mean, whose models it ignores.
    const auto texel = [](const LightAndView& pair) {
        const double facing = std::cos(pair.light.phi) * std::sin(pair.light.theta);
        const auto lit = static_cast<float>(facing > 0.1 ? 1 : 0.05);
        return lit * plastic(pair);
    };
    const PriorModel& model = *smallPrior().model;
    const std::vector<Rgb> mean = smallPrior().samplesOf(plastic);
    std::vector<Rgb> texels = smallPrior().samplesOf(texel);
    const std::vector<Rgb> one = texels;
    const PriorMaterial byMean(model, rows(), mean, {});
    const PriorMaterial byTexel(model, rows(), mean, {}, one);
    texels.insert(texels.end(), one.begin(), one.end());
    const PriorMaterial byTwo(model, rows(), mean, {}, texels);
    const auto error = [&](const PriorMaterial& material) {
        std::vector<Rgb> abrdf(smallPrior().grid.pairCount());
        material.reconstruct(one, abrdf);
        return deltaEOf(smallPrior().abrdfOf(texel), abrdf);
    };
    CHECK(error(byTexel) < 0.9 * error(byMean));
    CHECK(byTexel.leaveOneOutError() > byMean.leaveOneOutError());
    // A texel twice is that texel; the mean as the only texel is the mean.
    REQUIRE(byTwo.terms().size() == byTexel.terms().size());
    for (std::size_t i = 0; i < byTwo.terms().size(); ++i) {
        CHECK(byTwo.terms()[i].classIndex == byTexel.terms()[i].classIndex);
        CHECK(byTwo.terms()[i].weight == doctest::Approx(byTexel.terms()[i].weight));
    }
    CHECK(byTwo.leaveOneOutError() == doctest::Approx(byTexel.leaveOneOutError()));
    CHECK(PriorMaterial(model, rows(), mean, {}, mean).leaveOneOutError() ==
          byMean.leaveOneOutError());
}

TEST_CASE("black is black, and a channel of zeros stays zero") {
    for (const Rgb& value : estimated(smallPrior().samplesOf([](auto&) { return Rgb{}; }))) {
        CHECK(value == Rgb{});
    }
    const auto noGreen = [](const LightAndView& pair) {
        const Rgb c = plastic(pair);
        return Rgb{c.r, 0, c.b};
    };
    for (const Rgb& value : estimated(smallPrior().samplesOf(noGreen))) {
        CHECK(value.g == 0);
        CHECK(value.r > 0);
    }
}

TEST_CASE("the unit of the samples is the unit of the answer") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const std::vector<Rgb> once = estimated(samples);
    for (const float unit : {1e-4F, 1e4F}) {
        std::vector<Rgb> scaled = samples;
        for (Rgb& c : scaled) c *= unit;
        const std::vector<Rgb> abrdf = estimated(scaled);
        for (std::size_t i = 0; i < once.size(); ++i) {
            CHECK(abrdf[i].r / unit == doctest::Approx(once[i].r).epsilon(1e-4));
        }
    }
}

TEST_CASE("no numbers make a negative, infinite or undefined answer") {
    Random random(5);
    for (int round = 0; round < 40; ++round) {
        std::vector<Rgb> samples;
        for (std::size_t k = 0; k < smallPrior().samples.count(); ++k) {
            const auto any = [&] {
                return random.chance(0.2)
                           ? 0.0F
                           : static_cast<float>(std::exp(random.uniform(-60.0, 40.0)));
            };
            samples.push_back({any(), any(), any()});
        }
        for (const Rgb& value : estimated(samples)) {
            CHECK(isFinite(value));
            CHECK_FALSE(isNegative(value));
        }
    }
}

TEST_CASE("where the samples contradict every model, their neighbours are asked, and it is said") {
    // A step in the azimuth of the view, which no random material has, at any unit.
    for (const float unit : {1e-4F, 1.0F, 1e4F}) {
        const auto step = [&](const LightAndView& pair) {
            const double side = std::sin(pair.view.phi + 0.3) > 0 ? 0.8 : 0.1;
            const auto value = static_cast<float>(side * std::cos(pair.light.theta));
            return unit * Rgb{value, value, value};
        };
        const std::vector<Rgb> samples = smallPrior().samplesOf(step);
        const auto reconstructor = methodFromName("prior").make(taskFor(samples));
        CHECK(reconstructor->remark().find("contradict") != std::string::npos);
        std::vector<Rgb> abrdf(smallPrior().grid.pairCount());
        std::vector<Rgb> neighbours(abrdf.size());
        reconstructor->reconstruct(samples, abrdf);
        methodFromName("idw").make(taskFor(samples))->reconstruct(samples, neighbours);
        CHECK(abrdf == neighbours);
    }
    const auto plain = methodFromName("prior").make(taskFor(smallPrior().samplesOf(plastic)));
    CHECK(plain->remark().empty());
    CHECK(plain->condition() > 10);
}

TEST_CASE("a low rank is exact for the material's mean, and costs less") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const std::vector<Rgb> full = estimated(samples);
    const std::vector<Rgb> few = estimated(samples, {.rank = 4});
    for (std::size_t i = 0; i < full.size(); ++i) {
        CHECK(few[i].g == doctest::Approx(full[i].g).epsilon(1e-3));
    }
    const PriorModel& model = *smallPrior().model;
    CHECK(PriorMaterial(model, rows(), samples, {.rank = 4}).multiplyAdds() <
          0.5 * PriorMaterial(model, rows(), samples, {}).multiplyAdds());
}

TEST_CASE("a texel that is alone needs no maps for its ABRDF and its estimate") {
    const auto brushed = [](const LightAndView& pair) {
        const double turn = pair.light.phi + pair.view.phi;
        return (1.5F + static_cast<float>(std::cos(turn))) * plastic(pair);
    };
    const auto black = [](const LightAndView&) { return Rgb{}; };
    const auto red = [](const LightAndView& pair) { return Rgb{plastic(pair).r, 0, 0}; };
    const PriorModel& model = *smallPrior().model;
    for (const std::function<Rgb(const LightAndView&)>& material :
         {std::function<Rgb(const LightAndView&)>(plastic),
          std::function<Rgb(const LightAndView&)>(brushed),
          std::function<Rgb(const LightAndView&)>(black),
          std::function<Rgb(const LightAndView&)>(red)}) {
        for (const double saturated : {0.0, 0.3}) {
            const std::vector<Rgb> samples = smallPrior().samplesOf(material);
            const PriorMaterial whole(model, rows(), samples, {.saturated = saturated});
            const PriorMaterial alone(model, rows(), samples,
                                      {.saturated = saturated, .alone = true});
            CHECK(alone.model().columns() == 1);
            std::vector<Rgb> wanted(smallPrior().grid.pairCount());
            std::vector<Rgb> found(wanted.size());
            float wantedError = 0;
            float foundError = 0;
            whole.model().evaluate(whole.encode(samples, {&wantedError, 1}), wanted);
            alone.model().evaluate(alone.encode(samples, {&foundError, 1}), found);
            CHECK(foundError == doctest::Approx(wantedError).epsilon(1e-4));
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                CHECK(found[i].r == doctest::Approx(wanted[i].r).epsilon(2e-6));
                CHECK(found[i].g == doctest::Approx(wanted[i].g).epsilon(2e-6));
                CHECK(found[i].b == doctest::Approx(wanted[i].b).epsilon(2e-6));
            }
        }
    }
    const PriorMaterial alone(model, rows(), smallPrior().samplesOf(plastic), {.alone = true});
    CHECK_THROWS_AS(alone.encode(smallPrior().samplesOf(brushed)), std::logic_error);
}

TEST_CASE("basis and projection of full rank are the map, and the first numbers are the best") {
    Random random(3);
    Eigen::MatrixXf matrix(40, 9);
    for (float& x : matrix.reshaped()) x = static_cast<float>(random.uniform(-1, 1));
    Eigen::MatrixXd root(9, 9);
    for (double& x : root.reshaped()) x = random.uniform(-1, 1);
    const Eigen::MatrixXd covariance = root * root.transpose() + Eigen::MatrixXd::Identity(9, 9);
    const NestedBasis whole = nestedBasis(matrix, covariance, 9);
    CHECK((whole.basis * whole.projection - matrix).norm() < 1e-4F * matrix.norm());
    // The error of vectors of this covariance: what the singular values say, and no smaller.
    const Eigen::MatrixXd colored =
        matrix.cast<double>() * covariance.llt().matrixL().toDenseMatrix();
    const Eigen::VectorXd values = colored.jacobiSvd().singularValues();
    for (const Eigen::Index r : {2, 5}) {
        const Eigen::MatrixXd left =
            (matrix - whole.basis.leftCols(r) * whole.projection.topRows(r)).cast<double>() *
            covariance.llt().matrixL().toDenseMatrix();
        CHECK(left.squaredNorm() ==
              doctest::Approx(values.tail(9 - r).squaredNorm()).epsilon(1e-3));
    }
}

TEST_CASE("where few outputs matter, as many numbers as those are give these exactly") {
    Random random(4);
    Eigen::MatrixXf matrix(40, 9);
    for (float& x : matrix.reshaped()) x = static_cast<float>(random.uniform(-1, 1));
    const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(9, 9);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(40);
    weights(3) = 0.7;
    weights(20) = 0.2;
    weights(39) = 0.1;
    const NestedBasis few = nestedBasis(matrix, covariance, 3, weights);
    const Eigen::MatrixXf made = few.basis * few.projection;
    for (const Eigen::Index row : {3, 20, 39}) {
        CHECK((made.row(row) - matrix.row(row)).norm() < 1e-4F);
    }
    CHECK((made - matrix).norm() > 1);
    const NestedBasis even = nestedBasis(matrix, covariance, 3, Eigen::VectorXd::Ones(40));
    const NestedBasis plain = nestedBasis(matrix, covariance, 3);
    CHECK((even.basis * even.projection - plain.basis * plain.projection).norm() < 1e-3F);
}

TEST_CASE("ranks and bounds are meant of the outputs that matter") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const PriorModel& model = *smallPrior().model;
    std::vector<double> weights(rows().size(), 0);
    weights[5] = 1;
    float bound = 0;
    const auto rankOf = [&](double tolerance, const std::vector<double>& of) {
        ReconstructOptions options{.centered = false, .tolerance = tolerance};
        options.weights = of;
        return PriorMaterial(model, rows(), samples, options).encode(samples, {&bound, 1}).ranks[0];
    };
    CHECK(rankOf(8, weights) <= rankOf(8, {}));
    const std::vector<float> shares =
        outputShares(model.samples, pairsOf(smallPrior().grid), weights);
    CHECK(std::accumulate(shares.begin(), shares.end(), 0.0F) == doctest::Approx(1));
    CHECK(std::ranges::count(shares, 0.0F) == std::ssize(shares) - 1);
}

TEST_CASE("a tolerance takes smaller models the larger it is, and its bound grows with them") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const PriorModel& model = *smallPrior().model;
    std::uint16_t last = 0xffff;
    for (const double tolerance : {1e-3, 1.0, 8.0, 60.0}) {
        const PriorMaterial material(model, rows(), samples,
                                     {.centered = false, .tolerance = tolerance});
        float bound = 0;
        const TexelCodes codes = material.encode(samples, {&bound, 1});
        CHECK(codes.ranks[0] <= last);
        last = codes.ranks[0];
        const bool isWhole = codes.ranks[0] == material.ranks().back();
        CHECK((isWhole || bound <= static_cast<float>(tolerance)));
        CHECK(bound > 0);
    }
    CHECK(last == kConstantRank);
}

TEST_CASE("a whole texel of a ladder has the bits of a model without one") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const std::vector<Rgb> plain = estimated(samples);
    const std::vector<Rgb> whole = estimated(samples, {.tolerance = 1e-6});
    CHECK(plain == whole);
}

TEST_CASE("left-out samples are predicted as by the closed form") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const PriorModel& model = *smallPrior().model;
    const std::vector<PriorTerm> terms = PriorMaterial(model, rows(), samples, {}).terms();
    Eigen::VectorXd luminance(static_cast<Eigen::Index>(samples.size()));
    for (std::size_t k = 0; k < samples.size(); ++k) {
        luminance(static_cast<Eigen::Index>(k)) =
            static_cast<double>(samples[k].r + samples[k].g + samples[k].b) / 3;
    }
    SampleBlocks single;
    for (Eigen::Index k = 0; k < luminance.size(); ++k) single.push_back({k});
    const LeaveOutMap map = leaveOutMap(model, terms, single);
    const LogSamples logs = logSamples(model, luminance);
    const Eigen::VectorXd predicted =
        ((logs.z - (map.matrix * logs.z - map.offset)).array().exp() - kPriorFloor).max(0.0) *
        logs.scale;
    const Eigen::VectorXd closed = leaveOneOut(model, terms, luminance);
    CHECK((predicted - closed).cwiseAbs().maxCoeff() < 1e-9 * closed.maxCoeff());
}

TEST_CASE("a clipped highlight is put back above the clip, and no other sample is touched") {
    const PriorModel& model = *smallPrior().model;
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    Eigen::MatrixX3d clipped(static_cast<Eigen::Index>(samples.size()), 3);
    Eigen::Index cut = 0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        const double brightest = static_cast<double>(samples[k].r);
        clipped.row(row) << std::min(brightest, 0.6),
            std::min(static_cast<double>(samples[k].g), 0.6),
            std::min(static_cast<double>(samples[k].b), 0.6);
        cut += brightest >= 0.6 ? 1 : 0;
    }
    REQUIRE(cut > 0);
    const auto terms = chooseTerms(model, clipped.rowwise().sum() / 3, 0);
    const Eigen::MatrixX3d restored = CensoredSamples(model, terms, 0.6).restored(clipped);
    for (Eigen::Index row = 0; row < clipped.rows(); ++row) {
        if (clipped.row(row).maxCoeff() < 0.6) {
            CHECK(restored.row(row) == clipped.row(row));
        } else {
            CHECK(restored.row(row).sum() >= clipped.row(row).sum() - 1e-9);
        }
    }
    const Eigen::MatrixX3d all = Eigen::MatrixX3d::Ones(clipped.rows(), 3);
    CHECK(CensoredSamples(model, terms, 0.6).restored(all) == all);
}

TEST_CASE("a model for fewer samples is the model trained for them") {
    const PriorModel& model = *smallPrior().model;
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < model.samples.size(); ++k) {
        if (k % 3 != 1) kept.push_back(k);
    }
    const PriorModel fewer = withSamples(model, kept);
    REQUIRE(fewer.samples.size() == kept.size());
    const auto spectrumOf = [](const PriorModel& m, std::size_t c, std::size_t s) {
        return precisionOf(m, {false, c, s, 1e-2, 1}).inverse().eval();
    };
    for (const std::size_t spectrum : {0U, 5U}) {
        const Eigen::MatrixXd whole = spectrumOf(model, 2, spectrum);
        const Eigen::MatrixXd part = whole(kept, kept);
        CHECK((spectrumOf(fewer, 2, spectrum) - part).norm() < 1e-6 * part.norm());
    }
    CHECK(fewer.classes[2].cross.col(1) ==
          model.classes[2].cross.col(static_cast<Eigen::Index>(kept[1])));
}

TEST_CASE("a model of other samples or another grid is refused") {
    ReconstructionTask task = taskFor(smallPrior().samplesOf(plastic));
    task.output = AngularGrid(ubo81Directions());
    CHECK_THROWS_AS(methodFromName("prior").make(task), std::invalid_argument);
    task.prior = nullptr;
    CHECK_THROWS_AS(methodFromName("prior").make(task), std::invalid_argument);
}

TEST_CASE("an ABRDF and its estimate have the same bits with the registers of every processor") {
    const SmallPrior& prior = smallPrior();
    for (const int rank : {0, 8}) {
        std::vector<Rgb> first;
        std::vector<float> firstEstimates;
        for (const int bytes : {16, 32, 64}) {
            const RegisterLimit limit(bytes);
            ReconstructionTask task = taskFor(prior.samplesOf(plastic));
            task.options.rank = rank;
            const auto reconstructor = methodFromName("prior").make(task);
            AbrdfTile samples(3, prior.samples.count());
            for (std::size_t t = 0; t < samples.texelCount(); ++t) {
                for (std::size_t k = 0; k < samples.valuesPerTexel(); ++k) {
                    samples[t][k] = (0.2F + 0.1F * static_cast<float>((t * 7 + k * 3) % 5)) *
                                    plastic(prior.samples.directions[k]);
                }
            }
            const ReconstructedTexels texels =
                reconstructTexels(samples, prior.grid, *reconstructor);
            const auto values = texels.abrdfs.values();
            if (first.empty()) first.assign(values.begin(), values.end());
            if (firstEstimates.empty()) firstEstimates = texels.estimates;
            CHECK(std::ranges::equal(values, first));
            CHECK(texels.estimates == firstEstimates);
        }
    }
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("threads");

TEST_CASE("a texel's ABRDF has the same bits alone, among others, and on any number of threads") {
    const SmallPrior& prior = smallPrior();
    AbrdfTile samples(75, prior.samples.count());
    for (std::size_t t = 0; t < samples.texelCount(); ++t) {
        for (std::size_t k = 0; k < samples.valuesPerTexel(); ++k) {
            samples[t][k] = (0.2F + 0.01F * static_cast<float>((t * 7 + k * 3) % 50)) *
                            plastic(prior.samples.directions[k]);
        }
    }
    const auto reconstructor = methodFromName("prior").make(taskFor(prior.samplesOf(plastic)));
    std::vector<Rgb> first;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        const ReconstructedTexels texels = reconstructTexels(samples, prior.grid, *reconstructor);
        const auto values = texels.abrdfs.values();
        if (first.empty()) first.assign(values.begin(), values.end());
        CHECK(std::ranges::equal(values, first));
    }
    const std::size_t pairs = prior.grid.pairCount();
    for (const std::size_t texel : {0U, 31U, 32U, 74U}) {
        AbrdfTile one(1, prior.samples.count());
        std::ranges::copy(samples[texel], one[0].begin());
        const ReconstructedTexels alone = reconstructTexels(one, prior.grid, *reconstructor);
        CHECK(std::ranges::equal(alone.abrdfs[0], std::span(first).subspan(texel * pairs, pairs)));
    }
}

TEST_SUITE_END();
