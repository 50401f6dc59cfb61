// SPDX-License-Identifier: BSD-3-Clause
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>

int main(int argc, char** argv) {
    // Programs under test heed signals that their parents ignore as little as we do: nohup, and &.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) std::signal(signal, SIG_DFL);
    // What tests train belongs to this build, not to the user.
    setenv("XDG_CACHE_HOME", ABRDF_TEST_CACHE, 1);
    return doctest::Context(argc, argv).run();
}
