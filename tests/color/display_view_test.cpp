// SPDX-License-Identifier: BSD-3-Clause
#include "color/color_config.h"
#include "color/delta_e.h"
#include "color/known_display.h"
#include "tests/support/fault_of.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace abrdf {

namespace {

namespace fs = std::filesystem;

const ColorConfig& shipped() {
    static const ColorConfig config =
        ColorConfig::load(fs::path(ABRDF_SOURCE_DIR) / "color/config.ocio");
    return config;
}

Rgb shown(Rgb color, const std::string& from, const DisplayView& how) {
    shipped().displayTransform(from, how).apply({&color, 1});
    return color;
}

// SMPTE ST 2084, eq. 5.2, of a luminance in nits.
double pqCode(double nits) {
    const double y = std::pow(nits / 10000, 2610.0 / 16384);
    return std::pow((3424.0 / 4096 + 2413.0 / 128 * y) / (1 + 2392.0 / 128 * y), 2523.0 / 32);
}

constexpr const char* kPlain = "Un-tone-mapped";

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("the defaults are the config's own, named in full") {
        const DisplayView names = shipped().resolved({}, "scene_linear");
        CHECK(names.display == shipped().displayNames().front());
        CHECK(names.view == shipped().viewNames(names.display).front());
        CHECK(shipped().resolved({"SRGB - display", "un-tone-mapped", ""}, "ACEScg").view ==
              kPlain);
        const auto space = shipped().encodedSpace({"sRGB - Display", kPlain, ""}, "ACEScg");
        CHECK(space.front() == "sRGB - Display");
        CHECK(shipped().isData(shipped().encodedSpace({"", "Raw", ""}, "ACEScg").front()));
    }

    TEST_CASE("a plain view is the display's own curve over its own primaries") {
        for (const float v : {0.0F, 0.002F, 0.01F, 0.18F, 0.5F, 1.0F}) {
            CAPTURE(v);
            const auto code = [&](const char* display) {
                return static_cast<double>(shown({v, v, v}, "ACEScg", {display, kPlain, ""}).g);
            };
            const double light = static_cast<double>(v);
            CHECK(std::abs(code("sRGB - Display") - srgbEncoded(light)) < 2e-5);
            CHECK(std::abs(code("Display P3 - Display") - srgbEncoded(light)) < 2e-5);
            CHECK(std::abs(code("Rec.1886 Rec.709 - Display") - std::pow(light, 1 / 2.4)) < 2e-5);
            CHECK(std::abs(code("P3-D65 - Display") - std::pow(light, 1 / 2.6)) < 2e-5);
            // OpenColorIO's displays put scene white at 100 nits.
            CHECK(std::abs(code("Rec.2100-PQ - Display") - pqCode(100 * light)) < 1e-3);
        }
        const Rgb red = shown({1, 0, 0}, "Linear P3-D65", {"Display P3 - Display", kPlain, ""});
        CHECK(std::abs(red.r - 1) < 1e-5);
        CHECK(std::abs(red.g) + std::abs(red.b) < 1e-4);
    }

    TEST_CASE("the filmic view keeps highlights that the plain one clips") {
        const auto grey = [](float v, const char* view) {
            return shown({v, v, v}, "scene_linear", {"sRGB - Display", view, ""}).g;
        };
        CHECK(grey(2, kPlain) >= 1);
        CHECK(grey(2, "ACES 1.0 - SDR Video") < 0.95F);
        CHECK(grey(4, "ACES 1.0 - SDR Video") > grey(2, "ACES 1.0 - SDR Video"));
    }

    TEST_CASE("an unknown display, view or look is answered with the nearest and with all") {
        const auto ask = [](const DisplayView& how) {
            return faultOf([&] { shipped().displayTransform("ACEScg", how); });
        };
        CHECK(contains(ask({"sRBG - Display", "", ""}), "Did you mean 'sRGB - Display'"));
        CHECK(contains(ask({"sRBG - Display", "", ""}), "color/config.ocio"));
        CHECK(contains(ask({"", "Untonemaped", ""}), "Did you mean 'Un-tone-mapped'"));
        CHECK(contains(ask({"", "", "+warm"}), "no look 'warm'"));
        CHECK(contains(ask({"", "", "+warm"}), "It has: none."));
        CHECK(contains(faultOf([] { shipped().displayTransform("Raw", {}); }), "space of data"));
        CHECK(contains(faultOf([] { shipped().displayTransform("ACEScq", {}); }), "'ACEScg'"));
    }

