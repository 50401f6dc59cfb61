// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/atlas_reader.h"
#include "tests/support/fault_of.h"
#include "tests/support/files_in.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A folder with a small demo database in it, made by the program itself once a run.
const fs::path& demoZip() {
    static const TemporaryFolder folder;
    static const fs::path zip = [] {
        const ProgramRun run = runProgram(folder.path(), "demo cloth.zip --size 4 -q");
        REQUIRE_MESSAGE(run.status == 0, run.err);
        return folder.path() / "cloth.zip";
    }();
    return zip;
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("help is an answer, not a fault, for the program and for each command") {
    const TemporaryFolder folder;
    for (const char* command : {"", "convert", "inspect", "evaluate", "chart", "plan", "stress",
                                "preview", "report", "run", "merge", "demo"}) {
        const ProgramRun run = runProgram(folder.path(), std::string(command) + " --help");
        CHECK(run.status == 0);
        CHECK(contains(run.out, "Usage"));
        CHECK(run.err.empty());
    }
    CHECK(runProgram(folder.path(), "--version").status == 0);
    const ProgramRun methods = runProgram(folder.path(), "--list-methods");
    CHECK(methods.status == 0);
    CHECK(contains(methods.out, "published"));
}

TEST_CASE("wrong usage is short, names the nearest right word, and exits with 2") {
    const TemporaryFolder folder;
    const ProgramRun option = runProgram(folder.path(), "convert a.zip -o b.exr --metod measured");
    CHECK(option.status == 2);
    CHECK(contains(option.err, "did you mean --method?"));
    CHECK(std::ranges::count(option.err, '\n') == 1);
    const ProgramRun command = runProgram(folder.path(), "convrt");
    CHECK(command.status == 2);
    CHECK(contains(command.err, "did you mean convert?"));
    CHECK(runProgram(folder.path(), "").status == 2);
    CHECK(runProgram(folder.path(), "convert a.zip").status == 2);
    const ProgramRun method = runProgram(folder.path(), "convert a.zip -o b.exr --method magic");
    CHECK(method.status == 2);
    CHECK(contains(method.err, "published"));
    CHECK(runProgram(folder.path(), "convert a.zip -o b.exr --texels 0x4").status == 2);
    CHECK(runProgram(folder.path(), "convert a.zip -o b.exr --elevations 30,30").status == 2);
    CHECK(runProgram(folder.path(), "convert a.zip -o b.exr", "ABRDF_THREADS=many").status == 2);
}

TEST_CASE("a fault of the world is one sentence with the file's name, and exits with 1") {
    const TemporaryFolder folder;
    const ProgramRun absent = runProgram(folder.path(), "convert nothing.zip -o b.exr");
    CHECK(absent.status == 1);
    CHECK(contains(absent.err, "nothing.zip"));
    std::ofstream(folder.path() / "text.zip") << "no archive";
    const ProgramRun text = runProgram(folder.path(), "inspect text.zip");
    CHECK(text.status == 1);
    CHECK(contains(text.err, "text.zip: is not a database"));
    const ProgramRun noFolder =
        runProgram(folder.path(), "convert '" + demoZip().string() + "' -o no/such/b.exr");
    CHECK(noFolder.status == 1);
    CHECK(contains(noFolder.err, "does not exist"));
    const ProgramRun space = runProgram(
        folder.path(), "convert '" + demoZip().string() + "' -o b.exr --input-space nonsense");
    CHECK(space.status == 1);
    CHECK(contains(space.err, "ACEScg"));
    const ProgramRun config = runProgram(
        folder.path(), "convert '" + demoZip().string() + "' -o b.exr", "OCIO=/no/config.ocio");
    CHECK(config.status == 1);
    CHECK(contains(config.err, "/no/config.ocio"));
    CHECK(filesIn(folder.path()) == std::vector<std::string>{"text.zip"});
}

TEST_CASE("convert, inspect and evaluate agree about one database") {
    const TemporaryFolder folder;
    const std::string zip = "'" + demoZip().string() + "'";
    const ProgramRun convert = runProgram(
        folder.path(),
        "convert " + zip + " -o a.exr --report a.json --grid utia288 --method published");
    REQUIRE_MESSAGE(convert.status == 0, convert.err);
    CHECK(readAtlasHeader(folder.path() / "a.exr").layout.width() == 288);
    std::ifstream stream(folder.path() / "a.json");
    const auto report = nlohmann::json::parse(stream);
    CHECK(report["plan"]["samples"] == 204);
    CHECK(report["output"]["path"] == "a.exr");
    CHECK(report["counts"]["missing"] == 0);

    const auto inspected =
        nlohmann::json::parse(runProgram(folder.path(), "inspect a.exr --json").out);
    CHECK(inspected["source"] == "cloth.zip");
    CHECK(inspected["complete"] == true);
    const ProgramRun database = runProgram(folder.path(), "inspect " + zip + " --json");
    CHECK(database.status == 0);
    CHECK(nlohmann::json::parse(database.out)["images"] == 6561);

    const ProgramRun evaluate = runProgram(
        folder.path(), "evaluate --sheet s.png --json --method measured,published " + zip);
    REQUIRE_MESSAGE(evaluate.status == 0, evaluate.err);
    const auto results = nlohmann::json::parse(evaluate.out)["results"];
    CHECK(results[0]["delta_e"] == 0.0);
    CHECK(results[1]["delta_e"] > 0.1);
    CHECK(results[1]["images_read"] == report["plan"]["images_read"]);
    CHECK(fs::exists(folder.path() / "s.png"));
}

TEST_CASE("preview makes pictures of every kind, and says wrong usage as such") {
    const TemporaryFolder folder;
    const std::string zip = "'" + demoZip().string() + "'";
    REQUIRE(runProgram(folder.path(),
                       "convert -q --method published " + zip + " -o a.exr --texels full")
                .status == 0);
    REQUIRE(runProgram(folder.path(), "convert -q " + zip + " -o m.exr --method measured").status ==
            0);
    for (const char* words :
         {"a.exr -o sphere.png", "a.exr -o plane.jpg --kind plane --light 30,40",
          "a.exr -o drape.exr --kind drape --environment sky --draft",
          "a.exr -o polar.png --kind polar", "a.exr -o sheet.png --kind sheet --reference m.exr",
          "a.exr -o pairs.png --kind sheet --pair 30,0,15,90 --pair 60,0,60,180"}) {
        const ProgramRun run =
            runProgram(folder.path(), std::string("preview --size 48x40 --json ") + words);
        CAPTURE(words);
        REQUIRE_MESSAGE(run.status == 0, run.err);
        const auto report = nlohmann::json::parse(run.out);
        CHECK(report["command"] == "preview");
        CHECK(report["color"]["config"] == "shipped");
        CHECK(fs::file_size(folder.path() / report["output"]["path"].get<std::string>()) > 100);
    }
    CHECK(runProgram(folder.path(), "preview a.exr m.exr --html page.html").status == 0);
    const auto report =
        nlohmann::json::parse(runProgram(folder.path(), "report . -o page.html --json").out);
    CHECK(report["materials"] == 1);
    const auto pageSize = fs::file_size(folder.path() / "page.html");
    CHECK(runProgram(folder.path(), "report . -o page.html --title x --no-clobber").status == 0);
    CHECK(fs::file_size(folder.path() / "page.html") == pageSize);
    CHECK(runProgram(folder.path(), "preview a.exr m.exr -o a.png").status == 2);
    CHECK(runProgram(folder.path(), "preview a.exr").status == 2);
    CHECK(runProgram(folder.path(), "preview a.exr -o a.png --kind cube").status == 2);
    CHECK(runProgram(folder.path(), "preview a.exr -o a.png --size 0x4").status == 2);
    CHECK(runProgram(folder.path(), "preview a.exr -o a.png --light 1").status == 2);
    CHECK(runProgram(folder.path(), "preview a.exr -o a.png --background blue").status == 2);
    const ProgramRun display = runProgram(folder.path(), "preview a.exr -o a.png --display sRBG");
    CHECK(display.status == 1);
    CHECK(contains(display.err, "sRGB - Display"));
    CHECK_FALSE(fs::exists(folder.path() / "a.png"));
}

TEST_CASE("a dry run lists the images and writes nothing, no-clobber keeps an old file") {
    const TemporaryFolder folder;
    const std::string zip = "'" + demoZip().string() + "'";
    const ProgramRun dry =
        runProgram(folder.path(), "convert " + zip + " -o a.exr --dry-run --json");
    CHECK(dry.status == 0);
    const auto plan = nlohmann::json::parse(dry.out);
    CHECK(plan["images"].size() == plan["plan"]["images_read"].get<std::size_t>());
    CHECK(filesIn(folder.path()).empty());
    std::ofstream(folder.path() / "a.exr") << "old";
    CHECK(runProgram(folder.path(), "convert " + zip + " -o a.exr --no-clobber").status == 0);
    CHECK(fs::file_size(folder.path() / "a.exr") == 3);
}

TEST_CASE("a model trained ahead serves its plan, and no other") {
    const TemporaryFolder folder;
    const std::string zip = "'" + demoZip().string() + "'";
    const ProgramRun train =
        runProgram(folder.path(), "train --plan greedy:40 --materials 30 -o m.model --json -q");
    REQUIRE_MESSAGE(train.status == 0, train.err);
    CHECK(nlohmann::json::parse(train.out)["plan"]["samples"] == 40);
    const ProgramRun run = runProgram(
        folder.path(), "convert " + zip + " -o a.exr --plan greedy:40 --model m.model --json");
    REQUIRE_MESSAGE(run.status == 0, run.err);
    const auto report = nlohmann::json::parse(run.out);
    CHECK(report["method"] == "prior");
    CHECK(report["plan"]["images_read"] == 40);
    CHECK(readAtlasHeader(folder.path() / "a.exr").plan == "greedy:40");
    const ProgramRun other =
        runProgram(folder.path(), "convert " + zip + " -o b.exr --plan greedy:39 --model m.model");
    CHECK(other.status == 1);
    CHECK(contains(other.err, "m.model: was trained for 40 samples"));
    CHECK(filesIn(folder.path()) == std::vector<std::string>{"a.exr", "m.model"});
}

TEST_CASE("a plan in a file is taken as it stands") {
    const TemporaryFolder folder;
    const std::string zip = "'" + demoZip().string() + "'";
    std::ofstream(folder.path() / "few.csv")
        << "theta_i,phi_i,theta_v,phi_v\n30,0,30,180\n60,90,45,20\n0,0,75,15\n15,60,15,0\n";
    const auto convert = [&](const std::string& plan) {
        return runProgram(folder.path(),
                          "convert " + zip + " -o a.exr --dry-run --json --plan " + plan);
    };
    CHECK(nlohmann::json::parse(convert("few.csv").out)["plan"]["images_read"] == 4);
    std::ofstream(folder.path() / "few.toml")
        << "name = 'few'\nsamples = [[30, 0, 30, 180], [60, 90, 45, 20]]\n";
    CHECK(nlohmann::json::parse(convert("few.toml").out)["plan"]["name"] == "few");
    std::ofstream(folder.path() / "bad.csv") << "30,0,30,180\n60,90,95,20\n";
    const ProgramRun bad = convert("bad.csv");
    CHECK(bad.status == 1);
    CHECK(contains(bad.err, "bad.csv:2"));
    const ProgramRun first = convert("few.csv:9");
    CHECK(nlohmann::json::parse(first.out)["plan"]["images_read"] == 4);
    std::ofstream(folder.path() / "far.csv") << "30,0,30,180\n75,7,75,0\n88,0,30,0\n";
    const ProgramRun far = convert("far.csv");
    CHECK(far.status == 1);
    CHECK(contains(far.err, "1 of its 3 samples has no measured pair within 10 degrees"));
    CHECK(contains(far.err, "theta_i 88"));
    CHECK(contains(convert("far.csv --snap 5").err, "2 of its 3"));
    CHECK(convert("far.csv --snap 20").status == 0);
    CHECK(convert("far.csv --snap 200").status == 2);
    CHECK(convert("nothing.toml:9").status == 2);
}

TEST_CASE("what abrdf plan writes is taken as a plan, whole or its beginning") {
    const TemporaryFolder folder;
    const std::string zip = "'" + demoZip().string() + "'";
    const ProgramRun planned =
        runProgram(folder.path(),
                   "plan --samples 14 --materials 20 --input " + zip + " -o plan.toml --json -q");
    REQUIRE_MESSAGE(planned.status == 0, planned.err);
    const auto report = nlohmann::json::parse(planned.out);
    CHECK(report["candidates"] == 6561);
    CHECK(report["expected_error"].size() == 14);
    for (const auto& [plan, images] : {std::pair{"plan.toml", 14}, {"plan.toml:9", 9}}) {
        const ProgramRun run = runProgram(
            folder.path(), "convert " + zip + " -o a.exr --dry-run " + "--json --plan " + plan);
        CHECK(nlohmann::json::parse(run.out)["plan"]["images_read"] == images);
    }
    CHECK(runProgram(folder.path(), "plan -o a.toml --samples 0").status == 2);
    CHECK(runProgram(folder.path(), "plan -o a.toml --elevations 30,60").status == 2);
    CHECK(runProgram(folder.path(), "plan -o a.toml --grid ubo81 --input x.zip").status == 2);
    CHECK(runProgram(folder.path(), "plan -o a.toml --input nothing.zip").status == 1);
    CHECK_FALSE(fs::exists(folder.path() / "a.toml"));
}

TEST_CASE("a TOML file gives the same options, and the command line wins over it") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "job.toml")
        << "input = '" << demoZip().string() << "'\noutput = 'a.exr'\ntexels = '2x2'\n"
        << "elevations = [30, 60]\nlayout = 'spatial'\nmethod = 'published'\n";
    const ProgramRun run = runProgram(folder.path(), "convert --config job.toml --texels 3x1");
    REQUIRE_MESSAGE(run.status == 0, run.err);
    const AtlasHeader header = readAtlasHeader(folder.path() / "a.exr");
    CHECK(header.layout.texelsWide == 3);
    CHECK(header.layout.kind == AtlasKind::kSpatial);
    std::ofstream(folder.path() / "bad.toml") << "input = [\n";
    const ProgramRun bad = runProgram(folder.path(), "convert --config bad.toml");
    CHECK(bad.status == 1);
    CHECK(contains(bad.err, "bad.toml"));
}

