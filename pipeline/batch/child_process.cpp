// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/batch/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace abrdf {

namespace {

/// Memory that the child writes as its standard output or errors: it never blocks as a pipe does.
FileDescriptor memoryFile(const char* name) {
    FileDescriptor file(memfd_create(name, MFD_CLOEXEC));
    if (!file.isOpen())
        throw std::runtime_error(fmt::format("no memory for a child's output: {}", name));
    return file;
}

std::string contentsOf(const FileDescriptor& file) {
    const off_t size = lseek(file.number(), 0, SEEK_END);
    std::string text(static_cast<std::size_t>(std::max<off_t>(0, size)), '\0');
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t count =
            pread(file.number(), text.data() + done, text.size() - done, static_cast<off_t>(done));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        done += static_cast<std::size_t>(count);
    }
    text.resize(done);
    return text;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words)
    : out_(memoryFile("out")), err_(memoryFile("err")) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out_.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err_.number(), STDERR_FILENO);
    const int error =
        posix_spawn(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error == 0) return;
    throw std::runtime_error(fmt::format("{}: cannot be run: {}", words[0], std::strerror(error)));
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      out_(std::move(other.out_)),
      err_(std::move(other.err_)) {}

ChildProcess::~ChildProcess() {
    if (process_ <= 0) return;
    askToEnd();
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

void ChildProcess::askToEnd() const {
    if (process_ > 0) kill(process_, SIGTERM);
}

std::optional<ChildProcess::Ended> ChildProcess::poll() {
    int status = 0;
    const pid_t ended = waitpid(process_, &status, WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR)) return {};
    process_ = -1;
    if (ended < 0) {
        throw std::runtime_error(
            fmt::format("a child's end cannot be waited for: {}", std::strerror(errno)));
    }
    return Ended{WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
                 contentsOf(out_), contentsOf(err_)};
}

}  // namespace abrdf
