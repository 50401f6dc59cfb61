// SPDX-License-Identifier: BSD-3-Clause
#include "color/color_config.h"

#include "color/known_space.h"
#include "color/near_names.h"
#include "color/ocio_handles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace abrdf {

namespace OCIO = OCIO_NAMESPACE;

namespace {

// OCIO widens a row to RGBA in a buffer of its own; short rows keep that in the cache.
constexpr std::size_t kRow = 4096;

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

// Names that people may have meant: those of each space, and each role.
std::vector<std::vector<std::string>> knownNames(const OCIO::Config& config) {
    std::vector<std::vector<std::string>> names;
    for (const std::string& space : spaceNamesOf(config)) {
        names.push_back(namesOf(*config.getColorSpace(space.c_str())));
    }
    for (int i = 0; i < config.getNumRoles(); ++i) names.push_back({config.getRoleName(i)});
    return names;
}

// " Did you mean 'a' or 'b'?", or nothing.
std::string question(const std::string& typed, const std::vector<std::vector<std::string>>& known) {
    const std::vector<std::string> near = nearNames(typed, known);
    return near.empty() ? std::string()
                        : fmt::format(" Did you mean '{}'?", fmt::join(near, "' or '"));
}

// Roles of OpenColorIO that a config may or may not have.
bool isStandardRole(const std::string& name) {
    constexpr std::array<std::string_view, 12> kRoles{
        "default",       "reference",        "data",
        "color_picking", "scene_linear",     "compositing_log",
        "color_timing",  "texture_paint",    "matte_paint",
        "rendering",     "aces_interchange", "cie_xyz_d65_interchange"};
    return std::ranges::any_of(kRoles, [&](std::string_view role) { return name == role; });
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
    const std::string asked = question(nameOrRole, knownNames(*loaded_->config));
    if (isStandardRole(nameOrRole)) {
        throw std::runtime_error(
            fmt::format("The colour config '{}' lacks the role '{}', which this job needs.{} Give "
                        "it that role, "
                        "or name another config with --colorconfig.",
                        origin_, nameOrRole, asked));
    }
    throw std::runtime_error(
        fmt::format("The colour config '{}' has no colour space '{}'.{} It has: '{}'.", origin_,
                    nameOrRole, asked, fmt::join(spaceNames(), "', '")));
}

std::vector<std::string> ColorConfig::spaceNames() const {
    return spaceNamesOf(*loaded_->config);
}

std::vector<std::string> ColorConfig::aliases(const std::string& name) const {
    return namesOf(*loaded_->config->getColorSpace(spaceName(name).c_str()));
}

bool ColorConfig::isData(const std::string& name) const {
    return loaded_->config->getColorSpace(spaceName(name).c_str())->isData();
}

bool ColorConfig::has(const std::string& nameOrRole) const {
    return loaded_->config->getColorSpace(nameOrRole.c_str()) != nullptr;
}

bool ColorConfig::reaches(const std::string& name) const {
    return has(name) ||
           (loaded_->config->hasRole(OCIO::ROLE_INTERCHANGE_SCENE) && knownSpace({name}));
}

ColorTransform ColorConfig::transform(const std::string& from, const std::string& to) const {
    // Each end with its own config: this one, or the shipped one beyond aces_interchange.
    struct End {
        OCIO::ConstConfigRcPtr config;
        std::string name;
    };
    const auto endOf = [&](const std::string& name) -> End {
        if (has(name) || !reaches(name)) {
            return {loaded_->config, spaceName(name)};
        }
        return {shippedConfig(), std::string(ocioName(*knownSpace({name})))};
    };
    const End source = endOf(from);
    const End target = endOf(to);
    ColorTransform result;
    try {
        const auto processor =
            source.config == target.config
                ? source.config->getProcessor(source.name.c_str(), target.name.c_str())
                : OCIO::Config::GetProcessorFromConfigs(source.config, source.name.c_str(),
                                                        target.config, target.name.c_str());
        result.processor_ = std::make_shared<const ColorTransform::Processor>(
            ColorTransform::Processor{exactCpu(processor)});
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format(
            "The colour config '{}' cannot convert '{}' to '{}': {}. Choose other spaces, or "
            "another config with --colorconfig.",
            origin_, source.name, target.name, reason(error)));
    }
    return result;
}

}  // namespace abrdf