TEST_CASE("progress for farms is one JSON object a line, and each phase ends with all of it done") {
    const TemporaryFolder folder;
    const ProgramRun run =
        runProgram(folder.path(), "convert '" + demoZip().string() +
                                      "' -o a.exr --texels full --method measured --progress json");
    REQUIRE_MESSAGE(run.status == 0, run.err);
    std::istringstream lines(run.err);
    std::string phases;
    for (std::string line; std::getline(lines, line);) {
        const auto tick = nlohmann::json::parse(line);
        CHECK(tick["done"] <= tick["total"]);
        for (const char* key : {"unit", "seconds", "rate", "seconds_left"}) {
            CHECK(tick.contains(key));
        }
        if (tick["done"] == tick["total"]) phases += tick["phase"].get<std::string>() + " ";
    }
    CHECK(phases == "read reconstruct ");
}

TEST_CASE("an interrupt leaves no file behind and ends by its signal") {
    const TemporaryFolder folder;
    const ProgramRun run =
        runProgram(folder.path(), "demo big --size 512", "timeout --preserve-status -s INT 3");
    CHECK(run.status != 0);
    CHECK(filesIn(folder.path()).empty());
    CHECK(contains(run.err, "interrupted"));
}

TEST_CASE("a pipe that nobody writes to can be interrupted") {
    const TemporaryFolder folder;
    REQUIRE(mkfifo((folder.path() / "fifo.csv").c_str(), 0600) == 0);
    const ProgramRun run =
        runProgram(folder.path(), "convert " + demoZip().string() + " -o a.exr --grid fifo.csv",
                   "timeout --preserve-status -k 20 -s INT 3");
    CHECK(run.status == 130);
    CHECK(contains(run.err, "interrupted"));
}

