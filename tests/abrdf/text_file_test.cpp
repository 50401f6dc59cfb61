// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/text_file.h"

#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <fstream>
#include <stdexcept>
#include <thread>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("a text comes whole, from a file of any length and from a pipe") {
    const TemporaryFolder folder;
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{65536}, std::size_t{200001}}) {
        const std::string text(size, 'a');
        std::ofstream(folder.path() / "a.txt") << text;
        CHECK(textOfFile(folder.path() / "a.txt") == text);
    }
    const auto pipe = folder.path() / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    std::thread writer([&] { std::ofstream(pipe) << "through a pipe"; });
    CHECK(textOfFile(pipe) == "through a pipe");
    writer.join();
}

TEST_CASE("what is no text is named: nothing, a folder, what has no end") {
    const TemporaryFolder folder;
    const auto faultOf = [](const std::filesystem::path& path) -> std::string {
        try {
            textOfFile(path);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    };
    CHECK(faultOf(folder.path() / "none").find("none: cannot be opened: No such file") !=
          std::string::npos);
    CHECK(faultOf(folder.path()).find("is a folder") != std::string::npos);
    CHECK(faultOf("/dev/zero").find("/dev/zero: is larger than 64 MB") != std::string::npos);
}

TEST_SUITE_END();
