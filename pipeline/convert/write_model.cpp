// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/write_model.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/model_atlas.h"
#include "stages/write/model_writer.h"

#include <fmt/format.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace abrdf {

WrittenAtlas writeModel(const ConvertJob& job, const ConvertOptions& options,
                        const TransposedTable& table, const TexelSlicer& slicer,
                        const Reconstructor& reconstructor, const ProgressSink& progress) {
    if (reconstructor.model() == nullptr) {
        throw std::runtime_error(fmt::format(
            "{}: {} does not make texels of few numbers here; use --method prior without "
            "--per-texel, or another --layout",
            options.output.string(), job.method.name));
    }
    const std::size_t texels = job.layout().texelCount();
    ModelAtlas atlas{job.header, *reconstructor.model(),
                     PackedCodes(reconstructor.model()->rule(), texels), std::vector<float>(texels),
                     std::vector<float>(texels)};
    std::vector<char> buffer;
    std::atomic<std::size_t> done = 0;
    for (std::size_t b = 0; b < table.bands(); ++b) {
        const std::span<const char> bytes = table.band(b, buffer);
        const std::span<const Rgb> band(reinterpret_cast<const Rgb*>(bytes.data()),
                                        bytes.size() / sizeof(Rgb));
        const std::size_t first = table.bandBegin(b);
        const std::size_t count = table.bandBegin(b + 1) - first;
        const auto run = [&](std::size_t begin, std::size_t end) {
            std::vector<Rgb> samples((end - begin) * slicer.sampleCount());
            slicer.slice(band, begin, samples);
            const std::span<float> estimates =
                std::span(atlas.estimates).subspan(first + begin, end - begin);
            atlas.texels.store(first + begin, reconstructor.encode(samples, estimates));
            for (std::size_t t = begin; t < end; ++t) {
                atlas.most[first + t] = mostOfSamples(std::span(samples).subspan(
                    (t - begin) * slicer.sampleCount(), slicer.sampleCount()));
            }
            if (progress) progress({"reconstruct", "texels", done += end - begin, texels});
        };
        forEachTexelBlock(count, reconstructor.texelsAtOnce(), run);
    }
    WrittenAtlas written;
    written.counts = job.header.counts;
    written.type = options.pixel == PixelChoice::kHalf ? PixelType::kHalf : PixelType::kFloat;
    written.bytes = writeModelAtlas(options.output, atlas, written.type);
    written.estimates = std::move(atlas.estimates);
    return written;
}

}  // namespace abrdf
