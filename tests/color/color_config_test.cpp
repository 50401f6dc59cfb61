// SPDX-License-Identifier: BSD-3-Clause
#include "color/color_config.h"

#include "tests/support/fault_of.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace abrdf {

namespace {

namespace fs = std::filesystem;

// $OCIO for the length of a test; nothing means unset.
class OcioVariable {
  public:
    explicit OcioVariable(const std::optional<std::string>& value) {
        if (const char* before = std::getenv("OCIO")) before_ = before;
        set(value);
    }
    ~OcioVariable() { set(before_); }
    OcioVariable(const OcioVariable&) = delete;
    OcioVariable& operator=(const OcioVariable&) = delete;

  private:
    static void set(const std::optional<std::string>& value) {
        value ? setenv("OCIO", value->c_str(), 1) : unsetenv("OCIO");
    }
    std::optional<std::string> before_;
};

// A file that is there for the length of a test.
class TemporaryFile {
  public:
    TemporaryFile(const std::string& name, const std::string& text)
        : path_(fs::temp_directory_path() / (std::to_string(getpid()) + name)) {
        std::ofstream(path_) << text;
    }
    ~TemporaryFile() { fs::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

// A config of two spaces around an ACES reference, as the ASWF has it.
std::string acesReferenceConfig(const std::string& textureName) {
    const std::string toRec709 =
        "{style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD, direction: inverse}";
    return "ocio_profile_version: 2\n"
           "roles: {default: Linear, scene_linear: Linear}\n"
           "file_rules: [!<Rule> {name: Default, colorspace: default}]\n"
           "displays: {D: [!<View> {name: V, colorspace: Linear}]}\n"
           "colorspaces:\n  - !<ColorSpace>\n    name: Linear\n"
           "    to_scene_reference: !<BuiltinTransform> " +
           toRec709 + "\n  - !<ColorSpace>\n    name: " + textureName +
           "\n    to_scene_reference: !<GroupTransform>\n"
           "      children:\n"
           "        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055}\n"
           "        - !<BuiltinTransform> " +
           toRec709 + "\n";
}

bool before(const std::string& text, const std::string& first, const std::string& second) {
    return contains(text, first) && text.find(first) < text.find(second);
}

ColorConfig shipped() {
    const OcioVariable none(std::nullopt);
    return ColorConfig::load();
}

std::vector<Rgb> someColors(std::size_t count) {
    std::vector<Rgb> colors(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto t = static_cast<float>(i) / static_cast<float>(count);
        colors[i] = {t, 1 - t, 4 * t * t};
    }
    return colors;
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("the config is the file's, else that of $OCIO, else the shipped one") {
        const TemporaryFile file("_file.ocio", acesReferenceConfig("From the file"));
        const TemporaryFile named("_named.ocio", acesReferenceConfig("From the variable"));
        const OcioVariable ocio(named.path().string());

        const ColorConfig first = ColorConfig::load(file.path());
        CHECK(first.origin() == file.path().string());
        CHECK(first.spaceName("from the file") == "From the file");

        const ColorConfig second = ColorConfig::load();
        CHECK(second.origin() == named.path().string());
        CHECK(second.spaceName("From the variable") == "From the variable");

        const OcioVariable empty("");
        CHECK(ColorConfig::load().origin() == "shipped");
        const OcioVariable unset(std::nullopt);
        CHECK(ColorConfig::load().origin() == "shipped");
    }

    TEST_CASE("a chosen config that does not load is named, with the reason and the remedy") {
        const OcioVariable unset(std::nullopt);
        const auto load = [](const fs::path& path) {
            return faultOf([&] { ColorConfig::load(path); });
        };
        const std::string missing = load("/no/such/config.ocio");
        CHECK(contains(missing, "'/no/such/config.ocio' does not load"));
        CHECK(contains(missing, "could not read"));
        CHECK(contains(missing, "--colorconfig"));

        const TemporaryFile garbage("_garbage.ocio", "colorspaces: [not, a, config");
        CHECK(contains(load(garbage.path()), garbage.path().string()));
        const TemporaryFile nothing("_nothing.ocio", "");
        CHECK(contains(load(nothing.path()), "does not load"));
        CHECK(contains(load(fs::temp_directory_path()), "It is a folder"));
        CHECK(contains(load(""), "does not load"));
    }

    TEST_CASE("a config that loads but contradicts itself is refused") {
        const std::string text = acesReferenceConfig("Texture");
        const std::string view = "V, colorspace: Linear";
        const TemporaryFile file(
            "_invalid.ocio",
            std::string(text).replace(text.find(view), view.size(), "V, colorspace: Nowhere"));
        const std::string error = faultOf([&] { ColorConfig::load(file.path()); });
        CHECK(contains(error, file.path().string()));
        CHECK(contains(error, "Nowhere"));
    }

    TEST_CASE("$OCIO that names no file is an error, never the shipped config in silence") {
        const OcioVariable ocio("/no/such/config.ocio");
        const std::string error = faultOf([] { ColorConfig::load(); });
        CHECK(contains(error, "'/no/such/config.ocio'"));
        CHECK(contains(error, "environment variable OCIO"));
    }

    TEST_CASE("a space answers to its name, its aliases and its roles, in any case of letters") {
        const ColorConfig config = shipped();
        for (const char* name : {"ACEScg", "acescg", "lin_ap1", "LIN_AP1", "lin_ap1_scene"}) {
            CHECK(config.spaceName(name) == "ACEScg");
        }
        CHECK(config.spaceName("scene_linear") == "Linear Rec.709 (sRGB)");
        CHECK(config.spaceName("aces_interchange") == "ACES2065-1");
        const std::vector<std::string> aliases = config.aliases("lin_ap1");
        CHECK(aliases.front() == "ACEScg");
        CHECK(std::count(aliases.begin(), aliases.end(), "lin_ap1") == 1);
    }

    TEST_CASE("an unknown space is answered with the nearest names, then with all") {
        const ColorConfig config = shipped();
        const auto ask = [&](const std::string& name) {
            return faultOf([&] { config.spaceName(name); });
        };
        CHECK(contains(ask("ACEScq"), "The colour config 'shipped' has no colour space 'ACEScq'."));
        CHECK(before(ask("ACEScq"), "Did you mean 'ACEScg'", "It has: '"));
        CHECK(before(ask("acesgc"), "Did you mean 'ACEScg'", "It has: '"));
        CHECK(before(ask("lin_rec790"), "'lin_rec709'", "It has: '"));
        CHECK(before(ask("Linear Rec2021"), "'Linear Rec.2020'", "It has: '"));
        CHECK(before(ask("scene_liner"), "'scene_linear'", "It has: '"));
        CHECK(before(ask("texture"), "'sRGB - Texture'", "It has: '"));
        CHECK_FALSE(contains(ask("Kodachrome"), "Did you mean"));
        for (const std::string& name : config.spaceNames()) {
            CHECK(contains(ask("Kodachrome"), "'" + name + "'"));
        }
        CHECK(contains(faultOf([&] { config.transform("ACEScg", ""); }), "no colour space ''"));
        CHECK(contains(faultOf([&] { config.transform("Kodachrome", "ACEScg"); }), "'Kodachrome'"));
        CHECK(contains(faultOf([&] { config.aliases("Kodachrome"); }), "'Kodachrome'"));
    }

    TEST_CASE("a transform between names of one space is the identity and changes no bit") {
        const ColorConfig config = shipped();
        const std::vector<Rgb> colors = someColors(9);
        for (const ColorTransform& same :
             {config.transform("lin_rec709", "scene_linear"), config.transform("ACEScg", "lin_ap1"),
              config.transform("Raw", "ACEScg"), ColorTransform{}}) {
            CHECK(same.isIdentity());
            CHECK(same.isPerChannel());
            std::vector<Rgb> converted = colors;
            same.apply(converted);
            CHECK(converted == colors);
        }
        CHECK_FALSE(config.transform("srgb_tx", "lin_rec709").isIdentity());
        CHECK_FALSE(config.transform("ACEScg", "ACES2065-1").isPerChannel());
    }

    TEST_CASE("sRGB is per channel even where matrices to an ACES reference must cancel") {
        const TemporaryFile file("_aces.ocio", acesReferenceConfig("Texture"));
        const ColorTransform transform =
            ColorConfig::load(file.path()).transform("Texture", "Linear");
        CHECK(transform.isPerChannel());
        std::array<Rgb, 1> red = {Rgb{0.5F, 0, 0}};
        transform.apply(red);
        CHECK(red[0] == Rgb{0.214041144F, 0, 0});
    }

    TEST_CASE("a long row of colours comes out as each colour does alone") {
        const ColorTransform transform = shipped().transform("srgb_tx", "ACEScg");
        std::vector<Rgb> together = someColors(10'001);
        std::vector<Rgb> alone = together;
        transform.apply(together);
        for (Rgb& color : alone) transform.apply({&color, 1});
        CHECK(together == alone);
        transform.apply({});
    }
}

TEST_SUITE("threads") {
    TEST_CASE("one transform serves many threads, with the same bits") {
        const ColorTransform transform = shipped().transform("srgb_tx", "ACEScg");
        std::vector<Rgb> expected = someColors(20'000);
        std::vector<std::vector<Rgb>> results(4, expected);
        transform.apply(expected);
        std::vector<std::thread> threads;
        for (auto& result : results) {
            threads.emplace_back([&transform, &result] { transform.apply(result); });
        }
        for (std::thread& thread : threads) thread.join();
        for (const auto& result : results) CHECK(result == expected);
    }
}

}  // namespace abrdf
