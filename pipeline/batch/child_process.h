// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/file_descriptor.h"

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// A program that runs beside this one, its output and errors caught. Destroyed while it runs, it
/// is asked to end (SIGTERM) and waited for.
class ChildProcess {
  public:
    /// words: the program's path and its arguments. Throws std::runtime_error.
    explicit ChildProcess(const std::vector<std::string>& words);
    ~ChildProcess();
    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ChildProcess& operator=(ChildProcess&&) = delete;

    /// What it left; a signal that ended it counts as status 128 + signal, as in a shell.
    struct Ended {
        int status = 0;
        std::string out;
        std::string err;
    };

    /// Nothing while it runs. Throws std::runtime_error where the system lost it.
    std::optional<Ended> poll();

    /// SIGTERM, without waiting for it.
    void askToEnd() const;

  private:
    pid_t process_ = -1;
    FileDescriptor out_;
    FileDescriptor err_;
};

}  // namespace abrdf
