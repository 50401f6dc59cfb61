// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/chart/method_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace abrdf {

namespace {

constexpr double kFigurePairs = 6561;  ///< Of the grid that figures are measured on.

void checkLimits(const MethodLimits& limits) {
    if (limits.tolerance && !(*limits.tolerance > 0)) {
        throw std::invalid_argument("the tolerance must be above 0 Delta E");
    }
    if (!limits.budget && !limits.tolerance && limits.strict) {
        throw std::invalid_argument("--strict needs --budget or --tolerance");
    }
}

bool isWithin(const MethodFigure& f, const MethodLimits& limits) {
    return (!limits.budget || f.microseconds <= *limits.budget) &&
           (!limits.tolerance || f.deltaE <= *limits.tolerance);
}

/// Those that the user left open: a method or a plan that was named stays. A plan that is not of
/// the figures' sizes counts as the nearest of them.
std::vector<MethodFigure> openFigures(std::vector<MethodFigure> figures, const MethodChoice& choice,
                                      const MethodLimits& limits) {
    if (!limits.methodIsOpen) {
        std::erase_if(figures, [&](const auto& f) { return f.size.method != choice.name; });
    }
    if (figures.empty() || choice.plan.isOpen()) return figures;
    const std::size_t colon = choice.plan.name.find(':');
    const double wanted = colon == std::string::npos
                              ? static_cast<double>(kPlanSamples)
                              : static_cast<double>(planNameFrom(choice.plan.name).bound);
    const auto distance = [&](const MethodFigure& f) {
        return std::abs(std::log(static_cast<double>(f.size.samples) / wanted));
    };
    const double least = distance(*std::ranges::min_element(figures, {}, distance));
    std::erase_if(figures, [&](const auto& f) { return distance(f) > least + 1e-9; });
    return figures;
}

}  // namespace

double microsecondsFromText(const std::string& text) {
    std::size_t end = 0;
    double value = 0;
    try {
        value = std::stod(text, &end);
    } catch (const std::exception&) {
        end = 0;
    }
    const std::string unit = text.substr(end);
    const double factor = unit == "us" ? 1 : unit == "ms" ? 1e3 : unit == "s" ? 1e6 : 0;
    if (end == 0 || factor == 0 || !(value > 0) || !std::isfinite(value)) {
        throw std::invalid_argument(
            fmt::format("'{}' is no time: write a number and us, ms or s, as 50us", text));
    }
    return value * factor;
}

LimitedChoice chooseWithin(std::vector<MethodFigure> figures, const MethodLimits& limits) {
    std::vector<MethodFigure> within;
    std::ranges::copy_if(figures, std::back_inserter(within),
                         [&](const auto& f) { return isWithin(f, limits); });
    const auto accurate = [](const MethodFigure& f) {
        return std::tuple(f.deltaE, f.microseconds);
    };
    const auto small = [](const MethodFigure& f) {
        return std::tuple(f.size.samples, f.microseconds);
    };
    if (!within.empty()) {
        return {limits.tolerance ? *std::ranges::min_element(within, {}, small)
                                 : *std::ranges::min_element(within, {}, accurate),
                true};
    }
    // Nothing is: the budget is kept before the tolerance.
    std::vector<MethodFigure> affordable;
    std::ranges::copy_if(figures, std::back_inserter(affordable), [&](const auto& f) {
        return !limits.budget || f.microseconds <= *limits.budget;
    });
    if (!affordable.empty()) return {*std::ranges::min_element(affordable, {}, accurate), false};
    return {*std::ranges::min_element(figures, {}, &MethodFigure::microseconds), false};
}

nlohmann::ordered_json settleMethod(MethodChoice& choice, const MethodLimits& limits,
                                    std::size_t pairs, const MessageSink& warn) {
    checkLimits(limits);
    if (!limits.budget && !limits.tolerance) return nullptr;
    KnownFigures known = knownFigures(warn);
    for (MethodFigure& f : known.figures) {
        f.microseconds *= static_cast<double>(pairs) / kFigurePairs;
    }
    const std::vector<MethodFigure> open = openFigures(known.figures, choice, limits);
    if (open.empty()) {
        throw std::invalid_argument(fmt::format(
            "nothing is known of the speed of {}; leave --method open, or calibrate with it",
            choice.name));
    }
    const auto [figure, isMet] = chooseWithin(open, limits);
    const std::string expected =
        fmt::format("{} with {} samples is expected at Delta E {:.2f} in {:.0f} us an ABRDF",
                    figure.size.method, figure.size.samples, figure.deltaE, figure.microseconds);
    if (!isMet && limits.strict) {
        throw std::runtime_error("nothing meets the budget and tolerance: the nearest, " +
                                 expected);
    }
    if (!isMet && warn) {
        warn("nothing meets the budget and tolerance; the nearest is taken: " + expected);
    }
    choice.name = figure.size.method;
    if (choice.plan.isOpen() &&
        methodFromName(figure.size.method).wish != SampleWish::kEverything) {
        const bool isPoster = methodFromName(figure.size.method).wish == SampleWish::kSlices;
        choice.plan.name =
            fmt::format("{}:{}", isPoster ? "poster" : "greedy", figure.size.samples);
    }
    if (limits.tolerance && methodFromName(choice.name).needsPrior) {
        choice.options.tolerance = *limits.tolerance;  // Each texel takes a rank of its own.
    } else if (choice.options.rank == 0) {
        choice.options.rank = figure.size.rank;
    }
    nlohmann::ordered_json report = {{"method", choice.name},
                                     {"plan", choice.plan.name},
                                     {"rank", choice.options.rank},
                                     {"expected_delta_e", figure.deltaE},
                                     {"expected_microseconds", figure.microseconds},
                                     {"figures", known.origin},
                                     {"met", isMet}};
    if (limits.budget) report["budget"] = *limits.budget;
    if (limits.tolerance) report["tolerance"] = *limits.tolerance;
    return report;
}

}  // namespace abrdf
