// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/atlas_layout.h"

#include "abrdf/atlas_header.h"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("pixels and samples are each other's inverse in both layouts, on odd sizes") {
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        const AtlasLayout layout{kind, 3, 2, 5, 7};
        for (int y = 0; y < layout.height(); ++y) {
            for (int x = 0; x < layout.width(); ++x) {
                const AtlasSample sample = layout.sampleFromPixel({x, y});
                CHECK(layout.pixelFromSample(sample) == AtlasPixel{x, y});
                CHECK((sample.texelX < 3 && sample.texelY < 2 && sample.light < 5 &&
                       sample.view < 7));
            }
        }
    }
}

TEST_CASE("the layouts are those of the interface's text") {
    const AtlasLayout angular{AtlasKind::kAngular, 3, 2, 5, 7};
    CHECK(angular.pixelFromSample({2, 1, 4, 3}) == AtlasPixel{2 * 7 + 3, 1 * 5 + 4});
    const AtlasLayout spatial{AtlasKind::kSpatial, 3, 2, 5, 7};
    CHECK(spatial.pixelFromSample({2, 1, 4, 3}) == AtlasPixel{3 * 3 + 2, 4 * 2 + 1});
    CHECK(atlasKindFromName(nameOf(AtlasKind::kSpatial)) == AtlasKind::kSpatial);
    CHECK_THROWS_AS(atlasKindFromName("round"), std::invalid_argument);
}

TEST_CASE("a header comes back from OpenEXR's attributes as it went in") {
    AtlasHeader header;
    header.layout = {AtlasKind::kSpatial, 3, 2, 4, 6};
    header.grid = AngularGrid(regularDirections(2, 2), regularDirections(3, 2));
    header.method = "published";
    header.plan = "poster";
    header.samples = 204;
    header.source = "cloth.zip";
    header.cosine = Cosine::kDivided;
    header.maxMeasuredTheta = 1.25;
    header.counts = {1, 2, 3, 0};
    header.colorSpace = "ACEScg";
    header.interopId = "lin_ap1_scene";
    Imf::Header exr(header.layout.width(), header.layout.height());
    storeAtlasHeader(header, exr);
    const AtlasHeader back = atlasHeaderFrom(exr, "test");
    CHECK(back.layout == header.layout);
    CHECK(back.method == header.method);
    CHECK(back.samples == header.samples);
    CHECK(back.cosine == header.cosine);
    CHECK(back.maxMeasuredTheta == doctest::Approx(1.25));
    CHECK(back.counts.nonfinite == 3);
    CHECK(back.interopId == header.interopId);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(angleBetween(back.grid.views()[i], header.grid.views()[i]) < 1e-6);
    }
    Imf::Header wrong(header.layout.width() + 1, header.layout.height());
    storeAtlasHeader(header, wrong);
    CHECK_THROWS_AS(atlasHeaderFrom(wrong, "test"), std::runtime_error);
    CHECK_THROWS_AS(atlasHeaderFrom(Imf::Header(2, 2), "test"), std::runtime_error);
}

TEST_SUITE_END();
