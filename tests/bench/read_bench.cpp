// SPDX-License-Identifier: BSD-3-Clause
//
// Reading, a format at a time: megabytes of file and texels a second, beside limits of the same
// run: copying the same bytes out of the system's page cache, libjpeg-turbo and zlib alone.
// `read_bench [DATA]`: DATA is the folder of real files (../shared/data); without it the synthetic
// ones alone.
#include "abrdf/demo_cloth.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/stopwatch.h"
#include "pipeline/demo/demo_database.h"
#include "stages/read/btf_reader.h"
#include "stages/read/decode_image.h"
#include "tests/support/small_files.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <turbojpeg.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <vector>

namespace {

namespace fs = std::filesystem;
using abrdf::BtfReader;

constexpr int kRounds = 7;

double secondsOf(const std::function<void()>& work) {
    std::vector<double> seconds;
    for (int round = 0; round < kRounds; ++round) {
        const abrdf::Stopwatch time;
        work();
        seconds.push_back(time.seconds());
    }
    std::ranges::sort(seconds);
    return seconds[seconds.size() / 2];
}

std::vector<char> bytesOf(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void print(const std::string& what, double bytes, double texels, double seconds,
           const std::string& limit, double limitSeconds) {
    std::cout << fmt::format("{:<34}{:>9.1f} MB/s {:>9.2f} Mtexel/s   {:>7.2f} x {}\n", what,
                             bytes / 1e6 / seconds, texels / 1e6 / seconds, seconds / limitSeconds,
                             limit);
}

/// read() of the whole file into memory that is there already.
double pageCacheSeconds(const fs::path& path) {
    std::vector<char> buffer(fs::file_size(path));
    return secondsOf([&] {
        std::FILE* file = std::fopen(path.c_str(), "rb");
        if (std::fread(buffer.data(), 1, buffer.size(), file) != buffer.size()) std::abort();
        std::fclose(file);
    });
}

/// A single file: opened, and every pair read or evaluated.
void benchFile(const fs::path& path) {
    const auto bytes = static_cast<double>(fs::file_size(path));
    const double limit = pageCacheSeconds(path);
    std::unique_ptr<BtfReader> reader;
    const double open = secondsOf([&] { reader = abrdf::openBtf(path); });
    print(path.filename().string() + ": open", bytes, 0, open, "page cache", limit);
    const std::size_t pairs = reader->description().grid.pairCount();
    const double texels =
        static_cast<double>(pairs) * reader->description().width * reader->description().height;
    const double read = secondsOf(
        [&] { abrdf::forEachImage(pairs, [&](std::size_t pair) { reader->read(pair); }); });
    print(path.filename().string() + ": all pairs", bytes, texels, open + read, "page cache",
          limit);
}

void inflateWhole(const std::vector<char>& deflated, std::vector<char>& bytes) {
    auto size = static_cast<uLongf>(bytes.size());
    uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
               reinterpret_cast<const Bytef*>(deflated.data()),
               static_cast<uLong>(deflated.size()));
}

/// One image out of memory against its codec alone.
void benchImages(const fs::path& folder) {
    std::vector<float> pixels(3 * 800 * 800);
    const abrdf::DemoCloth cloth(256, 1);
    std::vector<abrdf::Rgb> image(256 * 256);
    cloth.render({0.3F, 0.1F, 0.95F}, {0, 0.2F, 0.98F}, image);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const std::size_t x = i / 3 % 800 % 256;
        const std::size_t y = i / 2400 % 256;
        const abrdf::Rgb& c = image[256 * y + x];
        pixels[i] = i % 3 == 0 ? c.r : i % 3 == 1 ? c.g : c.b;
    }
    constexpr double kTexels = 800.0 * 800;
    const std::vector<char> raw(reinterpret_cast<const char*>(pixels.data()),
                                reinterpret_cast<const char*>(pixels.data() + pixels.size() / 2));
    std::vector<char> deflated(compressBound(raw.size()));
    auto size = static_cast<uLongf>(deflated.size());
    compress(reinterpret_cast<Bytef*>(deflated.data()), &size,
             reinterpret_cast<const Bytef*>(raw.data()), raw.size());
    deflated.resize(size);
    std::vector<char> inflated(raw.size());
    for (const char* extension : {"jpg", "png", "exr", "hdr"}) {
        const fs::path path = folder / (std::string("a.") + extension);
        OIIO::ImageSpec spec(
            800, 800, 3,
            std::string(extension) == "exr" ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
        spec.attribute("compression", std::string(extension) == "exr" ? "zip" : "jpeg:95");
        if (std::string(extension) == "hdr") spec.format = OIIO::TypeDesc::FLOAT;
        const auto output = OIIO::ImageOutput::create(path.string());
        output->open(path.string(), spec);
        output->write_image(OIIO::TypeDesc::FLOAT, pixels.data());
        output->close();
        const std::vector<char> bytes = bytesOf(path);
        const double ours = secondsOf([&] { abrdf::decodeImage(bytes, path.string()); });
        if (std::string(extension) == "jpg") {
            std::vector<unsigned char> rgb(pixels.size());
            const tjhandle turbo = tjInitDecompress();
            const double alone = secondsOf([&] {
                tjDecompress2(turbo, reinterpret_cast<const unsigned char*>(bytes.data()),
                              bytes.size(), rgb.data(), 800, 0, 800, TJPF_RGB, TJFLAG_ACCURATEDCT);
            });
            tjDestroy(turbo);
            print("800 x 800 jpg", static_cast<double>(bytes.size()), kTexels, ours,
                  "libjpeg-turbo", alone);
        } else {
            // Half as many bytes as floats: what a half EXR holds.
            const double alone = secondsOf([&] { inflateWhole(deflated, inflated); });
            print(fmt::format("800 x 800 {}", extension), static_cast<double>(bytes.size()),
                  kTexels, ours, "zlib of the halfs' size", alone);
        }
    }
}

void benchStack(const fs::path& zip) {
    const auto bytes = static_cast<double>(fs::file_size(zip));
    const double limit = pageCacheSeconds(zip);
    std::unique_ptr<BtfReader> reader;
    const double open = secondsOf([&] { reader = abrdf::openBtf(zip); });
    const std::size_t pairs = reader->description().grid.pairCount();
    const double texels =
        static_cast<double>(pairs) * reader->description().width * reader->description().height;
    const double read = secondsOf(
        [&] { abrdf::forEachImage(pairs, [&](std::size_t pair) { reader->read(pair); }); });
    print(zip.filename().string() + ": open", bytes, 0, open, "page cache", limit);
    print(zip.filename().string() + ": all images", bytes, texels, open + read, "page cache",
          limit);
}

/// A .btf as large as a piece of UBO2014: 128 x 128 texels, 151 x 151 directions.
void writeLargeBtf(const fs::path& path, const char* signature) {
    abrdf::SmallBtf btf;
    btf.signature = signature;
    btf.lights = abrdf::dome151Directions();
    btf.views = btf.lights;
    btf.width = 128;
    btf.height = 128;
    btf.components = 24;
    btf.colorModel = 11;
    const std::string bytes = abrdf::btfBytes(btf);
    std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

int main(int argc, char** argv) {
    OIIO::attribute("threads", 1);  // As the program does.
    OIIO::attribute("exr_threads", -1);
    const fs::path folder =
        fs::temp_directory_path() / ("abrdf_read_bench_" + std::to_string(getpid()));
    fs::create_directories(folder);
    std::cout << fmt::format("{} threads; medians of {}\n", abrdf::availableThreads(), kRounds);
    benchImages(folder);
    abrdf::DemoOptions demo;
    demo.size = 64;
    abrdf::writeDemoDatabase(folder / "ubo2003.zip", demo, {});
    benchStack(folder / "ubo2003.zip");
    for (const char* signature : {"!DFMF08FCR", "!FMF12FCER", "!PVF06FCR"}) {
        const fs::path path = folder / (std::string(signature + 1, 4) + ".btf");
        writeLargeBtf(path, signature);
        const auto bytes = static_cast<double>(fs::file_size(path));
        const double limit = pageCacheSeconds(path);
        std::unique_ptr<BtfReader> reader;
        const double open = secondsOf([&] { reader = abrdf::openBtf(path); });
        print(path.filename().string() + ": open", bytes, 0, open, "page cache", limit);
        constexpr std::size_t kPairs = 336;  // What the poster's plan reads.
        const double read = secondsOf([&] {
            abrdf::forEachImage(kPairs, [&](std::size_t pair) { reader->read(61 * pair); });
        });
        print(path.filename().string() + ": 336 pairs", bytes, 128.0 * 128 * kPairs, open + read,
              "page cache", limit);
    }
    if (argc > 1) {
        const fs::path data = argv[1];
        for (const char* name :
             {"ubo2014/woven_bdi.btf", "rgl/paper_white_rgb.bsdf", "mbsdf/carpaint_red.mbsdf"}) {
            benchFile(data / name);
        }
    }
    fs::remove_all(folder);
    return 0;
}
