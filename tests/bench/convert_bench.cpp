// SPDX-License-Identifier: BSD-3-Clause
//
// The whole job against its limit: `convert` of a UBO2003-like zip to one texel, beside
// libjpeg-turbo alone decoding the same images from memory; then the program's peak memory.
#include "abrdf/demo_cloth.h"
#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"
#include "pipeline/convert/convert.h"
#include "pipeline/convert/dry_run.h"
#include "tests/bench/decode_limit.h"
#include "tests/bench/duel.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <random>
#include <stdexcept>

namespace {

namespace fs = std::filesystem;

using abrdf::AngularGrid;
using abrdf::Direction;

constexpr int kSize = 256;            // pixels each way, as UBO2003's
constexpr std::size_t kCloths = 384;  // distinct images; the poster's plan reads fewer
constexpr int kQuality = 95;
constexpr int kRounds = 11;

/// A photograph of the virtual cloth, with the noise of a camera.
Bytes jpegOf(const abrdf::DemoCloth& cloth, const abrdf::LightAndView& pair, unsigned seed) {
    std::vector<abrdf::Rgb> image(kSize * kSize);
    cloth.render(Imath::V3f(vectorFromDirection(pair.light)),
                 Imath::V3f(vectorFromDirection(pair.view)), image);
    std::minstd_rand random(seed + 1);
    std::normal_distribution<double> noise(0, 4);
    Bytes codes;
    for (const abrdf::Rgb& c : image) {
        for (const float light : {c.r, c.g, c.b}) {
            const double code = 255 * abrdf::srgbEncoded(static_cast<double>(light));
            codes.push_back(
                static_cast<unsigned char>(std::clamp(code + noise(random), 0.0, 255.0)));
        }
    }
    const Turbo turbo(tjInitCompress());
    unsigned char* jpeg = nullptr;
    unsigned long size = 0;
    if (tjCompress2(turbo.get(), codes.data(), kSize, 0, kSize, TJPF_RGB, &jpeg, &size, TJSAMP_444,
                    kQuality, TJFLAG_ACCURATEDCT) != 0) {
        throw std::runtime_error(tjGetErrorStr2(turbo.get()));
    }
    Bytes bytes(jpeg, jpeg + size);
    tjFree(jpeg);
    return bytes;
}

/// 81 x 81 stored files under UBO2003's names, made of `kCloths` images again and again.
void writeDatabase(const fs::path& path) {
    const AngularGrid grid(abrdf::ubo81Directions());
    const abrdf::DemoCloth cloth(kSize, 1);
    std::vector<Bytes> jpegs(kCloths);
    abrdf::forEachImage(kCloths, [&](std::size_t i) {
        jpegs[i] =
            jpegOf(cloth, grid.pair(i * grid.pairCount() / kCloths), static_cast<unsigned>(i));
    });
    zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    const auto degrees = [](double angle) { return std::lround(abrdf::degreesFromRadians(angle)); };
    for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
        const auto [light, view] = grid.pair(pair);
        const std::string viewName =
            fmt::format("tv{:03}_pv{:03}", degrees(view.theta), degrees(view.phi));
        const std::string name = fmt::format(
            "{0}/{1:05} tl{2:03} pl{3:03} tv{4:03} pv{5:03}.jpg", viewName, pair,
            degrees(light.theta), degrees(light.phi), degrees(view.theta), degrees(view.phi));
        const Bytes& jpeg = jpegs[pair % kCloths];
        zip_source_t* source = zip_source_buffer(archive, jpeg.data(), jpeg.size(), 0);
        const zip_int64_t index = zip_file_add(archive, name.c_str(), source, 0);
        zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0);
    }
    if (zip_close(archive) != 0) throw std::runtime_error(zip_strerror(archive));
}

