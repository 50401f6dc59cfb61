// SPDX-License-Identifier: BSD-3-Clause
//
// The .btf container (btflib of the University of Bonn, revision a9645d5): little-endian, no
// padding. UBO2014 uses its DFMF form.
#include "stages/read/btf_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

struct Signature {
    std::string_view text;
    BtfKind kind;
    bool hasRotations;
    bool hasVersionByte;
};

// The longest that fits counts, so longer ones come first.
constexpr std::array kSignatures{
    Signature{"!DFMF08FCR", BtfKind::kDfmf, true, false},
    Signature{"!FMF12FCER", BtfKind::kFmf, true, true},
    Signature{"!FMF06FCR", BtfKind::kFmf, true, false},
    Signature{"!FMF06FC", BtfKind::kFmf, false, false},
    Signature{"!PVF06FCR", BtfKind::kPvf, true, false},
    Signature{"!PVF06FC", BtfKind::kPvf, false, false},
    Signature{"!BDIF06R2!", BtfKind::kBdi, true, false},
};

constexpr std::uint32_t kNewestMetadata = 4;

std::string textOf(std::span<const char> bytes) {
    return {bytes.begin(), bytes.end()};
}

void readMetadata(ByteCursor& file, BtfHeader& header) {
    const std::size_t begin = file.place();
    const std::uint32_t size = file.u32("metadata");
    const std::uint32_t version = file.u32("metadata");
    if (version > kNewestMetadata) {
        file.fail(fmt::format("its metadata are of version {}, known are those up to {}", version,
                              kNewestMetadata));
    }
    file.take(3 * 80, "set-up names");
    file.take(4 * sizeof(float), "scale factors");  // Stored there, applied by nobody.
    if (version > 1) header.cosineIsIn = file.u32("cosine flag") != 0;
    if (version > 2) file.take(file.u32("XML text"), "XML text");
    header.channels = {"R", "G", "B"};
    if (version > 3) {
        const std::uint32_t count = file.u32("channel names");
        if (count < 1 || count > 1024) file.fail(fmt::format("it declares {} channels", count));
        header.channels.clear();
        for (std::uint32_t c = 0; c < count; ++c) {
            header.channels.push_back(textOf(file.take(file.u32("channel name"), "channel name")));
        }
    }
    file.seek(begin + std::uint64_t{size});
    if (size < 4) file.fail("its metadata are said to be shorter than their own size");
}

Direction readDirection(ByteCursor& file) {
    const auto theta = static_cast<double>(file.f32("directions"));
    const auto phi = static_cast<double>(file.f32("directions"));
    if (!(theta > -1e-4 && theta <= kPi) || !(std::abs(phi) <= 4 * kPi)) {
        file.fail(fmt::format("theta {} phi {} radians are not those of a direction", theta, phi));
    }
    return {std::max(0.0, theta), wrappedAzimuth(phi)};
}

void readDirections(ByteCursor& file, BtfHeader& header) {
    const std::uint32_t views = file.u32("view directions");
    constexpr std::uint64_t kLeastBytesOfView = 20;
    if (views == 0 || views > file.left() / kLeastBytesOfView) {
        file.fail(fmt::format("it declares {} view directions in {} bytes", views, file.left()));
    }
    for (std::uint32_t v = 0; v < views; ++v) {
        header.views.push_back(readDirection(file));
        const std::uint32_t lights = file.u32("light directions");
        if (lights == 0 || lights > file.left() / (2 * sizeof(float))) {
            file.fail(
                fmt::format("it declares {} light directions in {} bytes", lights, file.left()));
        }
        if (v > 0 && lights != header.lights.size()) {
            file.fail(fmt::format("view {} has {} lights, the first view {}", v, lights,
                                  header.lights.size()));
        }
        for (std::uint32_t l = 0; l < lights; ++l) {
            const Direction light = readDirection(file);
            if (v == 0) header.lights.push_back(light);
        }
    }
}

}  // namespace

bool beginsAsBtf(std::string_view head) {
    return std::ranges::any_of(std::array<std::string_view, 4>{"!DFMF", "!FMF", "!PVF", "!BDIF"},
                               [&](std::string_view begin) { return head.starts_with(begin); });
}

BtfHeader readBtfHeader(ByteCursor& file) {
    const std::size_t length = std::min<std::size_t>(file.left(), 16);
    const std::string begin = textOf(file.take(length, "signature"));
    const auto signature = std::ranges::find_if(
        kSignatures, [&](const Signature& s) { return begin.starts_with(s.text); });
    if (signature == kSignatures.end()) {
        file.fail(fmt::format("its signature '{}' is none of the known ones of a .btf file",
                              begin.substr(0, 10)));
    }
    file.seek(signature->text.size());
    BtfHeader header;
    header.kind = signature->kind;
    header.hasRotations = signature->hasRotations;
    header.hasVersionByte = signature->hasVersionByte;
    readMetadata(file, header);
    readDirections(file, header);
    return header;
}

void skipBtfRotations(ByteCursor& file) {
    const std::uint32_t count = file.u32("rotations");
    file.take(std::uint64_t{count} * 9 * sizeof(float), "rotations");
}

}  // namespace abrdf
