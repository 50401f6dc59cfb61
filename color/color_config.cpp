// SPDX-License-Identifier: BSD-3-Clause
#include "color/color_config.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace abrdf {

namespace OCIO = OCIO_NAMESPACE;

namespace {

// Only foldings that leave the values alone: no approximate powers, no baking into tables.
constexpr OCIO::OptimizationFlags kOptimization = OCIO::OPTIMIZATION_LOSSLESS;

// OCIO widens a row to RGBA in a buffer of its own; short rows keep that in the cache.
constexpr std::size_t kRow = 4096;

// OCIO's message as the middle of a sentence: one line, no full stop.
std::string reason(const std::exception& error) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.erase(text.find_last_not_of(". ") + 1);
    return text;
}

// Lower-case letters and digits alone: people do not agree on the rest of "Linear Rec.709 (sRGB)".
std::string folded(std::string_view name) {
    std::string letters;
    for (const char c : name) {
        if (c >= 'A' && c <= 'Z') {
            letters += static_cast<char>(c - 'A' + 'a');
        } else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
            letters += c;
        }
    }
    return letters;
}

// The fewest insertions, deletions, replacements and swaps of neighbours from a to b: Levenshtein's
// distance with Damerau's fourth error, for "ACESgc" is one slip of the hand.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> beforeLast, last, row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        beforeLast = std::exchange(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
            }
        }
    }
    return row.back();
}

// How far `name` is from what was `typed`; nothing where they have too little in common.
std::optional<std::size_t> farness(const std::string& typed, const std::string& name) {
    constexpr std::size_t kShortestPart = 2;
    const std::string a = folded(typed);
    const std::string b = folded(name);
    const std::size_t distance = editDistance(a, b);
    if (distance <= std::max<std::size_t>(1, std::min(a.size(), b.size()) / 4)) return distance;
    const bool part = a.size() >= kShortestPart && b.find(a) != std::string::npos;
    return part ? std::optional(distance) : std::nullopt;
}

std::vector<std::string> namesOf(const OCIO::ColorSpace& space) {
    std::vector<std::string> names{space.getName()};
    for (std::size_t i = 0; i < space.getNumAliases(); ++i) names.emplace_back(space.getAlias(i));
    return names;
}

std::vector<std::string> spaceNamesOf(const OCIO::Config& config) {
    constexpr auto kReference = OCIO::SEARCH_REFERENCE_SPACE_ALL;
    constexpr auto kVisibility = OCIO::COLORSPACE_ALL;
    std::vector<std::string> names;
    const int count = config.getNumColorSpaces(kReference, kVisibility);
    for (int i = 0; i < count; ++i) {
        names.emplace_back(config.getColorSpaceNameByIndex(kReference, kVisibility, i));
    }
    return names;
}

// The names nearest to what was typed, best first: at most one a space, and the roles.
std::vector<std::string> nearNames(const OCIO::Config& config, const std::string& typed) {
    constexpr std::size_t kMost = 3;
    std::vector<std::pair<std::size_t, std::string>> found;
    const auto consider = [&](const std::vector<std::string>& names) {
        std::optional<std::pair<std::size_t, std::string>> best;
        for (const std::string& name : names) {
            const auto far = farness(typed, name);
            if (far && (!best || *far < best->first)) best.emplace(*far, name);
        }
        if (best) found.push_back(*best);
    };
    for (const std::string& space : spaceNamesOf(config)) {
        consider(namesOf(*config.getColorSpace(space.c_str())));
    }
    for (int i = 0; i < config.getNumRoles(); ++i) consider({config.getRoleName(i)});

    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    found.resize(std::min(found.size(), kMost));
    std::vector<std::string> names;
    for (auto& [far, name] : found) names.push_back(std::move(name));
    return names;
}

OCIO::ConstConfigRcPtr shippedConfig() {
    std::istringstream text{std::string(shippedColorConfig())};
    return OCIO::Config::CreateFromStream(text);
}

