// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/gnuplot.h"

#include "abrdf/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>

extern char** environ;

namespace abrdf {

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File anonymousFile() {
    File file(std::tmpfile(), std::fclose);
    if (!file) throw std::runtime_error("no temporary file can be made for gnuplot's script");
    return file;
}

std::string contentOf(std::FILE* file) {
    std::rewind(file);
    std::string content;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file)) {
        content.append(buffer, count);
    }
    return content;
}

}  // namespace

// A child without a shell: the script is its standard input, the picture its output.
void runGnuplot(const std::string& script, const std::filesystem::path& output) {
    const File in = anonymousFile();
    const File out = anonymousFile();
    const File error = anonymousFile();
    std::fwrite(script.data(), 1, script.size(), in.get());
    std::rewind(in.get());
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(error.get()), STDERR_FILENO);
    std::string program = "gnuplot";
    char* arguments[] = {program.data(), nullptr};
    pid_t child = 0;
    const int failure =
        posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    while (failure == 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const std::string picture = contentOf(out.get());
    if (failure != 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 127)) {
        throw std::runtime_error(
            "the chart needs gnuplot, which is not installed; install gnuplot-nox, or ask for the "
            "figures alone with --csv or --report");
    }
    if (status != 0 || picture.empty()) {
        throw std::runtime_error(
            fmt::format("{}: gnuplot draws nothing: {}", output.string(), contentOf(error.get())));
    }
    writeWholeFile(output, picture);
}

}  // namespace abrdf
