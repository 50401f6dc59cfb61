// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/greedy_cache.h"

#include "abrdf/content_hash.h"
#include "abrdf/output_file.h"
#include "pipeline/train/prior_cache.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

/// A pair and its error a line; nothing where it is not `count` of them.
std::optional<ChosenPairs> readChoice(const fs::path& file, std::size_t count,
                                      std::size_t pairCount) {
    std::ifstream stream(file);
    ChosenPairs chosen;
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t pair = 0;
        double error = 0;
        if (!(stream >> pair >> error) || pair >= pairCount) return {};
        chosen.pairs.push_back(pair);
        chosen.errors.push_back(error);
    }
    std::string rest;
    if (stream >> rest) return {};
    return chosen;
}

void keepChoice(const fs::path& folder, const fs::path& file, const ChosenPairs& chosen,
                const MessageSink& warn) {
    std::string text;
    for (std::size_t i = 0; i < chosen.pairs.size(); ++i) {
        text += fmt::format("{} {}\n", chosen.pairs[i], chosen.errors[i]);
    }
    try {
        fs::create_directories(folder);
        writeWholeFile(file, text);
    } catch (const std::runtime_error& error) {
        if (warn) warn(fmt::format("the plan is not kept: {}", error.what()));
    }
}

}  // namespace

ChosenPairs cachedChoice(const std::string& key, std::size_t count, std::size_t pairCount,
                         const std::function<ChosenPairs()>& choose, const MessageSink& warn) {
    const auto folder = cacheFolder();
    if (!folder) return choose();
    const fs::path file = *folder / fmt::format("greedy-{:016x}", contentHash(key));
    if (auto kept = readChoice(file, count, pairCount)) return *std::move(kept);
    ChosenPairs chosen = choose();
    keepChoice(*folder, file, chosen, warn);
    return chosen;
}

}  // namespace abrdf
