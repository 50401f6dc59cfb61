// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/angle_keys.h"
#include "stages/read/btf_reader.h"
#include "stages/read/decode_image.h"
#include "stages/read/name_pattern.h"
#include "tests/fuzz/targets.h"
#include "tests/support/small_files.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/write_zip.h"

#include <OpenImageIO/imageio.h>

#include <array>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

/// Opens the file and reads some of what is in it.
void openAndRead(const fs::path& path) {
    try {
        const auto reader = openBtf(path);
        const BtfDescription& d = reader->description();
        const std::size_t pairs = d.present.size();
        for (std::size_t pair = 0; pair < pairs; pair += 1 + pairs / 7) {
            if (d.present[pair] == 0) continue;
            try {
                reader->read(pair);
            } catch (const std::runtime_error&) {
            }
        }
        if (const BrdfTable* table = reader->table()) {
            for (int k = 0; k < 9; ++k) {
                table->evaluate({{0.17 * k, 0.9 * k}, {1.5 - 0.15 * k, 2.1 * k}});
            }
        }
    } catch (const std::runtime_error&) {
    } catch (const std::invalid_argument&) {
    }
}

void readAs(const std::string& name, std::span<const char> bytes) {
    openAndRead(fuzzFile(name, bytes));
}

void runBtf(std::span<const char> bytes) {
    readAs("fuzz.btf", bytes);
}
void runRgl(std::span<const char> bytes) {
    readAs("fuzz.bsdf", bytes);
}
void runMbsdf(std::span<const char> bytes) {
    readAs("fuzz.mbsdf", bytes);
}
void runMerl(std::span<const char> bytes) {
    readAs("fuzz.binary", bytes);
}
void runExr(std::span<const char> bytes) {
    readAs("fuzz.exr", bytes);
}
void runManifest(std::span<const char> bytes) {
    readAs("fuzz.csv", bytes);
}
void runZip(std::span<const char> bytes) {
    readAs("fuzz.zip", bytes);
}
void runUtiaExr(std::span<const char> bytes) {
    readAs("fuzz_utia.exr", bytes);
}

/// As it is, and as the beginning of a file that is long enough.
void runUtiaBin(std::span<const char> bytes) {
    readAs("fuzz.bin", bytes);
    std::string whole(std::size_t{288} * 288 * 24, '\0');
    std::copy_n(bytes.begin(), std::min(bytes.size(), whole.size()), whole.begin());
    readAs("fuzz.bin", whole);
}

/// The first byte says which format the name promises.
void runImage(std::span<const char> bytes) {
    if (bytes.empty()) return;
    constexpr std::array kNames = {"a.jpg", "a.hdr", "a.exr", "a.png"};
    const auto choice = static_cast<unsigned char>(bytes[0]) % kNames.size();
    try {
        decodeImage(bytes.subspan(1), kNames[choice]);
    } catch (const std::runtime_error&) {
    }
}

/// Names of files, and a pattern before the first line's end.
void runNames(std::span<const char> bytes) {
    const std::string text(bytes.begin(), bytes.end());
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string name = text.substr(std::min(end + 1, text.size()));
    angleKeysFromName(name);
    numberAtBegin(name);
    try {
        const NamePattern pattern(text.substr(0, std::min<std::size_t>(end, 200)));
        pattern.match(name.substr(0, 200));
    } catch (const std::invalid_argument&) {
    }
}

std::vector<std::string> btfSeeds() {
    std::vector<std::string> seeds;
    for (const char* signature :
         {"!DFMF08FCR", "!FMF12FCER", "!FMF06FC", "!PVF06FCR", "!BDIF06R2!"}) {
        for (const bool images : {false, true}) {
            SmallBtf btf;
            btf.signature = signature;
            btf.imagesAsColumns = images;
            btf.colorModel = images ? 11 : 3;
            btf.rotations = images ? 1 : 0;
            btf.scalarBytes = images ? 2 : 4;
            if (images) btf.mask = {1, 0, 1, 1, 0, 1};
            seeds.push_back(btfBytes(btf));
        }
    }
    return seeds;
}

