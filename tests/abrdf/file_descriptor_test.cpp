// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/file_descriptor.h"

#include <doctest/doctest.h>
#include <fcntl.h>

#include <optional>
#include <utility>

using abrdf::FileDescriptor;

namespace {

int openNothing() {
    return open("/dev/null", O_RDONLY | O_CLOEXEC);
}

bool isOpen(int number) {
    return fcntl(number, F_GETFD) >= 0;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a file is closed with its descriptor") {
    int number = -1;
    {
        const FileDescriptor file(openNothing());
        number = file.number();
        REQUIRE(file.isOpen());
        CHECK(isOpen(number));
    }
    CHECK(!isOpen(number));
}

TEST_CASE("a file that could not be opened is none") {
    CHECK(!FileDescriptor(-1).isOpen());
    CHECK(!FileDescriptor().isOpen());
}

TEST_CASE("a moved descriptor has one owner, and what it had is closed") {
    std::optional<FileDescriptor> first(openNothing());
    const int number = first->number();
    FileDescriptor second(std::move(*first));
    first.reset();
    CHECK(second.number() == number);
    CHECK(isOpen(number));
    {
        FileDescriptor third(openNothing());
        const int old = third.number();
        third = std::move(second);
        second = FileDescriptor();
        CHECK(third.number() == number);
        CHECK(!isOpen(old));
        CHECK(isOpen(number));
    }
    CHECK(!isOpen(number));
}

TEST_CASE("what was released stays open") {
    FileDescriptor file(openNothing());
    const int number = file.release();
    CHECK(!file.isOpen());
    CHECK(isOpen(number));
    const FileDescriptor again(number);
}

TEST_SUITE_END();
