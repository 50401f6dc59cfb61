// SPDX-License-Identifier: BSD-3-Clause
//
// The part of ColorConfig that knows displays, views and looks.
#include "color/color_config.h"
#include "color/near_names.h"
#include "color/ocio_handles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

namespace OCIO = OCIO_NAMESPACE;

namespace {

// The one of `names` that was meant by `typed`; the case of letters does not count.
std::string chosen(const std::string& typed, const std::vector<std::string>& names,
                   const std::string& origin, const std::string& what) {
    const auto exact = std::ranges::find(names, typed);
    if (exact != names.end()) return *exact;
    const auto same = std::ranges::find_if(
        names, [&](const std::string& name) { return sameLetters(name, typed); });
    if (same != names.end()) return *same;
    std::vector<std::vector<std::string>> known;
    for (const std::string& name : names) known.push_back({name});
    const std::vector<std::string> near = nearNames(typed, known);
    throw std::runtime_error(fmt::format(
        "The colour config '{}' has no {} '{}'.{} It has: {}.", origin, what, typed,
        near.empty() ? "" : fmt::format(" Did you mean '{}'?", fmt::join(near, "' or '")),
        names.empty() ? "none" : fmt::format("'{}'", fmt::join(names, "', '"))));
}

// "+a, -b" -> {"a", "b"}: what a list of looks names.
std::vector<std::string> looksIn(const std::string& list) {
    std::vector<std::string> looks;
    std::string name;
    for (const char c : list + ',') {
        if (c != ',' && c != ':' && c != '|') {
            name += c;
            continue;
        }
        const std::size_t first = name.find_first_not_of(" +-");
        if (first != std::string::npos) {
            looks.push_back(name.substr(first, name.find_last_not_of(' ') + 1 - first));
        }
        name.clear();
    }
    return looks;
}

}  // namespace

std::vector<std::string> ColorConfig::displayNames() const {
    std::vector<std::string> names;
    for (int i = 0; i < loaded_->config->getNumDisplays(); ++i) {
        names.emplace_back(loaded_->config->getDisplay(i));
    }
    return names;
}

std::vector<std::string> ColorConfig::viewNames(const std::string& display) const {
    const std::string name = chosen(display, displayNames(), origin_, "display");
    std::vector<std::string> names;
    for (int i = 0; i < loaded_->config->getNumViews(name.c_str()); ++i) {
        names.emplace_back(loaded_->config->getView(name.c_str(), i));
    }
    return names;
}

std::vector<std::string> ColorConfig::lookNames() const {
    std::vector<std::string> names;
    for (int i = 0; i < loaded_->config->getNumLooks(); ++i) {
        names.emplace_back(loaded_->config->getLookNameByIndex(i));
    }
    return names;
}

DisplayView ColorConfig::resolved(const DisplayView& wanted, const std::string& from) const {
    const OCIO::Config& config = *loaded_->config;
    const std::string space = spaceName(from);
    DisplayView shown = wanted;
    shown.display = chosen(wanted.display.empty() ? config.getDefaultDisplay() : wanted.display,
                           displayNames(), origin_, "display");
    const char* view = config.getDefaultView(shown.display.c_str(), space.c_str());
    shown.view = chosen(wanted.view.empty() ? view : wanted.view, viewNames(shown.display), origin_,
                        fmt::format("view of the display '{}' called", shown.display));
    for (const std::string& look : looksIn(wanted.look)) chosen(look, lookNames(), origin_, "look");
    return shown;
}

std::vector<std::string> ColorConfig::encodedSpace(const DisplayView& shown,
                                                   const std::string& from) const {
    const DisplayView names = resolved(shown, from);
    const std::string space =
        loaded_->config->getDisplayViewColorSpaceName(names.display.c_str(), names.view.c_str());
    return aliases(space == OCIO::OCIO_VIEW_USE_DISPLAY_NAME ? names.display : space);
}

ColorTransform ColorConfig::displayTransform(const std::string& from,
                                             const DisplayView& shown) const {
    const DisplayView names = resolved(shown, from);
    const std::string source = spaceName(from);
    if (isData(source)) {
        throw std::runtime_error(
            fmt::format("'{}' of the colour config '{}' is a space of data, which no display shows",
                        source, origin_));
    }
    ColorTransform result;
    try {
        const auto view = OCIO::DisplayViewTransform::Create();
        view->setSrc(source.c_str());
        view->setDisplay(names.display.c_str());
        view->setView(names.view.c_str());
        const auto pipeline = OCIO::LegacyViewingPipeline::Create();
        pipeline->setDisplayViewTransform(view);
        pipeline->setLooksOverrideEnabled(!names.look.empty());
        pipeline->setLooksOverride(names.look.c_str());
        result.processor_ =
            std::make_shared<const ColorTransform::Processor>(ColorTransform::Processor{exactCpu(
                pipeline->getProcessor(loaded_->config, loaded_->config->getCurrentContext()))});
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format(
            "The colour config '{}' cannot show '{}' on the display '{}' with the view '{}': {}. "
            "Choose another with --display and --view, or another config with --colorconfig.",
            origin_, source, names.display, names.view, reason(error)));
    }
    return result;
}

}  // namespace abrdf
