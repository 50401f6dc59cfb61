// SPDX-License-Identifier: BSD-3-Clause
//
// Job files, plans, grids and manifests that are absurd.
#include "tests/bad/bad_images.h"
#include "tests/bad/bad_input.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A text beside a stack of one image, and what is made of both.
BadInput withText(const std::string& what, const std::string& name, const std::string& text,
                  const std::string& arguments, int status, const std::string& says) {
    return {what,
            [=](const fs::path& folder) {
                put(folder / stackImage("png"), blackPng(2));
                put(folder / name, text);
            },
            arguments, status, says};
}

BadInput job(const std::string& what, const std::string& text, int status,
             const std::string& says) {
    return withText(what, "job.toml", text,
                    "convert stack -o out.exr --method measured --config job.toml", status, says);
}

BadInput batch(const std::string& what, const std::string& text, const std::string& says) {
    return withText(what, "job.toml", text, "run job.toml", 1, says);
}

BadInput plan(const std::string& what, const std::string& text, const std::string& says,
              const std::string& name = "plan.toml") {
    return withText(what, name, text, "convert stack -o out.exr --method idw --plan " + name, 1,
                    says);
}

BadInput grid(const std::string& what, const std::string& text, const std::string& says) {
    return withText(what, "grid.csv", text,
                    "convert stack -o out.exr --method measured --grid grid.csv", 1, says);
}

BadInput scene(const std::string& what, const std::string& text, const std::string& says) {
    return withText(what, "arc.csv", text,
                    "convert stack -o out.exr --method measured --pairs arc.csv", 1, says);
}

BadInput option(const std::string& words, int status, const std::string& says) {
    return withText(words, "a.txt", "", "convert stack -o out.exr --method measured " + words,
                    status, says);
}

