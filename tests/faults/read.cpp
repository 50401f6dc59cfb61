// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/fault_bench.h"
#include "tests/support/small_files.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

/// One trial: the job's `number`-th call on a file whose path holds `pattern` fails.
void trial(FaultBench& bench, const Job& job, const std::string& kind, const std::string& fault,
           const std::vector<std::string>& names) {
    bench.begin(job, true);
    Attack attack;
    attack.fault = fault;
    const Outcome outcome = bench.run(job, attack);
    if (outcome.status == 0) {
        // It never came so far, or did without what failed: then the bytes must be right.
        bench.expect(contentOf(bench.work() / job.output) == job.reference, "other bytes");
        return;
    }
    bench.inject(kind, job.name + " " + fault);
    bench.expectSentence(outcome, names);
    bench.expectNothingHalf(job, false);
}

/// What a trial cut or removed is put back.
class Restored {
  public:
    explicit Restored(fs::path path) : path_(std::move(path)) {
        fs::copy(path_, saved(), fs::copy_options::recursive);
    }
    ~Restored() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
        fs::rename(saved(), path_, ignored);
    }
    Restored(const Restored&) = delete;
    Restored& operator=(const Restored&) = delete;

  private:
    fs::path saved() const { return path_.string() + ".saved"; }
    fs::path path_;
};

void failDisk(FaultBench& bench) {
    std::vector<long> numbers = {1, 2, 7, 50, 500, 5000};
    if (!bench.isLong()) numbers = {2, 50};
    for (const long number : numbers) {
        const std::string n = std::to_string(number);
        const std::string kind = "EIO on read";
        trial(bench, bench.job("angular"), kind, "read:" + n + ":eio:cloth.zip", {"cloth.zip"});
        trial(bench, bench.job("prior"), kind, "read:" + n + ":eio:.jpg", {".jpg"});
        trial(bench, bench.job("prior"), kind, "read:" + n + ":eio:m.model", {"m.model"});
        trial(bench, bench.job("merge"), kind, "read:" + n + ":eio:part2.exr", {"part2.exr"});
        trial(bench, bench.job("export"), kind, "read:" + n + ":eio:whole.exr", {"whole.exr"});
        trial(bench, bench.job("spatial"), kind, "read:" + n + ":eio:.abrdf-scratch",
              {"scratch file"});
    }
}

void changeInputs(FaultBench& bench) {
    const Job& job = bench.job("prior");
    for (const char* action : {"remove", "cut", "eacces"}) {
        for (const long number : {1L, 17L, 40L}) {
            if (!bench.isLong() && number != 17) continue;
            const Restored images(bench.data() / "cloth");
            trial(bench, job, std::string("an image while running: ") + action,
                  "open:" + std::to_string(number) + ":" + action + ":.jpg", {".jpg"});
        }
    }
    for (const char* part : {"cloth.zip", "part2.exr", "whole.exr", "m.model"}) {
        const Restored file(bench.data() / part);
        const char* name = part[0] == 'c'   ? "angular"
                           : part[0] == 'p' ? "merge"
                           : part[0] == 'w' ? "export"
                                            : "prior";
        for (const long number : {2L, 30L}) {
            trial(bench, bench.job(name), "an input cut while running",
                  "read:" + std::to_string(number) + ":cut:" + part, {part});
            fs::copy_file(bench.data() / (std::string(part) + ".saved"), bench.data() / part,
                          fs::copy_options::overwrite_existing);
        }
    }
}

/// Files that are read as memory raise SIGBUS where they end early.
void cutMapped(FaultBench& bench) {
    for (const char* signature : {"!DFMF08FCR", "!BDIF06R2!"}) {
        SmallBtf btf;
        btf.signature = signature;
        std::ofstream(bench.data() / "small.btf", std::ios::binary) << btfBytes(btf);
        Job job{"btf",
                {"convert", bench.data() / "small.btf", "--method", "measured", "--texels", "full"},
                "b.exr",
                true};
        bench.begin(job, false);
        bench.inject("a mapped file cut while running", signature);
        bench.expect(bench.run(job, {}).status == 0, "the whole file is not converted");
        job.reference = contentOf(bench.work() / job.output);
        trial(bench, job, "a mapped file cut while running", "mmap:1:cut:small.btf", {"small.btf"});
    }
    const Job& table = bench.job("export");
    bench.begin(table, false);
    bench.run(table, {});
    fs::rename(bench.work() / table.output, bench.data() / "table.bin");
    const Job job{
        "merl",
        {"convert", bench.data() / "table.bin", "--method", "measured", "--grid", "regular:3x4"},
        "b.exr",
        true};
    trial(bench, job, "a mapped file cut while running", "mmap:1:cut:table.bin", {"table.bin"});
}

void denyImages(FaultBench& bench) {
    const Job& job = bench.job("prior");
    const Restored images(bench.data() / "cloth");
    for (const auto& entry : fs::recursive_directory_iterator(bench.data() / "cloth")) {
        if (entry.is_regular_file()) fs::permissions(entry.path(), fs::perms::none);
    }
    bench.begin(job, false);
    bench.inject("images without permission", job.name);
    Attack attack;
    attack.asNobody = geteuid() == 0;
    const Outcome outcome = bench.run(job, attack);
    bench.expectSentence(outcome, {".jpg"});
    bench.expectNothingHalf(job, false);
}

}  // namespace

void failReads(FaultBench& bench) {
    failDisk(bench);
    changeInputs(bench);
    cutMapped(bench);
    denyImages(bench);
}

}  // namespace abrdf