TEST_CASE("a hang-up that the parent ignores, as nohup does, is ignored") {
    const TemporaryFolder folder;
    const auto hungUp = [&](const std::string& trap, const std::string& target) {
        std::ofstream(folder.path() / "hang_up.sh")
            << trap << "\n\"$@\" & sleep 0.7; kill -HUP $!; wait $!\n";
        return runProgram(folder.path(), "demo " + target + " --size 64", "bash hang_up.sh");
    };
    CHECK(hungUp("trap '' HUP", "d").status == 0);
    CHECK(fs::exists(folder.path() / "d"));
    CHECK(hungUp("", "e").status != 0);
    CHECK_FALSE(fs::exists(folder.path() / "e"));
}

TEST_CASE("whatever is printed is a failure where it cannot be") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "full.sh") << "exec \"$@\" >/dev/full\n";
    for (const char* words : {"--list-methods", "--help", "--version", "convert --help"}) {
        CAPTURE(words);
        const ProgramRun run = runProgram(folder.path(), words, "bash full.sh");
        CHECK(run.status == 1);
        CHECK(contains(run.err, "standard output cannot be written"));
    }
}

TEST_CASE("an atlas is exported and read again, and the encoding and the grazing can be chosen") {
    const TemporaryFolder folder;
    const std::string make =
        "convert " + demoZip().string() + " -o a.exr --method measured --grid utia288 -q";
    REQUIRE(runProgram(folder.path(), make).status == 0);
    const ProgramRun run = runProgram(
        folder.path(), "export a.exr --to utia-bin -o a.bin --utia-encoding srgb140 --json");
    CHECK(run.status == 0);
    CHECK(nlohmann::json::parse(run.out)["encoding"] == "srgb140");
    CHECK(fs::exists(folder.path() / "a.bin.json"));
    const ProgramRun told = runProgram(folder.path(), "inspect a.bin --utia-encoding srgb140");
    CHECK(told.status == 0);
    CHECK(contains(told.out, "encoding srgb140, as asked for"));
    CHECK(runProgram(folder.path(), "export a.exr --to utia-bin -o b.bin --grazing fade").status ==
          0);
    const ProgramRun wrong = runProgram(folder.path(), "export a.exr --to png -o a.png");
    CHECK(wrong.status == 2);
    CHECK(contains(wrong.err, "utia-bin utia-exr merl"));
    CHECK(runProgram(folder.path(), "export a.exr --to merl -o a.exr").status == 1);
}

TEST_CASE("a header that declares gigabytes in a kilobyte is one sentence and status 1") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "lie.mbsdf", std::ios::binary)
        << "NVIDIA ARC MBSDF V1\nMBSDF_DATA_REFLECTION=\n"
        << std::string("\1\0\0\0\0\2\0\0\0\2\0\0", 12) << std::string(1000, 'x');
    for (const char* command : {"inspect lie.mbsdf", "convert lie.mbsdf -o a.exr"}) {
        const ProgramRun run = runProgram(folder.path(), command);
        CHECK(run.status == 1);
        CHECK(contains(run.err, "lie.mbsdf: is damaged or cut"));
        CHECK(std::ranges::count(run.err, '\n') == 1);
    }
}

TEST_SUITE_END();
