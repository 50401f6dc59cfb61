// SPDX-License-Identifier: BSD-3-Clause
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdlib>

int main(int argc, char** argv) {
    // What tests train belongs to this build, not to the user.
    setenv("XDG_CACHE_HOME", ABRDF_TEST_CACHE, 1);
    return doctest::Context(argc, argv).run();
}
