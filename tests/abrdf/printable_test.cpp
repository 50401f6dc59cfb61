// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/printable.h"

#include <doctest/doctest.h>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("a message is one line, steers no terminal, and keeps its UTF-8") {
    CHECK(printable("plain \xc3\xa4\xe2\x82\xac.zip: it's \"so\"") ==
          "plain \xc3\xa4\xe2\x82\xac.zip: it's \"so\"");
    CHECK(printable("a\nb\rc\x1b[31m\x7f\t") == "a\\nb\\x0dc\\x1b[31m\\x7f\\x09");
    CHECK(printable("\xc2\x9b"
                    "31m") ==
          "\\xc2\x9b"
          "31m");
    CHECK(printable("\xc2\xa0") == "\xc2\xa0");
    CHECK(printable("\xc2") == "\xc2");
    CHECK(printable("").empty());
}

TEST_SUITE_END();
