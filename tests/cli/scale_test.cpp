// SPDX-License-Identifier: BSD-3-Clause
//
// The program within its memory, and killed.
#include "tests/support/run_program.h"
#include "tests/support/sanitizers.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A demo database of 256 texels, made once a run.
const std::string& demo() {
    static const TemporaryFolder folder;
    static const std::string zip = [] {
        const ProgramRun run = runProgram(folder.path(), "demo cloth.zip --size 16 -q");
        REQUIRE_MESSAGE(run.status == 0, run.err);
        return (folder.path() / "cloth.zip").string();
    }();
    return zip;
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("too small a budget names the smallest that works, and the kernel sees that kept") {
    const TemporaryFolder folder;
    for (const char* kind : {"--method measured", "--plan greedy:32 --layout spatial"}) {
        const std::string job = "convert " + demo() + " -o a.exr --texels full --json " + kind;
        REQUIRE(runProgram(folder.path(), job).status == 0);
        const std::string bytes = bytesOf(folder.path() / "a.exr");
        const ProgramRun small = runProgram(folder.path(), job + " --memory 8M");
        CHECK(small.status == 2);
        const auto at = small.err.find("works is ");
        REQUIRE_MESSAGE(at != std::string::npos, small.err);
        const std::uint64_t smallest = std::stoul(small.err.substr(at + 9));
        if (!kSanitized) CHECK(smallest < 256);
        const ProgramRun run =
            runProgram(folder.path(), job + " --memory " + std::to_string(smallest) + "M");
        REQUIRE_MESSAGE(run.status == 0, run.err);
        // VmHWM, which getrusage() reports.
        if (!kSanitized) CHECK(nlohmann::json::parse(run.out)["peak_memory"] <= (smallest << 20U));
        CHECK(bytesOf(folder.path() / "a.exr") == bytes);
    }
}

TEST_CASE("killed without warning, a job is resumed to the bytes of one that was not") {
    const TemporaryFolder folder;
    const std::string job =
        "convert " + demo() + " --texels full --method measured --compression piz -o ";
    REQUIRE(runProgram(folder.path(), job + "whole.exr").status == 0);
    // SIGKILL as soon as the unfinished file holds a megabyte.
    std::ofstream(folder.path() / "kill.sh") << R"("$@" & p=$!
while kill -0 $p 2> /dev/null; do
    size=$(stat -c %s .a.exr.abrdf-partial 2> /dev/null || echo 0)
    [ $size -gt 1000000 ] && kill -KILL $p
done
wait $p
)";
    const ProgramRun killed = runProgram(folder.path(), job + "a.exr --resume", "bash kill.sh");
    REQUIRE(killed.status == 128 + 9);
    CHECK_FALSE(fs::exists(folder.path() / "a.exr"));
    const ProgramRun resumed = runProgram(folder.path(), job + "a.exr --resume --json");
    REQUIRE_MESSAGE(resumed.status == 0, resumed.err);
    CHECK(nlohmann::json::parse(resumed.out)["resumed_tiles"] > 0);
    CHECK(bytesOf(folder.path() / "a.exr") == bytesOf(folder.path() / "whole.exr"));
}

TEST_SUITE_END();
