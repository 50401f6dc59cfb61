// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// What is done to a run of the program.
struct Attack {
    int signal = 0;                        ///< Sent `after` seconds.
    double after = 0;                      ///< Seconds from its start.
    long fileBytes = -1;                   ///< RLIMIT_FSIZE.
    long moreBytes = -1;                   ///< Address space beyond what the libraries take.
    bool asNobody = false;                 ///< Without root's right to open everything.
    std::string fault;                     ///< As shim.cpp takes it.
    long news = -1;                        ///< Calls of operator new that get memory.
    std::vector<std::string> environment;  ///< "TMPDIR=/x".
};

struct Outcome {
    int status = 0;  ///< Exit status, or minus the signal that ended it.
    std::string err;
    double seconds = 0;
};

/// A run under way.
class JobRun {
  public:
    JobRun(const std::vector<std::string>& words, const std::filesystem::path& folder,
           const Attack& attack);
    /// Waits for its end, sending the attack's signal on the way.
    Outcome end();

  private:
    Attack attack_;
    int process_ = -1;
    int err_ = -1;
    double start_ = 0;
};

/// Program and shim of all runs; set by main().
extern std::filesystem::path gProgram;
extern std::filesystem::path gShim;

}  // namespace abrdf
