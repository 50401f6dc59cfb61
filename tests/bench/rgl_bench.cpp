// SPDX-License-Identifier: BSD-3-Clause
//
// RGL files, read, exported and read again, beside the file itself: straight, and by way of
// atlases. `rgl_bench DATA [GRID...]`: DATA is the folder of .bsdf files, GRID what --grid takes.
#include "abrdf/for_each_texel.h"
#include "pipeline/convert/convert.h"
#include "pipeline/export/export.h"
#include "stages/read/btf_reader.h"
#include "tests/support/brdf_comparison.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

void print(const fs::path& file, const std::string& way, const fs::path& again) {
    const auto before = abrdf::openBtf(file);
    const auto after = abrdf::openBtf(again);
    const auto found = abrdf::compareBrdfs(*before->table(), *after->table());
    std::cout
        << fmt::format(
               "| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.3f} of {:.3f} | {:.1f} |\n",
               file.stem().string(), way, 100 * found.error, 100 * found.energy,
               100 * found.allEnergy, 100 * found.highlight, found.reflectance,
               found.trueReflectance, static_cast<double>(fs::file_size(again)) / 1e6)
        << std::flush;
}

void exportTo(const fs::path& input, const fs::path& output) {
    abrdf::ExportJob job;
    job.input.input = input;
    job.format = "rgl";
    job.output = output;
    abrdf::exportBrdf(job, {});
}

void convertTo(const fs::path& input, const std::string& grid, const fs::path& output) {
    abrdf::ConvertOptions options;
    options.input.input = input;
    options.output = output;
    options.method.name = "measured";
    options.grid = grid;
    options.pixel = abrdf::PixelChoice::kFloat;
    abrdf::convert(options, {});
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: rgl_bench DATA [GRID...]\n";
        return 2;
    }
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    const abrdf::ThreadLimit limit(abrdf::availableThreads());
    const abrdf::TemporaryFolder folder;
    const fs::path atlas = folder.path() / "atlas.exr";
    const fs::path again = folder.path() / "again.bsdf";
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(argv[1])) files.insert(entry.path());
    std::cout << "| file | by | mean % | energy, worst view % | all | highlight % | largest "
                 "reflectance | MB |\n|---|---|---|---|---|---|---|---|\n";
    for (const fs::path& file : files) {
        exportTo(file, again);
        print(file, "itself", again);
        for (int i = 2; i < argc; ++i) {
            convertTo(file, argv[i], atlas);
            exportTo(atlas, again);
            print(file, argv[i], again);
        }
    }
}
