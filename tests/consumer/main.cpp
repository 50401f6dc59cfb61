// SPDX-License-Identifier: BSD-3-Clause
//
// A BTF to an atlas to one number, through the installed libraries alone.
#include "abrdf/atlas.h"
#include "pipeline/convert/convert.h"
#include "pipeline/demo/demo_database.h"
#include "stages/read/atlas_reader.h"

#include <iostream>

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const std::filesystem::path folder = argv[1];
    abrdf::DemoOptions demo;
    demo.size = 1;
    abrdf::writeDemoDatabase(folder / "cloth.zip", demo, {});
    abrdf::ConvertOptions options;
    options.input.input = folder / "cloth.zip";
    options.output = folder / "cloth.exr";
    options.method.name = "measured";
    abrdf::convert(options, {});
    const abrdf::Atlas atlas = abrdf::readAtlas(options.output);
    const abrdf::Rgb fromAbove = atlas.at({0, 0, 0, 0});
    std::cout << "light and camera above: " << fromAbove.g << "\n";
    return fromAbove.g > 0 && fromAbove.g < 10 ? 0 : 1;
}
