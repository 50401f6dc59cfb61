// SPDX-License-Identifier: BSD-3-Clause
//
// A method that knows its error, from its texels to the file: tiles in any order, a stop at any
// moment, shards, both layouts, any number of threads.
#include "abrdf/content_hash.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "pipeline/convert/merge.h"
#include "pipeline/convert/tile_journal.h"
#include "pipeline/convert/write_atlas.h"
#include "pipeline/inspect/inspect.h"
#include "stages/read/atlas_reader.h"
#include "stages/read/atlas_tiles.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr int kWide = 30;
constexpr int kHigh = 40;

AngularGrid smallGrid() {
    return {regularDirections(1, 5), regularDirections(1, 7)};
}

/// What the method below says of a texel; of some it knows nothing.
float estimateOf(std::size_t texel) {
    return texel % 17 == 3 ? std::numeric_limits<float>::quiet_NaN()
                           : 0.25F * static_cast<float>(texel);
}

/// Gives back its samples, whose red is the number of the texel.
class KnowingReconstructor : public Reconstructor {
  public:
    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdfs) const override {
        std::ranges::copy(samples, abrdfs.begin());
    }
    bool knowsError() const override { return true; }
    void reconstructKnowing(std::span<const Rgb> samples, std::span<Rgb> abrdfs,
                            std::span<float> deltaE) const override {
        reconstruct(samples, abrdfs);
        const std::size_t pairs = samples.size() / deltaE.size();
        for (std::size_t t = 0; t < deltaE.size(); ++t) {
            deltaE[t] = estimateOf(static_cast<std::size_t>(samples[t * pairs].r));
        }
    }
    std::size_t texelsAtOnce() const override { return 4; }
    double multiplyAdds() const override { return 0; }
    double modelBytes() const override { return 0; }
};

/// One that knows nothing, but makes the same.
class SilentReconstructor : public KnowingReconstructor {
  public:
    bool knowsError() const override { return false; }
};

/// Rows [firstRow, firstRow + rows) of the map, on their way into an atlas.
struct Subject {
    AtlasHeader header;
    SampleSet samples;
    GrazingMap grazing;
    MemoryPlan memory;
    std::unique_ptr<TransposedTable> table;
    std::unique_ptr<Reconstructor> reconstructor = std::make_unique<KnowingReconstructor>();
};

Subject subjectOf(AtlasKind kind, int firstRow = 0, int rows = kHigh) {
    Subject subject;
    AtlasHeader& header = subject.header;
    header.grid = smallGrid();
    header.layout = {kind, kWide, rows, 5, 7};
    header.method = "measured";
    header.colorSpace = "Linear Rec.709 (sRGB)";
    header.interopId = "lin_rec709_scene";
    const std::size_t pairs = header.grid.pairCount();
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        subject.samples.directions.push_back(header.grid.pair(pair));
        subject.samples.sources.push_back({{pair, 1.0F}});
        subject.samples.pairs.push_back(pair);
    }
    subject.grazing =
        GrazingMap(header.grid, header.grid.maxTheta(), Grazing::kHold, Cosine::kKept);
    MemoryTask task{header.layout};
    task.images = task.samples = task.reconstructed = pairs;
    task.texelsAtOnce = 4;
    task.threads = threadsInUse();
    subject.memory = planMemory(task, std::uint64_t{1} << 30);
    const TileOrder order = texelOrderOf(header.layout);
    subject.table = std::make_unique<TransposedTable>(
        pairs, sizeof(Rgb), bandBegins(order, subject.memory.runsPerBand * subject.memory.runTiles),
        std::nullopt);
    std::vector<Rgb> texels(header.layout.texelCount());
    std::vector<Rgb> ordered(texels.size());
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        for (std::size_t t = 0; t < texels.size(); ++t) {
            texels[t] = {static_cast<float>(t + static_cast<std::size_t>(firstRow * kWide)),
                         static_cast<float>(pair), 0.5F};
        }
        order.reorder<Rgb>(texels, ordered);
        subject.table->store(
            pair, {reinterpret_cast<const char*>(ordered.data()), ordered.size() * sizeof(Rgb)});
    }
    return subject;
}

struct Stop : std::runtime_error {
    Stop() : std::runtime_error("stop") {}
};