std::vector<std::string> rglSeeds() {
    SmallRgl anisotropic;
    anisotropic.phiIn = {-3, 0, 3};
    anisotropic.jacobian = true;
    return {rglBytes({}), rglBytes(anisotropic)};
}

std::vector<std::string> mbsdfSeeds() {
    return {mbsdfBytes(2, 3), mbsdfBytes(2, 3, 0)};
}

std::vector<std::string> merlSeeds() {
    return {ByteWriter().put(90).put(90).put(180).put(0.5).bytes()};
}

std::vector<std::string> utiaBinSeeds() {
    return {ByteWriter().put(0.25).put(-0.5).put(1.0).bytes()};
}

/// A stack of two images of one pixel, through the tests' own writer.
std::vector<std::string> stackFiles(const char* extension) {
    const TemporaryFolder folder;
    SyntheticBtf btf;
    btf.grid = AngularGrid({{0, 0}}, {{0, 0}, {0.5, 1}});
    btf.extension = extension;
    btf.value = [](const LightAndView&, int, int) { return Rgb{0.25F, 0.5F, 1}; };
    writeSyntheticBtf(folder.path() / "btf", btf);
    writeZip(folder.path() / "btf.zip", folder.path() / "btf", true);
    return {bytesOf(folder.path() / "btf" / syntheticFile(btf, 0)),
            bytesOf(folder.path() / "btf.zip")};
}

std::vector<std::string> exrSeeds() {
    return {stackFiles("exr")[0]};
}

/// The one image of this format: 288 x 288, here of one colour, so that it packs small.
std::vector<std::string> utiaExrSeeds() {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "a.exr").string();
    const auto output = OIIO::ImageOutput::create(path);
    OIIO::ImageSpec spec(288, 288, 3, OIIO::TypeDesc::HALF);
    spec.attribute("compression", "zip");
    const std::vector<float> pixels(std::size_t{288} * 288 * 3, 0.25F);
    if (!output || !output->open(path, spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) || !output->close()) {
        throw std::runtime_error("cannot write the seed " + path);
    }
    return {bytesOf(path)};
}

std::vector<std::string> zipSeeds() {
    return {stackFiles("png")[1], stackFiles("jpg")[1]};
}

std::vector<std::string> imageSeeds() {
    return {std::string(1, '\0') + stackFiles("jpg")[0], '\1' + hdrBytes("+X 3 -Y 2", 6),
            '\2' + stackFiles("exr")[0], '\3' + stackFiles("png")[0]};
}

std::vector<std::string> manifestSeeds() {
    return {"file,theta_i,phi_i,theta_v,phi_v\n\"a, b.exr\",0,0,15,30\nc.png,10,-90,20,1e1\n"};
}

std::vector<std::string> nameSeeds() {
    return {"*_{tv}_{pv}/l{tl}p{pl}.*\ntop/x_30_-7.5/l15.25p270.exr",
            "{tl}{pl}{tv}{pv}\n00081 tl015 pl000 tv000 pv000.jpg"};
}

constexpr std::array kTargets{
    FuzzTarget{"btf", runBtf, btfSeeds},
    FuzzTarget{"rgl", runRgl, rglSeeds},
    FuzzTarget{"mbsdf", runMbsdf, mbsdfSeeds},
    FuzzTarget{"merl", runMerl, merlSeeds},
    FuzzTarget{"utia_bin", runUtiaBin, utiaBinSeeds},
    FuzzTarget{"utia_exr", runUtiaExr, utiaExrSeeds},
    FuzzTarget{"exr", runExr, exrSeeds},
    FuzzTarget{"image", runImage, imageSeeds},
    FuzzTarget{"zip", runZip, zipSeeds},
    FuzzTarget{"manifest", runManifest, manifestSeeds},
    FuzzTarget{"names", runNames, nameSeeds},
};

}  // namespace

std::span<const FuzzTarget> readerTargets() {
    return kTargets;
}

}  // namespace abrdf
