// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/run_program.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

using namespace abrdf;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// A folder with three small databases in it, one of them broken, and a job on all of them.
class BatchFolder {
  public:
    BatchFolder() {
        const ProgramRun run = runProgram(path(), "demo a.zip --size 2 -q");
        REQUIRE_MESSAGE(run.status == 0, run.err);
        fs::copy_file(path() / "a.zip", path() / "c.zip");
        std::ofstream(path() / "b.zip") << "no archive";
        std::ofstream(path() / "job.toml")
            << "input = '[abc].zip'\noutput = 'out/{name}.exr'\nmethod = 'measured'\n"
               "[[material]]\ninput = 'a.zip'\noutput = 'out/{name}_map.exr'\ntexels = 'full'\n";
    }
    const fs::path& path() const { return folder_.path(); }

    json run(const std::string& options, int status) const {
        const ProgramRun run = runProgram(path(), "run job.toml --json " + options);
        CHECK_MESSAGE(run.status == status, run.err);
        err_ = run.err;
        return json::parse(run.out, nullptr, false);
    }
    const std::string& err() const { return err_; }

  private:
    TemporaryFolder folder_;
    mutable std::string err_;
};

std::string statusesOf(const json& summary) {
    std::string text;
    for (const json& m : summary["materials"]) text += m["status"].get<std::string>() + " ";
    return text;
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("a batch hears of its children's ends, though its parent ignores those of its own") {
    const BatchFolder folder;
    std::ofstream(folder.path() / "ignore.sh") << "trap '' CHLD; exec timeout 60 \"$@\"\n";
    const ProgramRun run =
        runProgram(folder.path(), "run job.toml --json --keep-going", "bash ignore.sh");
    CHECK(run.status == 1);
    CHECK(statusesOf(json::parse(run.out, nullptr, false)) == "done failed done done ");
}

TEST_CASE("a batch converts what its patterns name, and stops at a failure or goes on") {
    const BatchFolder folder;
    const json stopped = folder.run("--threads 1 --report r.json", 1);
    CHECK(statusesOf(stopped) == "done failed skipped skipped ");
    CHECK(stopped["materials"][1]["error"].get<std::string>().starts_with("b.zip: is not"));
    CHECK(folder.err().find("b.zip: is not") != std::string::npos);
    CHECK(fs::exists(folder.path() / "r.json"));
    CHECK_FALSE(fs::exists(folder.path() / "out" / "c.exr"));

    const json all = folder.run("--keep-going --threads 3 --memory 1600M", 1);
    CHECK(all["at_once"] == 3);
    CHECK(statusesOf(all) == "done failed done done ");
    CHECK(all["counts"]["failed"] == 1);
    CHECK(all["materials"][3]["report"]["texels"] == json::array({2, 2}));
    CHECK(all["materials"][0]["report"]["output"]["path"] == "out/a.exr");

    // The same bytes as from the command itself.
    REQUIRE(runProgram(folder.path(), "convert a.zip -o a.exr --method measured").status == 0);
    CHECK(bytesOf(folder.path() / "a.exr") == bytesOf(folder.path() / "out" / "a.exr"));
    CHECK(statusesOf(folder.run("--keep-going --resume", 1)) == "kept failed kept kept ");
    CHECK(statusesOf(folder.run("--keep-going --no-clobber", 1)) == "kept failed kept kept ");
}

TEST_CASE("shards of a batch are all of its materials, each once") {
    const BatchFolder folder;
    fs::remove(folder.path() / "b.zip");
    const json one = folder.run("--shard 1/2", 0);
    const json two = folder.run("--shard 2/2", 0);
    CHECK(one["materials"].size() == 2);
    CHECK(two["materials"].size() == 1);
    CHECK(two["materials"][0]["input"] == "c.zip");
}

TEST_CASE("a batch file that cannot be meant is refused before anything runs") {
    const BatchFolder folder;
    const auto fault = [&](const std::string& text, int status) {
        std::ofstream(folder.path() / "job.toml") << text;
        folder.run("", status);
        CHECK_FALSE(fs::exists(folder.path() / "out"));
        return folder.err();
    };
    CHECK(fault("input = 'no*.zip'\noutput = 'out/{name}.exr'\n", 1).find("no*.zip") !=
          std::string::npos);
    CHECK(fault("input = 'a.zip'\n", 1).find("job.toml:1") != std::string::npos);
    CHECK(fault("input = 'a.zip'\noutput = 'out/a.exr'\ntexles = 1\n", 2).find("texles") !=
          std::string::npos);
    CHECK(fault("input = '[ac].zip'\noutput = 'out/a.exr'\n", 2).find("{name}") !=
          std::string::npos);
    CHECK(fault("[material]\ninput = 'a.zip'\n", 1).find("[[material]]") != std::string::npos);
}

TEST_CASE("the jobs that come as examples name options that there are") {
    const TemporaryFolder folder;
    fs::create_directories(folder.path() / "examples" / "out");
    REQUIRE(runProgram(folder.path(), "demo examples/out/cloth.zip --size 1 -q").status == 0);
    std::size_t jobs = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(ABRDF_SOURCE_DIR) / "examples/jobs")) {
        ++jobs;
        const ProgramRun run =
            runProgram(folder.path(), "run --dry-run '" + entry.path().string() + "'");
        CHECK_MESSAGE(run.status == 0, run.err);
        CHECK(run.out.find("examples/out/cloth.zip -> ") != std::string::npos);
    }
    CHECK(jobs >= 3);
}

TEST_SUITE_END();
