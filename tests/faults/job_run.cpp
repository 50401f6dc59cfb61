// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/job_run.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace abrdf {

std::filesystem::path gProgram;
std::filesystem::path gShim;

namespace {

constexpr unsigned kNobody = 65534;
constexpr double kHangs = 600;  ///< Seconds that no job here takes, not even on a busy machine.

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

void limit(__rlimit_resource resource, long bytes) {
    if (bytes < 0) return;
    const rlimit value{static_cast<rlim_t>(bytes), static_cast<rlim_t>(bytes)};
    setrlimit(resource, &value);
}

[[noreturn]] void become(const std::vector<std::string>& words, const std::filesystem::path& folder,
                         const Attack& attack, int err) {
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    for (const std::string& setting : attack.environment) {
        const auto at = setting.find('=');
        setenv(setting.substr(0, at).c_str(), setting.substr(at + 1).c_str(), 1);
    }
    std::vector<char*> arguments{const_cast<char*>(gProgram.c_str())};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const bool isBounded = attack.moreBytes >= 0;
    const bool isEnded = attack.news >= 0;
    if (isBounded || isEnded || !attack.fault.empty()) setenv("LD_PRELOAD", gShim.c_str(), 1);
    if (!attack.fault.empty()) setenv("ABRDF_FAULT", attack.fault.c_str(), 1);
    if (isBounded) setenv("ABRDF_MORE_MEMORY", std::to_string(attack.moreBytes).c_str(), 1);
    if (isEnded) setenv("ABRDF_NEWS", std::to_string(attack.news).c_str(), 1);
    if (chdir(folder.c_str()) != 0) _exit(126);
    if (attack.asNobody && (setgid(kNobody) != 0 || setuid(kNobody) != 0)) _exit(126);
    limit(RLIMIT_FSIZE, attack.fileBytes);
    execv(gProgram.c_str(), arguments.data());
    _exit(126);
}

/// Whether there is something to read, or the end, within so many seconds.
bool waitForText(int file, double seconds) {
    pollfd waited{file, POLLIN, 0};
    const auto whole = static_cast<time_t>(seconds);
    const timespec time{whole, static_cast<long>(1e9 * (seconds - static_cast<double>(whole)))};
    return ppoll(&waited, 1, &time, nullptr) > 0;
}

}  // namespace

JobRun::JobRun(const std::vector<std::string>& words, const std::filesystem::path& folder,
               const Attack& attack)
    : attack_(attack), start_(now()) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("no process");
    if (process_ == 0) become(words, folder, attack, ends[1]);
    close(ends[1]);
    err_ = ends[0];
}

Outcome JobRun::end() {
    Outcome outcome;
    bool sent = attack_.signal == 0;
    while (true) {
        const double left = start_ + attack_.after - now();
        if (!sent && left <= 0) {
            kill(process_, attack_.signal);
            sent = true;
        }
        if (now() - start_ > kHangs) kill(process_, SIGKILL);
        if (!waitForText(err_, sent ? 1.0 : std::max(0.0, left))) continue;
        char bytes[4096];
        const ssize_t count = ::read(err_, bytes, sizeof bytes);
        if (count <= 0) break;
        outcome.err.append(bytes, static_cast<std::size_t>(count));
    }
    close(err_);
    int status = 0;
    waitpid(process_, &status, 0);
    outcome.status = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
    outcome.seconds = now() - start_;
    return outcome;
}

}  // namespace abrdf