OCIO::ConstConfigRcPtr configFromFile(const std::string& file) {
    // yaml-cpp 0.7 would report this in words of iostream, and leak.
    if (std::filesystem::is_directory(file)) throw std::runtime_error("It is a folder");
    return OCIO::Config::CreateFromFile(file.c_str());
}

}  // namespace

struct ColorTransform::Processor {
    OCIO::ConstCPUProcessorRcPtr cpu;
};

struct ColorConfig::Loaded {
    OCIO::ConstConfigRcPtr config;
};

bool ColorTransform::isIdentity() const {
    return !processor_ || processor_->cpu->isNoOp();
}

bool ColorTransform::isPerChannel() const {
    return !processor_ || !processor_->cpu->hasChannelCrosstalk();
}

void ColorTransform::apply(std::span<Rgb> colors) const {
    static_assert(std::is_standard_layout_v<Rgb> && sizeof(Rgb) == 3 * sizeof(float));
    if (isIdentity()) return;
    for (; !colors.empty(); colors = colors.subspan(std::min(kRow, colors.size()))) {
        const auto width = static_cast<long>(std::min(kRow, colors.size()));
        OCIO::PackedImageDesc row(colors.data(), width, 1, 3);
        processor_->cpu->apply(row);
    }
}

ColorConfig ColorConfig::load(const std::optional<std::filesystem::path>& file) {
    // All that matters is thrown; OCIO_LOGGING_LEVEL still turns OCIO's own voice on.
    OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE);
    const char* environment = std::getenv("OCIO");
    const bool fromEnvironment = !file && environment && *environment;
    const bool shipped = !file && !fromEnvironment;

    ColorConfig result;
    if (file) result.origin_ = file->string();
    if (fromEnvironment) result.origin_ = environment;
    if (shipped) result.origin_ = "shipped";
    try {
        const OCIO::ConstConfigRcPtr config =
            shipped ? shippedConfig() : configFromFile(result.origin_);
        config->validate();
        result.loaded_ = std::make_shared<const Loaded>(Loaded{config});
    } catch (const std::exception& error) {
        const std::string_view advice =
            fromEnvironment ? "The environment variable OCIO names it: correct or unset that, or "
                              "name another config with --colorconfig."
                            : "Name a valid OpenColorIO config with --colorconfig, or leave that "
                              "out to have the one of $OCIO or the shipped one.";
        throw std::runtime_error(fmt::format("The colour config '{}' does not load: {}. {}",
                                             result.origin_, reason(error), advice));
    }
    return result;
}

std::string ColorConfig::spaceName(const std::string& nameOrRole) const {
    if (const auto space = loaded_->config->getColorSpace(nameOrRole.c_str())) {
        return space->getName();
    }
    const std::vector<std::string> near = nearNames(*loaded_->config, nameOrRole);
    const std::string question =
        near.empty() ? std::string()
                     : fmt::format(" Did you mean '{}'?", fmt::join(near, "' or '"));
    throw std::runtime_error(
        fmt::format("The colour config '{}' has no colour space '{}'.{} It has: '{}'.", origin_,
                    nameOrRole, question, fmt::join(spaceNames(), "', '")));
}

std::vector<std::string> ColorConfig::spaceNames() const {
    return spaceNamesOf(*loaded_->config);
}

std::vector<std::string> ColorConfig::aliases(const std::string& name) const {
    return namesOf(*loaded_->config->getColorSpace(spaceName(name).c_str()));
}

ColorTransform ColorConfig::transform(const std::string& from, const std::string& to) const {
    const std::string source = spaceName(from);
    const std::string target = spaceName(to);
    ColorTransform result;
    try {
        const auto processor = loaded_->config->getProcessor(source.c_str(), target.c_str());
        result.processor_ = std::make_shared<const ColorTransform::Processor>(
            ColorTransform::Processor{processor->getOptimizedCPUProcessor(
                OCIO::BIT_DEPTH_F32, OCIO::BIT_DEPTH_F32, kOptimization)});
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format(
            "The colour config '{}' cannot convert '{}' to '{}': {}. Choose other spaces, or "
            "another config with --colorconfig.",
            origin_, source, target, reason(error)));
    }
    return result;
}

}  // namespace abrdf
