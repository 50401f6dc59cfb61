// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/run_program.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace abrdf {

namespace {

std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

ProgramRun runProgram(const std::filesystem::path& folder, const std::string& arguments,
                      const std::string& before) {
    // Its own two files lie outside the folder, whose contents tests look at.
    const std::filesystem::path out = folder.string() + ".out";
    const std::filesystem::path err = folder.string() + ".err";
    const std::string command = "cd '" + folder.string() + "' && exec env " + before + " '" +
                                ABRDF_PROGRAM + "' " + arguments + " >'" + out.string() + "' 2>'" +
                                err.string() + "' </dev/null";
    const int status = std::system(("env -u OCIO bash -c \"" + command + "\"").c_str());
    ProgramRun run;
    run.status = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
    run.out = contents(out);
    run.err = contents(err);
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return run;
}

}  // namespace abrdf