/// In a child: its memory must not be taken for that of the program measured later, as what a
/// process had used before exec() stays in its peak.
void writeDatabaseInChild(const fs::path& path) {
    const pid_t child = fork();
    if (child == 0) {
        try {
            writeDatabase(path);
            _exit(0);
        } catch (const std::exception& error) {
            std::cerr << error.what() << "\n";
            _exit(1);
        }
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
        throw std::runtime_error("the database could not be made");
    }
}

struct ProgramRun {
    double seconds = 0;
    double peakMegabytes = 0;
};

ProgramRun runProgram(const fs::path& database, const fs::path& atlas) {
    // build/release/tests/convert_bench and build/release/abrdf
    const fs::path program =
        fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "abrdf";
    std::vector<std::string> words = {program, "convert", database, "-o", atlas, "-q"};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    rusage usage{};
    int status = 0;
    const double seconds = secondsOf([&] {
        pid_t child = 0;
        if (posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments.data(), environ) !=
                0 ||
            wait4(child, &status, 0, &usage) != child) {
            status = -1;
        }
    });
    if (status != 0) throw std::runtime_error(program.string() + " failed; is it built?");
    return {seconds, static_cast<double>(usage.ru_maxrss) / 1024};
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

void print(const char* what, const std::vector<double>& seconds) {
    std::cout << fmt::format("{:<28} median {:7.1f} ms   minimum {:7.1f} ms\n", what,
                             1000 * median(seconds), 1000 * std::ranges::min(seconds));
}

void run(const abrdf::TemporaryFolder& folder, fs::path database) {
    if (database.empty()) {
        database = folder.path() / "database.zip";
        std::cout << "making a database of 6561 images ...\n";
        writeDatabaseInChild(database);
    }
    const fs::path atlas = folder.path() / "atlas.exr";
    runProgram(database, atlas);  // Brings the files into the system's cache.
    const ProgramRun program = runProgram(database, atlas);

    OIIO::attribute("threads", 1);  // As the program does.
    OIIO::attribute("exr_threads", -1);
    abrdf::ConvertOptions options;
    options.input.input = database;
    options.output = atlas;
    const std::vector<Bytes> images = plannedImages(options);
    std::size_t bytes = 0;
    for (const Bytes& image : images) bytes += image.size();
    std::vector<double> whole, read, plan, limit, ratio;
    for (int round = -1; round < kRounds; ++round) {
        nlohmann::ordered_json report;
        const double convertSeconds = secondsOf([&] { report = abrdf::convert(options, {}); });
        const double planSeconds = secondsOf([&] { abrdf::planConvert(options); });
        const double decodeSeconds = secondsOf([&] { decodeAll(images); });
        if (round < 0) continue;  // warming up
        whole.push_back(convertSeconds);
        read.push_back(report["time"]["read"]);
        plan.push_back(planSeconds);
        limit.push_back(decodeSeconds);
        ratio.push_back(convertSeconds / decodeSeconds);
    }
    std::cout << fmt::format("{} of the images, {:.1f} kB each, {} alternations, {} cores\n",
                             images.size(),
                             static_cast<double>(bytes) / 1000 / static_cast<double>(images.size()),
                             kRounds, abrdf::availableThreads());
    print("convert", whole);
    print("  of which open and read", read);
    print("  of that, before any image", plan);
    print("libjpeg-turbo alone", limit);
    std::cout << fmt::format(
        "ratio: of medians {:.3f}, of minima {:.3f}, median of ratios {:.3f}\n",
        median(whole) / median(limit), std::ranges::min(whole) / std::ranges::min(limit),
        median(ratio));
    std::cout << fmt::format("abrdf convert as a program: {:.0f} ms, peak {:.1f} MB\n",
                             1000 * program.seconds, program.peakMegabytes);
}

}  // namespace

/// convert_bench [DATABASE.zip]
int main(int argc, char** argv) {
    try {
        setenv("TZ", "UTC0", 0);  // As the program does.
        const abrdf::TemporaryFolder folder;
        run(folder, argc > 1 ? argv[1] : "");
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "convert_bench: " << error.what() << "\n";
        return 1;
    }
}
