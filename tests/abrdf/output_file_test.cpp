// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/output_file.h"

#include "tests/support/fault_of.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

auto filesIn(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), {});
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("without commit() there is no file, and no temporary stays") {
    const TemporaryFolder folder;
    {
        OutputFile file(folder.path() / "new.bin");
        file.write(std::string("half done"));
        CHECK_FALSE(fs::exists(folder.path() / "new.bin"));
        CHECK(filesIn(folder.path()) <= 1);  // The temporary, where it has a name.
    }
    CHECK(filesIn(folder.path()) == 0);
}

TEST_CASE(
    "what a process left that was killed as it put its file in place goes with the next one") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.bin";
    std::ofstream(folder.path() / ".a.bin.abrdf-whole") << "left by another";
    {
        OutputFile file(path);
        if (filesIn(folder.path()) > 1) {
            MESSAGE("skipped: this file system has no files without names");
            return;
        }
    }
    writeWholeFile(path, "new");
    CHECK(contentOf(path) == "new");
    CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("an exception on the way leaves the old file as it was") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.bin";
    writeWholeFile(path, "old");
    try {
        OutputFile file(path);
        file.write(std::string("new"));
        throw std::logic_error("on the way");
    } catch (const std::logic_error&) {
    }
    CHECK(contentOf(path) == "old");
    CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("commit() replaces the old file by all bytes, and those sought back to") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.bin";
    writeWholeFile(path, "an older and longer file");
    {
        OutputFile file(path);
        file.write(std::string("0123456789"));
        CHECK(file.position() == 10);
        file.seek(3);
        file.write(std::string("abc"));
        CHECK(file.position() == 6);
        CHECK(contentOf(path) == "an older and longer file");
        file.commit();
    }
    CHECK(contentOf(path) == "012abc6789");
    CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("a disk that fills up is an error that names the file, and the old one stays") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.bin";
    writeWholeFile(path, "old");
    std::string fault;
    {
        const FileSizeLimit limit(4096);
        fault = faultOf([&] { writeWholeFile(path, std::string(100000, 'x')); });
    }
    CHECK(fault.find(path.string()) != std::string::npos);
    CHECK(contentOf(path) == "old");
    CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("an output that cannot be is refused, by its path, before any work") {
    const TemporaryFolder folder;
    writeWholeFile(folder.path() / "file", "x");
    for (const fs::path& path :
         {folder.path(), folder.path() / "absent" / "a.exr", folder.path() / "file" / "a.exr",
          fs::path("/dev/null"), fs::path(), folder.path() / ""}) {
        CAPTURE(path.string());
        const std::string fault = faultOf([&] { checkOutputPath(path); });
        CHECK_FALSE(fault.empty());
        CHECK(fault.find(path.string()) != std::string::npos);
    }
    checkOutputPath(folder.path() / "file");
    checkOutputPath(folder.path() / "new.exr");
    checkOutputPath("relative.exr");
    CHECK(faultOf([&] {
              OutputFile file(folder.path() / "absent" / "a.exr");
          }).find("absent/a.exr") != std::string::npos);
    CHECK(filesIn(folder.path()) == 1);
}

TEST_CASE("the temporary is hidden, beside its file") {
    const fs::path temporary = temporaryBeside("folder/a.exr");
    CHECK(temporary.parent_path() == "folder");
    CHECK(temporary.filename().string().starts_with(".a.exr"));
}

TEST_SUITE_END();
