// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/inspect/stack_facts.h"

#include "abrdf/for_each_texel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// What one image told.
struct ImageFacts {
    std::string error;  ///< Empty where it was read.
    float least = std::numeric_limits<float>::infinity();
    float greatest = -std::numeric_limits<float>::infinity();
    std::uint64_t nonfinite = 0;
    Rgb mean = {kNaN, kNaN, kNaN};
};

ImageFacts factsOf(const BtfReader& reader, std::size_t pair, const Linearizer& linearizer) {
    ImageFacts facts;
    try {
        const EncodedImage image = reader.read(pair);
        const auto add = [&](float value) {
            if (!std::isfinite(value)) {
                ++facts.nonfinite;
                return;
            }
            facts.least = std::min(facts.least, value);
            facts.greatest = std::max(facts.greatest, value);
        };
        if (const auto* codes = std::get_if<std::vector<std::uint8_t>>(&image.rgb)) {
            for (const std::uint8_t code : *codes) add(static_cast<float>(code) / 255.0F);
        } else {
            for (const float value : std::get<std::vector<float>>(image.rgb)) add(value);
        }
        averageImage(image, linearizer, 1, 1, {&facts.mean, 1});
    } catch (const std::runtime_error& error) {
        facts.error = error.what();
    }
    return facts;
}

}  // namespace

StackFacts stackFacts(const BtfReader& reader, const Linearizer& linearizer,
                      const ProgressSink& progress) {
    const BtfDescription& description = reader.description();
    std::vector<std::size_t> present;
    for (std::size_t pair = 0; pair < description.present.size(); ++pair) {
        if (description.present[pair] != 0) present.push_back(pair);
    }
    std::vector<ImageFacts> facts(present.size());
    std::atomic<std::size_t> done = 0;
    forEachImage(present.size(), [&](std::size_t i) {
        facts[i] = factsOf(reader, present[i], linearizer);
        if (progress) progress({"inspect", "images", ++done, present.size()});
    });
    StackFacts all;
    std::vector<Rgb> means(description.grid.pairCount(), Rgb{kNaN, kNaN, kNaN});
    for (std::size_t i = 0; i < facts.size(); ++i) {
        const ImageFacts& one = facts[i];
        if (!one.error.empty()) all.unreadable.push_back(one.error);
        all.least = std::min(all.least, one.least);
        all.greatest = std::max(all.greatest, one.greatest);
        all.nonfinite += one.nonfinite;
        means[present[i]] = one.mean;
    }
    all.reciprocity = reciprocityOf(description.grid, means, description.cosine);
    return all;
}

}  // namespace abrdf