/// Makes an atlas of it, or ends with Stop once so many tiles were written.
void write(const Subject& subject, const fs::path& output, bool resume = false,
           std::size_t stopAt = std::numeric_limits<std::size_t>::max()) {
    const bool hasEstimate = subject.reconstructor->knowsError();
    TileJournal journal(output, {{"job", 1}}, PixelType::kHalf, resume);
    AtlasWriter writer(output, subject.header,
                       {journal.type(), Compression::kZip, true, journal.written(), hasEstimate});
    writer.keepEstimates(0, journal.estimates());
    if (journal.written().tiles == 0) journal.add({writer.written(), 0, {}});
    const ColorConfig colors = ColorConfig::load();
    const TexelMaker maker{
        TexelSlicer(subject.samples.pairs, subject.samples), *subject.reconstructor,
        subject.grazing,
        TexelFinisher(subject.header.grid, {colors.transform("scene_linear", "scene_linear")}),
        subject.header.grid.pairCount()};
    const auto make = [&](std::span<const Rgb> band, std::size_t inBand, std::size_t,
                          std::size_t count,
                          TexelMaker::Buffers& texels) { maker.make(band, inBand, count, texels); };
    const AtlasRun run{*subject.table, make,           maker.pairs, subject.header.layout,
                       subject.memory, journal.type(), false,       output.parent_path()};
    const auto told = [&](const TilesAdded& added) {
        journal.add(added);
        if (added.written.tiles >= stopAt) throw Stop();
    };
    if (!writeTiles(run, writer, told, {})) throw std::logic_error("nothing is to be cut");
    writer.finish({});
    journal.remove();
}

/// The shards of an atlas, each a number of rows of tiles of the whole's angular layout.
std::vector<fs::path> writeShards(AtlasKind kind, const fs::path& folder) {
    const std::vector<int> rows = {0, 13, kHigh};
    const ordered_json job = {{"layout", nameOf(kind)},
                              {"texels", fmt::format("{}x{}", kWide, kHigh)},
                              {"compression", "zip"}};
    std::vector<fs::path> paths;
    for (int i = 1; i <= 2; ++i) {
        const auto first = static_cast<std::size_t>(i - 1);
        Subject shard = subjectOf(AtlasKind::kAngular, rows[first], rows[first + 1] - rows[first]);
        shard.header.job = job.dump();
        shard.header.shard = i;
        shard.header.shards = 2;
        paths.push_back(folder / fmt::format("part{}.exr", i));
        write(shard, paths.back());
    }
    return paths;
}

/// Does a file hold what the method said of each texel?
bool holdsEstimates(const fs::path& path) {
    const std::vector<float> read = readEstimates(path);
    if (read.size() != kWide * kHigh) return false;
    for (std::size_t t = 0; t < read.size(); ++t) {
        const float wanted = estimateOf(t);
        if (std::isnan(wanted) ? !std::isnan(read[t]) : read[t] != wanted) return false;
    }
    return true;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("estimates stand with their texels in both layouts, on one thread and on many") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.exr";
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        std::string bytes;
        for (const int threads : {1, 4}) {
            const ThreadLimit limit(threads);
            write(subjectOf(kind), path);
            CHECK(holdsEstimates(path));
            CHECK(readAtlas(path).at({7, 9, 2, 3}).r == 9 * kWide + 7);
            if (bytes.empty()) bytes = bytesOf(path);
            CHECK(bytesOf(path) == bytes);
        }
    }
}

TEST_CASE("a run that was stopped and went on ends with the same bytes, estimates and all") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.exr";
    const fs::path journal = folder.path() / ".a.exr.abrdf-journal";
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        const fs::path whole = folder.path() / "whole.exr";
        const Subject subject = subjectOf(kind);
        write(subject, whole);
        for (const std::string damage : {"none", "cut", "changed"}) {
            CAPTURE(damage);
            CHECK_THROWS_AS(write(subject, path, true, 5), Stop);
            CHECK_FALSE(fs::exists(path));
            std::string lines = bytesOf(journal);
            if (damage == "cut") lines.resize(lines.size() - 10);
            // The last digit before the line's end: of an estimate, or a spatial atlas's count.
            if (damage == "changed") {
                char& digit = lines[lines.rfind(" whole") - 1];
                digit = digit == '1' ? '2' : '1';
            }
            std::ofstream(journal, std::ios::binary) << lines;
            write(subject, path, true);
            CHECK(bytesOf(path) == bytesOf(whole));
            CHECK(holdsEstimates(path));
            fs::remove(path);
        }
    }
}

