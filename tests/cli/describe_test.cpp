// SPDX-License-Identifier: BSD-3-Clause
//
// The manual and the shells' completions know what --help knows.
#include "tests/support/fault_of.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using namespace abrdf;

namespace {

const TemporaryFolder& folder() {
    static const TemporaryFolder folder;
    return folder;
}

std::string outputOf(const std::string& arguments) {
    const ProgramRun run = runProgram(folder().path(), arguments);
    REQUIRE_MESSAGE(run.status == 0, run.err);
    return run.out;
}

/// "--output" and the like, as --help prints them; of the program itself for "".
std::set<std::string> optionsOf(const std::string& command) {
    std::set<std::string> options;
    const std::string help = outputOf(command + " --help");
    const std::regex line(R"(\n  (?:-\w,)?(--[a-z-]+))");
    for (std::sregex_iterator it(help.begin(), help.end(), line), end; it != end; ++it) {
        options.insert((*it)[1]);
    }
    REQUIRE(options.contains("--help"));
    return options;
}

/// All commands that --help lists, with their options.
std::map<std::string, std::set<std::string>> optionsByCommand() {
    std::map<std::string, std::set<std::string>> result;
    std::istringstream help(outputOf("--help"));
    std::string line;
    while (std::getline(help, line) && line != "Subcommands:") {
    }
    while (std::getline(help, line) && line.starts_with("  ")) {
        const std::string command = line.substr(2, line.find(' ', 2) - 2);
        result[command] = optionsOf(command);
    }
    REQUIRE(result.contains("convert"));
    return result;
}

/// From `begin` up to `end`.
std::string part(const std::string& text, const std::string& begin, const std::string& end) {
    const auto from = text.find(begin);
    REQUIRE_MESSAGE(from != std::string::npos, begin);
    return text.substr(from, text.find(end, from + begin.size()) - from);
}

/// What bash offers for the last word, a line a choice.
std::string completedByBash(const std::string& words) {
    const auto file = folder().path() / "abrdf.bash";
    std::ofstream(file) << outputOf("describe bash");
    const auto script = folder().path() / "complete.sh";
    const auto result = folder().path() / "result";
    std::ofstream(script) << "source '" << file.string() << "'\nCOMP_WORDS=(" << words
                          << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_abrdf\n"
                             "printf '%s\\n' \"${COMPREPLY[@]}\" > '"
                          << result.string() << "'\n";
    REQUIRE(std::system(("cd '" + folder().path().string() + "' && bash '" + script.string() + "'")
                            .c_str()) == 0);
    std::ifstream stream(result);
    return "\n" + std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("every option of --help is in the manual and in each shell's completions") {
    const std::string man = outputOf("describe man");
    const std::string zsh = outputOf("describe zsh");
    const std::string fish = outputOf("describe fish");
    const std::set<std::string> shared = optionsOf("");
    const std::regex dash("-");
    for (const auto& entry : optionsByCommand()) {
        const std::string& command = entry.first;
        const std::string manPart = part(man, ".SH ABRDF " + command + "\n", ".SH ");
        const std::string zshPart = part(zsh, "\n    " + command + ")\n", ";;");
        const std::string bash = completedByBash("abrdf " + command + " -");
        for (const std::string& option : entry.second) {
            CAPTURE(command);
            CAPTURE(option);
            CHECK(contains(manPart, "\\fB" + std::regex_replace(option, dash, "\\-") + "\\fR"));
            CHECK(contains(zshPart, option + "["));
            CHECK(contains(bash, "\n" + option + "\n"));
            CHECK(std::regex_search(
                fish, std::regex("from " + command + "'[^\n]* -l " + option.substr(2) + " ")));
        }
        CHECK(contains(bash, "\n--threads\n"));
    }
    for (const std::string& option : shared) {
        CHECK(contains(man, "\\fB" + std::regex_replace(option, dash, "\\-") + "\\fR"));
    }
    CHECK_FALSE(contains(man, "describe"));
    CHECK_FALSE(contains(outputOf("--help"), "describe"));
}

TEST_CASE("bash completes commands, values that have names, and files") {
    std::ofstream(folder().path() / "z cloth.zip") << "";
    CHECK(completedByBash("abrdf conv") == "\nconvert\n");
    CHECK(completedByBash("abrdf convert --pixel f") == "\nfloat\n");
    CHECK(completedByBash("abrdf convert --pixel = f") == "\nfloat\n");
    CHECK(completedByBash("abrdf -q convert --grazing ''") == "\nhold\nfade\nextrapolate\n");
    CHECK(completedByBash("abrdf convert --method pub") == "\npublished\n");
    CHECK(completedByBash("abrdf convert --rank ''") == "\n\n");
    CHECK(completedByBash("abrdf convert z") == "\nz cloth.zip\n");
    CHECK(completedByBash("abrdf convert --model z") == "\nz cloth.zip\n");
    CHECK(completedByBash("abrdf convert --grid z") == "\nz cloth.zip\n");
}

TEST_CASE("each shell that is here parses its completions") {
    for (const std::string shell : {"bash", "zsh", "fish"}) {
        if (std::system(("command -v " + shell + " > /dev/null").c_str()) != 0) {
            MESSAGE("skipped: " << shell << " is absent");
            continue;
        }
        const auto file = folder().path() / ("check." + shell);
        std::ofstream(file) << outputOf("describe " + shell);
        CHECK(std::system((shell + " -n '" + file.string() + "'").c_str()) == 0);
    }
}

TEST_SUITE_END();