BadInput manifest(const std::string& what, const std::string& rows, const std::string& says,
                  int status = 1) {
    return {what,
            [=](const fs::path& folder) {
                put(folder / "a.png", blackPng(2));
                put(folder / "b" / "a, \"b\".png", blackPng(2));
                put(folder / "m.csv", "file,theta_i,phi_i,theta_v,phi_v\n" + rows);
            },
            "inspect m.csv", status, says};
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("bad input: job files") {
    checkBadInputs({
        job("no TOML", "texels : 4", 1, "job.toml:1: is not TOML"),
        job("a key twice", "threads = 1\nthreads = 2\n", 1, "job.toml:2: is not TOML"),
        job("10000 brackets", "a = " + std::string(10000, '['), 1, "job.toml:1: is not TOML"),
        job(
            "300 tables in one another",
            [] {
                std::string text = "a = ";
                for (int i = 0; i < 300; ++i) text += "{b=";
                return text;
            }(),
            1, "job.toml:1: is not TOML"),
        job("bytes that are no UTF-8", "method = \"\xff\xfe\"\n", 1, "is not TOML"),
        job("a zero byte", std::string("method = \"a\0\"", 13), 1, "is not TOML"),
        job("UTF-16", std::string("\xff\xfe\x61\0=\0\x31\0", 8), 1, "is not TOML"),
        job("an integer of 30 digits", "threads = 111111111111111111111111111111\n", 1,
            "is not TOML"),
        job("itself", "config = \"job.toml\"\n", 1, "job.toml:1: a job file cannot name another"),
        job("a key that is no option, but almost", "textels = \"1x1\"\n", 2,
            "did you mean --texels"),
        job("a table in place of a value", "[texels]\nwidth = 4\n", 1,
            "the key texels needs a text, a number or a list"),
        job("a date in place of a value", "method = 2020-01-01\n", 1, "the key method needs"),
        job("no texels", "texels = \"0x0\"\n", 2, "the texels '0x0' are not understood"),
        job("a key with a blank", "\"a b\" = 1\n", 2, "--a b"),
        withText("a folder in place of it", "job.toml/x", "",
                 "convert stack -o out.exr --config job.toml", 1, "job.toml: is a folder"),
        withText("a device without an end", "x", "", "convert stack -o out.exr --config /dev/zero",
                 1, "/dev/zero: is larger than 64 MB"),
        withText("nothing in place of it", "x", "", "convert stack -o out.exr --config none.toml",
                 1, "none.toml: cannot be opened"),
        batch("a batch of nothing", "", "job.toml: names no input"),
        batch("a batch without outputs", "input = \"stack\"\n", "have no key output"),
        batch("a batch of what is not there", "input = \"x*\"\noutput = \"{name}.exr\"\n",
              "no file or folder is x\\*"),
        batch("a batch of a number", "input = 7\noutput = \"{name}.exr\"\n",
              "the key input needs a text or a list"),
        batch("a batch whose materials are no tables",
              "output = \"{name}.exr\"\nmaterial = [1, 2]\n", "write \\[\\[material\\]\\]"),
        batch("a batch of itself", "input = \"job.toml\"\noutput = \"out.exr\"\n",
              "job.toml: is not a database"),
    });
}

TEST_CASE("bad input: plans and grids") {
    std::string many = "samples = [\n";
    for (int i = 0; i <= 100000; ++i) many += "[0,0,0,0],\n";
    checkBadInputs({
        plan("no samples", "name = \"a\"\n", "has no array `samples`"),
        plan("an empty plan", "samples = []\n", "holds 0 samples"),
        plan("a sample of NaN", "samples = [[nan, 0, 0, 0]]\n", "are not theta_i, phi_i"),
        plan("a sample of infinity", "samples = [[0, inf, 0, 0]]\n", "are not theta_i, phi_i"),
        plan("a sample at the horizon", "samples = [[90, 0, 0, 0]]\n", "below 90"),
        plan("a sample of three numbers", "samples = [[1, 2, 3]]\n",
             "a sample is \\[theta_i, phi_i, theta_v, phi_v\\]"),
        plan("a sample of texts", "samples = [[\"a\", 0, 0, 0]]\n", "is not four numbers"),
        plan("samples in samples", "samples = [[[0, 0, 0, 0]]]\n", "a sample is \\["),
        plan("100001 samples", many + "]\n", "holds 100001 samples"),
        plan("rubbish in CSV", "0,0,0,0\n0,0,zero,0\n", "plan.csv:2: .* is not a row", "plan.csv"),
        plan("NaN in CSV", "nan,0,0,0\n", "is not a row", "plan.csv"),
        scene("a scene of no pairs", "theta_i,phi_i,theta_v,phi_v,weight\n", "holds no pair"),
        scene("weights that sum to 0", "30,0,0,0,0\n20,0,0,0,0\n", "arc.csv.* sum to 0"),
        scene("a light below the horizon", "30,0,0,0\n91,0,0,0\n", "arc.csv:2: theta 91 degrees"),
        scene("a view of NaN", "30,0,nan,0\n", "arc.csv:1: .*is not a row"),
        scene("a weight below 0", "30,0,0,0,-2\n", "arc.csv:1: the weight -2"),
        scene("three numbers", "30,0,0\n", "is not a row"),
        grid("an empty grid", "", "holds no theta_deg,phi_deg row"),
        grid("a grid of NaN", "nan,0\n", "is not a row"),
        grid("a grid of one column", "10\n", "is not a row"),
        grid("a grid below the surface", "100,0\n", "is not a row theta_deg,phi_deg"),
        grid("bytes of any kind", std::string(5000, '\xfe'), "is not a row"),
        option("--grid regular:0x0", 2, "write regular:THETASxPHIS"),
        option("--grid regular:-1x4", 2, "write regular:THETASxPHIS"),
        option("--grid regular:99999999999999999999x1", 2, "write regular:THETASxPHIS"),
        option("--grid regular:1000x1000", 2, "is too small for this job; the smallest that works"),
        option("--grid none", 2, "there is no grid 'none'"),
        option("--texels 2147483647x2147483647", 2, "are more than the images'"),
        option("--texels 99999999999x1", 2, "are not understood"),
        option("--memory -1", 2, "the size '-1' is not understood"),
        option("--memory 1e99G", 2, "the size '1e99G' is not understood"),
        option("--threads 0", 2, "not in range 1 to 4096"),
        option("--threads 99999999", 2, "not in range 1 to 4096"),
        option("--max-image-pixels -1", 2, "Value -1 not in range 1 to"),
        option("--max-file-size lots", 2, "the size 'lots' is not understood"),
        option("--colorconfig stack", 1, "'stack' does not load: It is a folder"),
        option("--colorconfig a.txt", 1, "'a.txt' does not load"),
        option("--input-space nonsense", 1, "has no colour space 'nonsense'"),
        option("--pattern {tl}", 2, "lacks a key"),
        option("--pattern x{tl}{pl}{tv}{pv}y", 1, "fits the pattern"),
        withText("noise that is no number", "x", "",
                 "convert stack -o out.exr --plan eight --noise nan", 2,
                 "noise nan.* must be numbers"),
    });
}

TEST_CASE("bad input: manifests") {
    std::string scattered;
    for (int i = 0; i < 1500; ++i) {
        scattered += fmt::format("a.png,{},{},{},{}\n", i * 0.05, i * 0.2, i * 0.05, i * 0.2);
    }
    checkBadInputs({
        manifest("a good one, for comparison", "a.png,0,0,0,0\n", "complete +true", 0),
        manifest("names with a comma and quotes, lines of DOS",
                 "\"b/a, \"\"b\"\".png\",0,0,15,30\r\na.png,0,0,0,0\r\n", "complete +true", 0),
        manifest("no rows", "", "lists no image"),
        manifest("NaN", "a.png,nan,0,0,0\n", "not those of a direction"),
        manifest("infinity", "a.png,0,inf,0,0\n", "not those of a direction"),
        manifest("1e999", "a.png,0,1e999,0,0\n", "is not a row"),
        manifest("a theta below 0", "a.png,-10,0,0,0\n", "not those of a direction"),
        manifest("a phi of many turns", "a.png,10,99999,0,0\n", "not those of a direction"),
        manifest("all below the surface", "a.png,95,0,0,0\n",
                 "m.csv: none of its 1 images has light and view above the surface"),
        manifest("three columns", "a.png,0,0\n", "m.csv:2: .* is not a row"),
        manifest("six columns", "a.png,0,0,0,0,0\n", "m.csv:2: .* is not a row"),
        manifest("no name", ",0,0,0,0\n", "is not a row"),
        manifest("a quote that never ends", "\"a.png,0,0,0,0\n", "is not a row"),
        manifest("a file that is not there", "none.png,0,0,0,0\n", "none.png: cannot be opened"),
        manifest("a folder in place of a file", "b,0,0,0,0\n", "b: cannot be read: Is a directory"),
        manifest("a pair twice", "a.png,0,0,0,0\na.png,0,0,0,0\n", "duplicate +1"),
        manifest("1500 directions that form no grid", scattered,
                 "m.csv: its 1500 images .* they do not form a grid"),
        manifest("bytes of any kind", std::string(3000, '\xfd'), "is not a row"),
        {"angles of NaN in names",
         [](const fs::path& f) { put(f / "s" / "tlnan plnan tvnan pvnan.png", blackPng(2)); },
         "inspect s", 1, "is not a database"},
        {"a theta of 999 in a name",
         [](const fs::path& f) { put(f / "s" / "tl999 pl000 tv000 pv000.png", blackPng(2)); },
         "inspect s", 1, "tl999 .* theta must be from 0 to 180"},
    });
}

TEST_SUITE_END();
