// SPDX-License-Identifier: BSD-3-Clause
//
// Tabulated BRDFs and .btf files that lie about what they hold.
#include "tests/bad/bad_input.h"
#include "tests/support/small_files.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

BadInput table(const std::string& what, const std::string& name, const std::string& bytes,
               const std::string& says, int status = 1) {
    return {what, [=](const fs::path& folder) { put(folder / name, bytes); }, "inspect " + name,
            status, says};
}

std::string merl(std::int32_t thetas, std::int32_t diffs, std::int32_t phis, double value,
                 std::size_t count) {
    ByteWriter out;
    out.put(thetas).put(diffs).put(phis);
    for (std::size_t i = 0; i < count; ++i) out.put(value);
    return out.bytes();
}

/// Four bytes at `place` replaced.
std::string patched(std::string bytes, std::size_t place, std::uint32_t value) {
    return bytes.replace(place, 4, ByteWriter().put(value).bytes());
}

std::string half(const std::string& bytes) {
    return bytes.substr(0, bytes.size() / 2);
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("bad input: MERL and UTIA BRDF") {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    checkBadInputs({
        table("MERL of negative sizes", "a.binary", merl(-90, 90, 180, 0.5, 10),
              "it declares -90 x 90 x 180 entries"),
        table("MERL of 2^31 entries", "a.binary", merl(0x7fffffff, 90, 180, 0.5, 10),
              "it declares 2147483647 x 90 x 180 entries"),
        table("MERL that is cut", "a.binary", merl(90, 90, 180, 0.5, 1000), "damaged or cut"),
        table("MERL of the other endianness", "a.binary",
              merl(0x5a000000, 0x5a000000, static_cast<std::int32_t>(0xb4000000), 0.5, 10),
              "is big-endian"),
        table("UTIA with a byte too few", "a.bin",
              std::string(std::size_t{288} * 288 * 24 - 1, 'a'), "is not a database"),
        table(
            "UTIA of NaN alone", "a.bin",
            [] {
                ByteWriter out;
                for (int i = 0; i < 288 * 288 * 3; ++i) out.put(kNaN);
                return out.bytes();
            }(),
            "nonfinite +248832", 0),
        table(
            "UTIA of the other endianness", "a.bin",
            [] {
                ByteWriter out;
                for (int i = 0; i < 288 * 288 * 3; ++i) out.put(std::uint64_t{0xe03f});
                return out.bytes();
            }(),
            "its doubles are big-endian"),
    });
}

TEST_CASE("bad input: RGL and MBSDF") {
    const std::string rgl = rglBytes({});
    SmallRgl badPhi;
    badPhi.phiIn = {std::numeric_limits<float>::quiet_NaN()};
    SmallRgl badTheta;
    badTheta.thetaIn = {1.5F, 0};
    const std::string mbsdf = mbsdfBytes(2, 3);
    const std::size_t sizes = mbsdf.find("MBSDF_DATA_REFLECTION=") + 23;
    std::string version = rgl;
    version[12] = 9;
    checkBadInputs({
        table("RGL's first bytes", "a.bsdf", rgl.substr(0, 14), "damaged or cut"),
        table("RGL that is cut", "a.bsdf", half(rgl), "damaged or cut"),
        table("RGL of version 9", "a.bsdf", version, "it is of version 9.0, read is 1.0"),
        table("RGL of 2^32 - 1 fields", "a.bsdf", patched(rgl, 14, 0xffffffff), "damaged or cut"),
        table("RGL without fields", "a.bsdf", patched(rgl, 14, 0), "it has no field phi_i"),
        table("RGL of phi NaN", "a.bsdf", rglBytes(badPhi), "its field phi_i holds NaN"),
        table("RGL whose thetas fall", "a.bsdf", rglBytes(badTheta),
              "its field theta_i is not an ascending list"),
        table("MBSDF that is cut", "a.mbsdf", half(mbsdf), "damaged or cut"),
        table("MBSDF of no thetas", "a.mbsdf", patched(mbsdf, sizes + 4, 0), "a.mbsdf: "),
        table("MBSDF of 2^32 - 1 thetas", "a.mbsdf", patched(mbsdf, sizes + 4, 0xffffffff),
              "a.mbsdf: "),
        table("MBSDF of a type that nobody knows", "a.mbsdf", patched(mbsdf, sizes, 77),
              "a.mbsdf: "),
    });
}

TEST_CASE("bad input: UBO2014") {
    const std::string btf = btfBytes({});
    SmallBtf below;
    below.lights = {{2.0, 0}};
    SmallBtf notANumber;
    notANumber.lights = {{std::numeric_limits<double>::quiet_NaN(), 0}, {0.1, 0}};
    // Its factors would be of gigabytes: a header alone.
    const auto headOf = [](SmallBtf small, unsigned width) {
        const std::string with = btfBytes(small);
        const std::string size = ByteWriter().put(small.width).put(small.height).bytes();
        const std::size_t place = with.find(size);
        return with.substr(0, place) + ByteWriter().put(width).bytes() + with.substr(place + 4);
    };
    checkBadInputs({
        table("a signature alone", "a.btf", "!DFMF08FCR", "damaged or cut"),
        table("half of the file", "a.btf", half(btf), "damaged or cut"),
        table("another signature", "a.btf", "!XYZ" + btf.substr(4), "is not a database"),
        table("a length of metadata of 4 GB", "a.btf", patched(btf, 10, 0xffffffff),
              "damaged or cut"),
        table("2^31 - 1 texels wide", "a.btf", headOf({}, 0x7fffffff),
              "do not fit 4294967294 texels"),
        table("no texels wide", "a.btf", headOf({}, 0), "it declares 0 x 2 texels"),
        table("lights below the surface alone", "a.btf", btfBytes(below),
              "has no direction above the surface"),
        table("a light of NaN", "a.btf", btfBytes(notANumber), "a.btf: "),
        table("rubbish after the signature", "a.btf", "!BDIF06R2!" + std::string(300, '\xaa'),
              "damaged or cut"),
    });
}

TEST_SUITE_END();
