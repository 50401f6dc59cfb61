// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/fault_bench.h"

#include <sys/mount.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace abrdf {

namespace {

void expectRefusal(FaultBench& bench, const Job& job, const Attack& attack, bool resume) {
    const Outcome outcome = bench.run(job, attack, resume && job.resumable);
    bench.expectSentence(outcome, {job.output, "TMPDIR"});
    bench.expectNothingHalf(job, resume);
}

/// A small disk of its own as the folder of work.
class SmallDisk {
  public:
    SmallDisk(const std::filesystem::path& folder, std::size_t bytes) : folder_(folder) {
        const std::string size = "mode=777,size=" + std::to_string(bytes);
        mounted_ = mount("none", folder.c_str(), "tmpfs", 0, size.c_str()) == 0;
    }
    ~SmallDisk() {
        if (mounted_) umount(folder_.c_str());
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    bool isMounted() const { return mounted_; }
    bool grow() const {
        return mount("none", folder_.c_str(), "tmpfs", MS_REMOUNT, "size=256m") == 0;
    }

  private:
    std::filesystem::path folder_;
    bool mounted_;
};

void limitFiles(FaultBench& bench) {
    for (const Job& job : bench.fewJobs()) {
        for (const double part : {0.0, 0.01, 0.5, 0.99}) {
            for (const bool resume : {false, true}) {
                if (resume && !job.resumable) continue;
                if (!bench.isLong() && (resume || part == 0.01 || part == 0.5)) continue;
                const auto bytes =
                    static_cast<long>(part * static_cast<double>(job.reference.size()));
                bench.begin(job, !resume);
                bench.inject("file-size limit (RLIMIT_FSIZE)",
                             job.name + " at " + std::to_string(bytes) + " bytes");
                Attack attack;
                attack.fileBytes = bytes;
                expectRefusal(bench, job, attack, resume);
                bench.expectRerun(job, resume);
            }
        }
    }
}

void fillSmallDisk(FaultBench& bench) {
    for (const Job& job : bench.fewJobs()) {
        for (const double part : {0.0, 0.3, 0.7, 0.95}) {
            for (const bool resume : {false, true}) {
                if (resume && !job.resumable) continue;
                if (!bench.isLong() && (part != 0.7 || resume != job.resumable)) continue;
                bench.begin(job, false);
                const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
                const auto bytes =
                    static_cast<std::size_t>(part * static_cast<double>(job.reference.size()));
                const SmallDisk disk(bench.work(), std::max(page, bytes));
                if (!disk.isMounted()) {
                    std::puts("skipped: a full tmpfs, which takes root");
                    return;
                }
                if (!resume) bench.begin(job, true);
                bench.inject("full disk (a small tmpfs)",
                             job.name + " at " + std::to_string(bytes) + " bytes");
                expectRefusal(bench, job, {}, resume);
                bench.expect(disk.grow(), "the disk does not grow");
                bench.expectRerun(job, resume);
            }
        }
    }
}

void failCalls(FaultBench& bench) {
    for (const Job& job : bench.fewJobs()) {
        for (const char* call : {"write", "fsync", "rename"}) {
            for (const long number : {1L, 2L, 5L, 20L}) {
                if (!bench.isLong() && number > 1) continue;
                bench.begin(job, true);
                Attack attack;
                attack.fault = bench.faultAt(call, number, "enospc");
                const Outcome outcome = bench.run(job, attack);
                if (outcome.status == 0) break;  // It makes fewer of these calls.
                bench.inject("ENOSPC on write, fsync, rename", job.name + " " + attack.fault);
                bench.expectSentence(outcome, {job.output, "TMPDIR"});
                bench.expectNothingHalf(job, false);
                bench.expectRerun(job, false);
            }
        }
    }
}

}  // namespace

void fillDisk(FaultBench& bench) {
    limitFiles(bench);
    fillSmallDisk(bench);
    failCalls(bench);
}

}  // namespace abrdf
