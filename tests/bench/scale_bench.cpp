// SPDX-License-Identifier: BSD-3-Clause
//
// Whole maps as a program against what they cannot avoid: decoding the images, writing the bytes,
// compressing them. Then how time and memory grow with the texels, what a second thread brings, and
// two shards at once beside one run.
//   scale_bench DATABASE.zip [TEXELS=256 [PART]]      from: abrdf demo DATABASE.zip --size 256
// PART: measured, rank, full, one, growth or threads alone.
#include "abrdf/output_file.h"
#include "pipeline/batch/child_process.h"
#include "stages/read/atlas_tiles.h"
#include "tests/bench/decode_limit.h"
#include "tests/bench/duel.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfTiledOutputFile.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iostream>

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kRounds = 3;

struct Bench {
    fs::path program;
    fs::path database;
    fs::path folder;
    std::string texels;

    struct Run {
        double seconds = 0;
        double megabytes = 0;  ///< VmHWM.
        json report;
    };

    abrdf::ChildProcess start(const std::string& options, const fs::path& atlas) const {
        std::vector<std::string> words = {program, "convert", database,         "-o",
                                          atlas,   "--json",  "--progress=none"};
        for (std::size_t begin = 0; begin < options.size();) {
            const auto end = std::min(options.find(' ', begin), options.size());
            words.push_back(options.substr(begin, end - begin));
            begin = end + 1;
        }
        return abrdf::ChildProcess(words);
    }

    static json finish(abrdf::ChildProcess& child) {
        while (true) {
            if (const auto ended = child.poll()) {
                if (ended->status != 0) throw std::runtime_error(ended->err);
                return json::parse(ended->out);
            }
            usleep(1000);
        }
    }

    /// The median run of a few; the atlas stays.
    Run convert(const std::string& options, std::size_t rounds = kRounds) const {
        std::vector<Run> runs;
        for (std::size_t i = 0; i < rounds; ++i) {
            fs::remove(atlas());
            Run run;
            run.seconds = secondsOf([&] {
                auto child = start(options, atlas());
                run.report = finish(child);
            });
            run.megabytes = run.report["peak_memory"].get<double>() / (1 << 20);
            runs.push_back(run);
        }
        std::ranges::sort(runs, {}, &Run::seconds);
        return runs[runs.size() / 2];
    }

    fs::path atlas() const { return folder / "atlas.exr"; }
};

/// write(2) of so many bytes, in pieces of 4 MB, to the disk of the atlas, and its fsync.
double writeAlone(const fs::path& folder, std::uint64_t bytes) {
    const fs::path path = folder / "limit";
    const std::vector<char> piece(std::size_t{4} << 20, 1);
    const double seconds = secondsOf([&] {
        const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        for (std::uint64_t done = 0; done < bytes;) {
            const auto count = write(file, piece.data(), std::min(piece.size(), bytes - done));
            if (count <= 0) throw std::runtime_error("the disk is full");
            done += static_cast<std::uint64_t>(count);
        }
        fsync(file);
        close(file);
    });
    fs::remove(path);
    return seconds;
}

