// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/faults/job_run.h"
#include "tests/support/temporary_folder.h"

#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace abrdf {

/// A command and the file that it makes.
struct Job {
    std::string name;
    std::vector<std::string> words;
    std::string output;
    bool resumable = false;

    std::string reference{};  ///< The bytes of a run that nothing befell.
    double seconds = 0;       ///< How long that took.
};

/// Jobs on a small demo database, and the promise that each fault is held against: a status and a
/// message as promised, no half file, an old file intact, nothing left over, and a next run that
/// ends with the bytes of one that nothing befell.
class FaultBench {
  public:
    /// Makes the database and the references.
    explicit FaultBench(bool isLong);

    bool isLong() const { return isLong_; }
    const std::vector<Job>& jobs() const { return jobs_; }
    const Job& job(const std::string& name) const;
    /// All of them in a long run, three in a short one.
    std::vector<Job> fewJobs() const;
    std::filesystem::path data() const { return folder_.path() / "data"; }
    /// Where jobs write; empty at the start of each trial.
    std::filesystem::path work() const { return folder_.path() / "work"; }

    /// A number from 0 to 1, the next of a fixed row.
    double random() { return std::uniform_real_distribution<double>(0, 1)(random_); }

    /// A trial begins: `work` is emptied, an old output put there where `old`.
    void begin(const Job& job, bool old);
    /// The fault that this trial injects, for the table and for messages.
    void inject(const std::string& kind, const std::string& what);
    void expect(bool holds, const std::string& promise);

    /// As shim.cpp takes it, for a call on what a job writes. Names are given relative to `work`.
    std::string faultAt(const std::string& call, long number, const std::string& action) const {
        const bool byName = call == "rename" || call == "unlink";
        return call + ":" + std::to_string(number) + ":" + action + ":" +
               (byName ? "" : work().string());
    }

    Outcome run(const Job& job, const Attack& attack, bool resume = false) const;

    /// What must hold after a fault: the output absent, or old, or whole; beside it nothing but
    /// what a next run takes up where `mayContinue`.
    void expectNothingHalf(const Job& job, bool mayContinue);
    /// A run that failed: status 1 and one sentence that holds one of `names`.
    void expectSentence(const Outcome& outcome, const std::vector<std::string>& names);
    /// Runs the job again; it must end well, with the reference's bytes, and leave nothing else.
    void expectRerun(const Job& job, bool resume);

    /// A line a kind: faults injected, violations. Returns all violations.
    std::size_t printTable() const;

  private:
    struct Count {
        std::size_t injected = 0;
        std::size_t violations = 0;
    };

    TemporaryFolder folder_;
    bool isLong_;
    std::vector<Job> jobs_;
    std::mt19937 random_{11};
    bool old_ = false;
    std::string kind_;
    std::string what_;
    std::vector<std::string> kinds_;
    std::map<std::string, Count> counts_;
};

std::string contentOf(const std::filesystem::path& file);

// The scenarios, a file each.
void killAtRandom(FaultBench& bench);
void killAtCalls(FaultBench& bench);
void fillDisk(FaultBench& bench);
void failReads(FaultBench& bench);
void exhaustMemory(FaultBench& bench);
void interrupt(FaultBench& bench);
void runRivals(FaultBench& bench);

}  // namespace abrdf