TEST_CASE("a journal gives back the bits of what it was told, and nothing after restart()") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.exr";
    const std::string data = "tiles";
    const std::vector<float> told = {0.1F, -0.0F, std::numeric_limits<float>::infinity(), 1e-40F};
    std::ofstream(partialBeside(path), std::ios::binary) << data;
    {
        TileJournal journal(path, {{"job", 1}}, PixelType::kHalf, false);
        journal.add({{2, data.size()}, contentHash(data), {}, 0, told});
    }
    TileJournal journal(path, {{"job", 1}}, PixelType::kHalf, true);
    CHECK(journal.written().tiles == 2);
    CHECK(journal.estimates() == told);
    CHECK(std::signbit(journal.estimates()[1]));
    journal.restart(PixelType::kFloat);
    CHECK(journal.estimates().empty());
}

TEST_CASE("shards with estimates, merged in any order, are the single run to the byte") {
    const TemporaryFolder folder;
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        MergeOptions merging;
        merging.shards = writeShards(kind, folder.path());
        std::ranges::reverse(merging.shards);
        merging.output = folder.path() / "merged.exr";
        const ordered_json report = merge(merging, {});
        CHECK(holdsEstimates(merging.output));
        Subject single = subjectOf(kind);
        single.header.job = readAtlasHeader(merging.output).job;
        write(single, folder.path() / "single.exr");
        CHECK(bytesOf(merging.output) == bytesOf(folder.path() / "single.exr"));
        CHECK(inspect(merging.output, {})["estimate"] == report["estimate"]);
    }
}

TEST_CASE("shards of which one tells its error and one does not are refused by name") {
    const TemporaryFolder folder;
    MergeOptions merging;
    merging.shards = writeShards(AtlasKind::kAngular, folder.path());
    merging.output = folder.path() / "merged.exr";
    Subject silent = subjectOf(AtlasKind::kAngular, 13, kHigh - 13);
    silent.header = readAtlasHeader(merging.shards[1]);
    silent.reconstructor = std::make_unique<SilentReconstructor>();
    write(silent, merging.shards[1]);
    CHECK(AtlasTiles(merging.shards[1]).estimates().empty());
    try {
        merge(merging, {});
        FAIL("it passed");
    } catch (const std::runtime_error& error) {
        CHECK(std::string(error.what()).find("part2.exr") != std::string::npos);
        CHECK(std::string(error.what()).find("error of its texels") != std::string::npos);
    }
}

TEST_CASE("inspect tells mean and 95 % quantile of the texels of which the error is known") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.exr";
    write(subjectOf(AtlasKind::kAngular), path);
    std::vector<double> known;
    for (std::size_t t = 0; t < kWide * kHigh; ++t) {
        if (t % 17 != 3) known.push_back(0.25 * static_cast<double>(t));
    }
    double sum = 0;
    for (const double value : known) sum += value;
    const double rank = 0.95 * static_cast<double>(known.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const double quantile =
        known[below] + (rank - std::floor(rank)) * (known[below + 1] - known[below]);
    const ordered_json report = inspect(path, {});
    CHECK(report["estimate"]["delta_e"].get<double>() ==
          doctest::Approx(sum / static_cast<double>(known.size())).epsilon(1e-9));
    CHECK(report["estimate"]["delta_e_95"].get<double>() ==
          doctest::Approx(quantile).epsilon(1e-6));
    CHECK(report["complete"] == true);
    CHECK(textOf(report).find("delta_e_95") != std::string::npos);
    fs::resize_file(path, fs::file_size(path) - 10);
    CHECK(inspect(path, {})["complete"] == false);

    Subject silent = subjectOf(AtlasKind::kAngular);
    silent.reconstructor = std::make_unique<SilentReconstructor>();
    write(silent, path);
    CHECK_FALSE(inspect(path, {}).contains("estimate"));
}

TEST_SUITE_END();
