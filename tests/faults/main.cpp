// SPDX-License-Identifier: BSD-3-Clause
//
// Runs real jobs and breaks them: faults PROGRAM SHIM [--long]. Prints the faults injected and the
// promises broken, of which there must be none.
#include "tests/faults/fault_bench.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

int main(int argc, char** argv) {
    // Jobs heed what a parent of ours may ignore.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) std::signal(signal, SIG_DFL);
    if (argc < 3) return 2;
    try {
        abrdf::gProgram = std::filesystem::absolute(argv[1]);
        abrdf::gShim = std::filesystem::absolute(argv[2]);
        unsetenv("OCIO");
        std::setvbuf(stdout, nullptr, _IOLBF, 0);
        abrdf::FaultBench bench(argc > 3 && std::string(argv[3]) == "--long");
        unsetenv("TMPDIR");  // Scratch files beside the output, on the disk that fills up.
        const std::string only = argc > 4 ? argv[4] : "";
        const auto scenario = [&](const std::string& name, void (*run)(abrdf::FaultBench&)) {
            if (only.empty() || only == name) run(bench);
        };
        scenario("kill", abrdf::killAtRandom);
        scenario("calls", abrdf::killAtCalls);
        scenario("disk", abrdf::fillDisk);
        scenario("read", abrdf::failReads);
        scenario("memory", abrdf::exhaustMemory);
        scenario("interrupt", abrdf::interrupt);
        scenario("rivals", abrdf::runRivals);
        return bench.printTable() == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "faults: %s\n", error.what());
        return 2;
    }
}
