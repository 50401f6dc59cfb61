// SPDX-License-Identifier: BSD-3-Clause
//
// Replays a fuzz target's seeds, what fuzzing has found (tests/fuzz/corpus/TARGET), and a few
// hundred damaged copies of the seeds, the same ones each time. `fuzz_replay TARGET CORPUS`;
// `fuzz_replay TARGET --seeds FOLDER` writes the seeds for libFuzzer.
#include "abrdf/random.h"
#include "tests/fuzz/targets.h"

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace {

namespace fs = std::filesystem;

/// Some bytes changed, a piece cut out or the end cut off.
std::string damaged(std::string bytes, abrdf::Random& random) {
    for (std::size_t n = random.below(4); n-- > 0 && !bytes.empty();) {
        bytes[random.below(bytes.size())] = static_cast<char>(random.next());
    }
    if (random.chance(0.3) && bytes.size() > 4) {
        // A count that lies.
        const std::size_t place = random.below(bytes.size() - 4);
        for (std::size_t i = 0; i < 4; ++i) {
            bytes[place + i] = random.chance(0.5) ? '\xff' : '\x7f';
        }
    }
    if (random.chance(0.3) && !bytes.empty()) bytes.resize(random.below(bytes.size()));
    return bytes;
}

int writeSeeds(const abrdf::FuzzTarget& target, const fs::path& folder) {
    fs::create_directories(folder);
    int number = 0;
    for (const std::string& seed : target.seeds()) {
        std::ofstream(folder / ("seed" + std::to_string(number++)), std::ios::binary) << seed;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    const abrdf::FuzzTarget target = abrdf::fuzzTargetFromName(argv[1]);
    if (argc > 3) return writeSeeds(target, argv[3]);
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    std::size_t runs = 0;
    const auto run = [&](const std::string& bytes) {
        target.run(bytes);
        ++runs;
    };
    if (fs::exists(argv[2])) {
        for (const fs::directory_entry& entry : fs::directory_iterator(argv[2])) {
            std::ifstream stream(entry.path(), std::ios::binary);
            run({std::istreambuf_iterator<char>(stream), {}});
        }
    }
    abrdf::Random random(1);
    for (const std::string& seed : target.seeds()) {
        run(seed);
        for (int k = 0; k < 100; ++k) run(damaged(seed, random));
    }
    std::cout << target.name << ": " << runs << " inputs\n";
    return 0;
}
