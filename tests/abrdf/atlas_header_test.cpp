// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/atlas_header.h"

#include "color/known_space.h"
#include "tests/support/fault_of.h"

#include <ImfFloatVectorAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>
#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>

using namespace abrdf;

namespace {

AtlasHeader smallAtlas() {
    AtlasHeader atlas;
    atlas.layout = {AtlasKind::kAngular, 3, 2, 5, 7};
    atlas.grid = AngularGrid(regularDirections(1, 5), regularDirections(1, 7));
    atlas.method = "published";
    atlas.plan = "poster";
    atlas.colorSpace = "ACEScg";
    atlas.interopId = "lin_ap1_scene";
    return atlas;
}

Imf::Header stored(const AtlasHeader& atlas) {
    Imf::Header header(atlas.layout.width(), atlas.layout.height());
    storeAtlasHeader(atlas, header);
    return header;
}

/// What reading says; empty where it passes.
std::string faultOf(const Imf::Header& header) {
    return abrdf::faultOf([&] { atlasHeaderFrom(header, "some.exr"); });
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("every attribute of the interface is there, and each that is absent is named") {
    for (const char* name :
         {"abrdf:version", "abrdf:layout", "abrdf:texels", "abrdf:lights", "abrdf:views",
          "abrdf:method", "abrdf:plan", "abrdf:samples", "abrdf:source", "abrdf:cosine",
          "abrdf:maxMeasuredTheta", "abrdf:clamped", "abrdf:extrapolated", "abrdf:nonfinite",
          "colorInteropID"}) {
        CAPTURE(name);
        Imf::Header header = stored(smallAtlas());
        REQUIRE(header.find(name) != header.end());
        header.erase(name);
        CHECK(contains(faultOf(header), name));
        CHECK(contains(faultOf(header), "some.exr"));
    }
    CHECK(faultOf(stored(smallAtlas())).empty());
}

TEST_CASE("a header that contradicts itself is refused by the file's name") {
    const auto damaged = [](const char* name, const Imf::Attribute& value) {
        CAPTURE(name);
        Imf::Header header = stored(smallAtlas());
        header.erase(name);
        header.insert(name, value);
        CHECK(contains(faultOf(header), "some.exr"));
    };
    damaged("abrdf:version", Imf::IntAttribute(99));
    damaged("abrdf:version", Imf::StringAttribute("1"));
    damaged("abrdf:layout", Imf::StringAttribute("round"));
    damaged("abrdf:cosine", Imf::StringAttribute("half"));
    for (const Imath::V2i& part : {Imath::V2i{2, 1}, {0, 1}, {-1, 3}, {1, -1}, {1, 1 << 30}}) {
        damaged("abrdf:shard", Imf::V2iAttribute(part));
    }
    damaged("abrdf:texels", Imf::V2iAttribute({0, 2}));
    damaged("abrdf:texels", Imf::V2iAttribute({-3, -2}));
    damaged("abrdf:texels", Imf::V2iAttribute({2, 3}));
    damaged("abrdf:lights", Imf::FloatVectorAttribute(Imf::FloatVector{}));
    damaged("abrdf:lights", Imf::FloatVectorAttribute(Imf::FloatVector(10, 2.0F)));
    damaged("abrdf:views", Imf::FloatVectorAttribute(Imf::FloatVector(12, 0.1F)));
    damaged("abrdf:views", Imf::FloatVectorAttribute(
                               Imf::FloatVector(14, std::numeric_limits<float>::quiet_NaN())));
    Imf::Header shifted = stored(smallAtlas());
    shifted.dataWindow().min = {1, 0};
    CHECK(contains(faultOf(shifted), "some.exr"));
}

TEST_CASE("chromaticities are those of the colour space, and absent where it is none of ours") {
    AtlasHeader atlas = smallAtlas();
    const Imf::Header header = stored(atlas);
    REQUIRE(Imf::hasChromaticities(header));
    const Primaries acesCg = primaries(KnownSpace::kAcesCg);
    CHECK(Imf::chromaticities(header).red == Imath::V2f(acesCg.red[0], acesCg.red[1]));
    CHECK(Imf::chromaticities(header).white == Imath::V2f(acesCg.white[0], acesCg.white[1]));
    atlas.interopId = "unknown";
    CHECK_FALSE(Imf::hasChromaticities(stored(atlas)));
}

TEST_CASE("counts past 32 bits stand as the largest, and come back") {
    AtlasHeader atlas = smallAtlas();
    atlas.counts.clamped = std::uint64_t{1} << 40;
    atlas.counts.extrapolated = 12;
    const AtlasHeader back = atlasHeaderFrom(stored(atlas), "some.exr");
    CHECK(back.counts.clamped == std::numeric_limits<int>::max());
    CHECK(back.counts.extrapolated == 12);
}

TEST_CASE("the surface's plane, its margin and what lies outside come back") {
    AtlasHeader atlas = smallAtlas();
    atlas.plane = -2.5;
    atlas.margin = 9;
    atlas.counts.outside = 77;
    Imf::Header header = stored(atlas);
    const AtlasHeader back = atlasHeaderFrom(header, "some.exr");
    CHECK(back.plane == -2.5);
    CHECK(back.margin == 9);
    CHECK(back.counts.outside == 77);
    for (const char* name : {"abrdf:plane", "abrdf:margin", "abrdf:outside"}) header.erase(name);
    CHECK(atlasHeaderFrom(header, "some.exr").plane == 0);
}

TEST_CASE("a header tells no host, owner or time") {
    const Imf::Header header = stored(smallAtlas());
    for (const char* name : {"capDate", "owner", "hostComputer", "DateTime", "comments"}) {
        CHECK(header.find(name) == header.end());
    }
}

TEST_CASE("names of the cosine are each other's inverse") {
    for (const Cosine cosine : {Cosine::kKept, Cosine::kDivided, Cosine::kAbsent}) {
        CHECK(cosineFromName(nameOf(cosine)) == cosine);
    }
    CHECK_THROWS_AS(cosineFromName("Kept"), std::invalid_argument);
}

TEST_CASE("counts add up one by one") {
    ValueCounts counts{1, 2, 3, 4};
    counts += {10, 20, 30, 40};
    CHECK(counts.clamped == 11);
    CHECK(counts.extrapolated == 22);
    CHECK(counts.nonfinite == 33);
    CHECK(counts.missing == 44);
}

TEST_CASE("what was converted from what to what comes back, and old files without it are read") {
    AtlasHeader atlas = smallAtlas();
    CHECK(atlasHeaderFrom(stored(atlas), "some.exr").conversion.empty());
    atlas.conversion = "sRGB - Texture -> ACEScg";
    CHECK(atlasHeaderFrom(stored(atlas), "some.exr").conversion == atlas.conversion);
}

TEST_SUITE_END();