/// OpenEXR alone writing the same pixels in the same tiles with zip, on its own threads.
double exrAlone(const fs::path& atlas, const fs::path& folder) {
    const abrdf::AtlasTiles tiles(atlas);
    const auto& layout = tiles.header().layout;
    const auto& order = tiles.order();
    const int width = layout.width();
    const int height = layout.height();
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<half> planes(3 * pixels);
    for (std::size_t i = 0; i < order.tiles(); ++i) {
        const auto tile = order.tile(i);
        const std::vector<abrdf::Rgb> own = tiles.pixels(i);
        const int w = tile.width * layout.views;
        for (std::size_t p = 0; p < own.size(); ++p) {
            const auto x =
                static_cast<std::size_t>(tile.x * layout.views) + p % static_cast<std::size_t>(w);
            const auto y =
                static_cast<std::size_t>(tile.y * layout.lights) + p / static_cast<std::size_t>(w);
            const std::size_t at = y * static_cast<std::size_t>(width) + x;
            planes[at] = own[p].r;
            planes[pixels + at] = own[p].g;
            planes[2 * pixels + at] = own[p].b;
        }
    }
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.setTileDescription({static_cast<unsigned>(order.tileWidth() * layout.views),
                               static_cast<unsigned>(order.tileHeight() * layout.lights)});
    Imf::FrameBuffer buffer;
    std::size_t plane = 0;
    for (const char* channel : {"R", "G", "B"}) {
        header.channels().insert(channel, Imf::Channel(Imf::HALF));
        buffer.insert(channel,
                      Imf::Slice(Imf::HALF, reinterpret_cast<char*>(&planes[plane]), sizeof(half),
                                 sizeof(half) * static_cast<std::size_t>(width)));
        plane += pixels;
    }
    const fs::path path = folder / "limit.exr";
    const int threads = abrdf::availableThreads();
    Imf::setGlobalThreadCount(threads);
    const double seconds = secondsOf([&] {
        Imf::TiledOutputFile file(path.c_str(), header, threads);
        file.setFrameBuffer(buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    });
    fs::remove(path);
    return seconds;
}

double decodeAlone(const Bench& bench, const std::string& method, const std::string& plan) {
    abrdf::ConvertOptions options;
    options.input.input = bench.database;
    options.output = bench.atlas();
    options.method.name = method;
    if (!plan.empty()) options.method.plan.name = plan;
    const std::vector<Bytes> images = plannedImages(options);
    std::vector<double> seconds;
    for (std::size_t i = 0; i < kRounds; ++i)
        seconds.push_back(secondsOf([&] { decodeAll(images); }));
    return medianOf(seconds);
}

void printAgainst(const std::string& what, double seconds, const std::string& limit, double least) {
    fmt::print("{:<44}{:>8.2f} s{:>9.2f} s {:<28}{:>6.2f} x\n", what, seconds, least, limit,
               seconds / least);
    std::cout.flush();
}

void oneTexel(const Bench& bench) {
    const double decode = decodeAlone(bench, "prior", "greedy:204");
    printAgainst("1x1, --plan greedy:204", bench.convert("--plan greedy:204", 4 * kRounds).seconds,
                 "decode", decode);
}

void againstLimits(const Bench& bench, const std::string& part) {
    struct Case {
        const char* name;
        const char* options;
        const char* method;
        const char* plan;
    };
    for (const Case& c : {Case{"measured", "--method measured", "measured", ""},
                          Case{"rank", "--plan greedy:52 --rank 16", "prior", "greedy:52"},
                          Case{"full", "--plan greedy:204", "prior", "greedy:204"}}) {
        if (!part.empty() && part != c.name) continue;
        const double decode = decodeAlone(bench, c.method, c.plan);
        const std::string options = fmt::format("{} --texels {} ", c.options, bench.texels);
        const auto plain = bench.convert(options + "--compression none");
        const double write = writeAlone(bench.folder, fs::file_size(bench.atlas()));
        printAgainst(options + "none", plain.seconds, decode > write ? "decode" : "write(2)",
                     std::max(decode, write));
        const auto zip = bench.convert(options + "--compression zip");
        const double exr = exrAlone(bench.atlas(), bench.folder);
        printAgainst(options + "zip", zip.seconds, "the same + OpenEXR alone",
                     std::max(decode, write) + exr);
        fmt::print("    of it: read {:.2f} s, write {:.2f} s, peak {:.0f} MB\n",
                   plain.report["time"]["read"].get<double>(),
                   plain.report["time"]["write"].get<double>(), plain.megabytes);
    }
}

/// Time and memory over the texels, and the exponent of the time between the first and the last.
void growth(const Bench& bench, int largest) {
    std::vector<double> logTexels;
    std::vector<double> logSeconds;
    for (int size = 32; size <= largest; size *= 2) {
        const auto run = bench.convert(fmt::format(
            "--plan greedy:204 --texels {0}x{0} --compression none --memory 256M", size));
        const double making = run.seconds - run.report["time"]["read"].get<double>();
        fmt::print("{0:>4} x {0:<4} {1:>8.2f} s, {2:>8.2f} s after reading, {3:>6.0f} MB of 256\n",
                   size, run.seconds, making, run.megabytes);
        logTexels.push_back(2 * std::log(size));
        logSeconds.push_back(std::log(run.seconds));
    }
    const double n = static_cast<double>(logTexels.size());
    double meanX = 0;
    double meanY = 0;
    for (std::size_t i = 0; i < logTexels.size(); ++i) {
        meanX += logTexels[i] / n;
        meanY += logSeconds[i] / n;
    }
    double xy = 0;
    double xx = 0;
    for (std::size_t i = 0; i < logTexels.size(); ++i) {
        xy += (logTexels[i] - meanX) * (logSeconds[i] - meanY);
        xx += (logTexels[i] - meanX) * (logTexels[i] - meanX);
    }
    fmt::print("fitted exponent of the time over the texels: {:.2f}\n", xy / xx);
}

void threadsAndShards(const Bench& bench) {
    const std::string options =
        fmt::format("--plan greedy:204 --texels {} --compression zip", bench.texels);
    const double one = bench.convert(options + " --threads 1").seconds;
    const double two = bench.convert(options + " --threads 2").seconds;
    fmt::print("1 thread {:.2f} s, 2 threads {:.2f} s: {:.2f} x\n", one, two, one / two);
    std::vector<double> shards;
    for (std::size_t i = 0; i < kRounds; ++i) {
        shards.push_back(secondsOf([&] {
            auto first = bench.start(options + " --threads 1 --shard 1/2", bench.folder / "1.exr");
            auto second = bench.start(options + " --threads 1 --shard 2/2", bench.folder / "2.exr");
            Bench::finish(first);
            Bench::finish(second);
        }));
    }
    fmt::print("2 shards of 1 thread at once {:.2f} s: {:.2f} x the run with 2 threads\n",
               medianOf(shards), medianOf(shards) / two);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc < 2)
            throw std::runtime_error("usage: scale_bench DATABASE.zip [TEXELS=256 [PART]]");
        setenv("TZ", "UTC0", 0);  // As the program does.
        const int size = argc > 2 ? std::stoi(argv[2]) : 256;
        const fs::path program =
            fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "abrdf";
        const fs::path folder =
            fs::temp_directory_path() / ("abrdf_bench_" + std::to_string(getpid()));
        fs::create_directories(folder);
        const Bench bench{program, fs::absolute(argv[1]), folder, fmt::format("{0}x{0}", size)};
        const std::string part = argc > 3 ? argv[3] : "";
        againstLimits(bench, part);
        if (part.empty() || part == "one") oneTexel(bench);
        if (part.empty() || part == "growth") growth(bench, size);
        if (part.empty() || part == "threads") threadsAndShards(bench);
        fs::remove_all(folder);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "scale_bench: " << error.what() << "\n";
        return 1;
    }
}