    TEST_CASE("a look is applied where it is asked for, and a missing role is called one") {
        const fs::path file = fs::temp_directory_path() / (std::to_string(getpid()) + "_look.ocio");
        std::ofstream(file)
            << "ocio_profile_version: 2\n"
               "roles: {default: Linear}\n"
               "file_rules: [!<Rule> {name: Default, colorspace: default}]\n"
               "displays: {D: [!<View> {name: V, colorspace: Linear}]}\n"
               "looks: [!<Look> {name: Half, process_space: Linear, transform: "
               "!<MatrixTransform> {matrix: [.5, 0, 0, 0, 0, .5, 0, 0, 0, 0, .5, 0, "
               "0, 0, 0, 1]}}]\n"
               "colorspaces: [!<ColorSpace> {name: Linear}]\n";
        const ColorConfig config = ColorConfig::load(file);
        fs::remove(file);
        Rgb color = {1, 0.5F, 0.25F};
        config.displayTransform("Linear", {"", "", "Half"}).apply({&color, 1});
        CHECK(color == Rgb{0.5F, 0.25F, 0.125F});
        config.displayTransform("Linear", {}).apply({&color, 1});
        CHECK(color == Rgb{0.5F, 0.25F, 0.125F});
        CHECK(contains(faultOf([&] {
                           config.resolved({"", "", "Hafl"}, "Linear");
                       }),
                       "mean 'Half'"));
        CHECK(contains(faultOf([&] { config.spaceName("scene_linear"); }),
                       "lacks the role 'scene_linear'"));
    }

    TEST_CASE("a config without a known space's name is reached over aces_interchange") {
        const fs::path file = fs::temp_directory_path() / (std::to_string(getpid()) + "_far.ocio");
        const auto load =
            [&](const std::string& roles) {
                std::ofstream(file)
                    << "ocio_profile_version: 2\nroles: {default: work, scene_linear: "
                       "work" +
                           roles +
                           "}\n"
                           "file_rules: [!<Rule> {name: Default, colorspace: default}]\n"
                           "displays: {D: [!<View> {name: V, colorspace: work}]}\n"
                           "colorspaces:\n  - !<ColorSpace> {name: interchange}\n"
                           "  - !<ColorSpace>\n    name: work\n"
                           "    to_scene_reference: !<BuiltinTransform> {style: "
                           "ACEScg_to_ACES2065-1}\n";
                const ColorConfig config = ColorConfig::load(file);
                fs::remove(file);
                return config;
            };
        const ColorConfig config = load(", aces_interchange: interchange");
        CHECK_FALSE(config.has("lin_rec709_scene"));
        CHECK(config.reaches("lin_rec709_scene"));
        CHECK_FALSE(config.reaches("Kodachrome"));
        Rgb there = {0.2F, 0.5F, 0.9F};
        Rgb expected = there;
        config.transform("Linear Rec.709 (sRGB)", "scene_linear").apply({&there, 1});
        shipped().transform("Linear Rec.709 (sRGB)", "ACEScg").apply({&expected, 1});
        CHECK(std::abs(there.r - expected.r) + std::abs(there.b - expected.b) < 1e-6);
        config.transform("scene_linear", "lin_rec709_scene").apply({&there, 1});
        CHECK(std::abs(there.r - 0.2F) + std::abs(there.b - 0.9F) < 2e-6);

        const ColorConfig lonely = load("");
        CHECK_FALSE(lonely.reaches("lin_rec709_scene"));
        CHECK(contains(faultOf([&] { lonely.transform("lin_rec709_scene", "work"); }),
                       "no colour space 'lin_rec709_scene'"));
    }

    TEST_CASE("a studio's config: Blender's, where Debian's blender-data has put it") {
        const fs::path file = "/usr/share/blender/datafiles/colormanagement/config.ocio";
        if (!fs::exists(file)) {
            MESSAGE("no blender-data: left out");
            return;
        }
        const ColorConfig config = ColorConfig::load(file);
        Rgb color = {0.2F, 0.5F, 0.9F};
        Rgb expected = color;
        config.transform("lin_rec709_scene", "scene_linear").apply({&color, 1});
        // Its matrices have four digits.
        CHECK(std::abs(color.r - expected.r) + std::abs(color.b - expected.b) < 1e-3);
        config.displayTransform("scene_linear", {"sRGB", "Standard", ""}).apply({&color, 1});
        CHECK(std::abs(static_cast<double>(color.g) - srgbEncoded(0.5)) < 1e-3);
        CHECK(knownDisplay(config.encodedSpace({"sRGB", "Standard", ""}, "scene_linear"))->name ==
              "sRGB");
        CHECK_FALSE(knownDisplay(config.encodedSpace({"sRGB", "Filmic", ""}, "scene_linear")));
        CHECK(contains(faultOf([&] {
                           config.resolved({"", "Standad", ""}, "scene_linear");
                       }),
                       "'Standard'"));
    }

    TEST_CASE("every display of the shipped config is one whose encoding files can state") {
        for (const std::string& display : shipped().displayNames()) {
            CAPTURE(display);
            const auto known =
                knownDisplay(shipped().encodedSpace({display, kPlain, ""}, "ACEScg"));
            REQUIRE(known);
            CHECK((known->curve == DisplayCurve::kPower) == (known->gamma > 0));
        }
        CHECK_FALSE(knownDisplay({"Gamma 1.8", "g18"}));
        CHECK((*knownDisplay({"Rec.2100-PQ"})->cicp)[1] == 16);
    }
}

}  // namespace abrdf
