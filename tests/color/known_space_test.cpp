// SPDX-License-Identifier: BSD-3-Clause
#include "color/known_space.h"

#include <doctest/doctest.h>

#include <set>

namespace abrdf {

namespace {

constexpr std::array kSpaces{KnownSpace::kLinearRec709,  KnownSpace::kLinearP3D65,
                             KnownSpace::kLinearRec2020, KnownSpace::kAcesCg,
                             KnownSpace::kAces2065,      KnownSpace::kCieXyzD65,
                             KnownSpace::kSrgbTexture};

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("every space is found again by its OCIO name and by its interop id") {
        for (const KnownSpace space : kSpaces) {
            CHECK(knownSpace({std::string(ocioName(space))}) == space);
            CHECK(knownSpace({std::string(interopId(space))}) == space);
            CHECK(knownSpaceFromInteropId(interopId(space)) == space);
        }
    }

    TEST_CASE("no two spaces share a name or an id") {
        std::set<std::string_view> names;
        for (const KnownSpace space : kSpaces) {
            CHECK(names.insert(ocioName(space)).second);
            CHECK(names.insert(interopId(space)).second);
        }
    }

    TEST_CASE("a space is known by any of its aliases, in any case of letters") {
        CHECK(knownSpace({"Film scan", "LIN_AP1"}) == KnownSpace::kAcesCg);
        CHECK(knownSpace({"scene-linear", "lin_rec709"}) == KnownSpace::kLinearRec709);
        CHECK(knownSpace({"Utility - Linear - sRGB"}) == KnownSpace::kLinearRec709);
        CHECK(knownSpace({"srgb_tx"}) == KnownSpace::kSrgbTexture);
    }

    TEST_CASE("a space that is none of ours stays unknown") {
        CHECK_FALSE(knownSpace({}));
        CHECK_FALSE(knownSpace({""}));
        CHECK_FALSE(knownSpace({"Raw", "linear", "ACEScct"}));
        CHECK_FALSE(knownSpaceFromInteropId(""));
        CHECK_FALSE(knownSpaceFromInteropId("lin_rec709"));
        CHECK_FALSE(knownSpaceFromInteropId("lin_adobergb_scene"));
    }

    TEST_CASE("ids are those of the Color Interop Forum") {
        CHECK(interopId(KnownSpace::kLinearRec709) == "lin_rec709_scene");
        CHECK(interopId(KnownSpace::kLinearP3D65) == "lin_p3d65_scene");
        CHECK(interopId(KnownSpace::kLinearRec2020) == "lin_rec2020_scene");
        CHECK(interopId(KnownSpace::kAcesCg) == "lin_ap1_scene");
        CHECK(interopId(KnownSpace::kAces2065) == "lin_ap0_scene");
        CHECK(interopId(KnownSpace::kCieXyzD65) == "lin_ciexyzd65_scene");
        CHECK(interopId(KnownSpace::kSrgbTexture) == "srgb_rec709_scene");
    }

    TEST_CASE("ACES spaces are white at the ACES white, XYZ at equal energy, all others at D65") {
        for (const KnownSpace space : kSpaces) {
            const bool aces = space == KnownSpace::kAcesCg || space == KnownSpace::kAces2065;
            const std::array<float, 2> d65 = {0.3127F, 0.3290F};
            const std::array<float, 2> acesWhite = {0.32168F, 0.33767F};
            const std::array<float, 2> equalEnergy = {1.0F / 3, 1.0F / 3};
            const auto& white = space == KnownSpace::kCieXyzD65 ? equalEnergy
                                : aces                          ? acesWhite
                                                                : d65;
            CHECK(primaries(space).white == white);
        }
    }
}

}  // namespace abrdf
