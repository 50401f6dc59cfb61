// SPDX-License-Identifier: BSD-3-Clause
#include "tests/faults/fault_bench.h"

#include "tests/support/files_in.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

constexpr const char* kOld = "an old file";
/// What a killed process leaves beside its output and the next one takes up or away.
constexpr std::array kLeft = {".abrdf-partial", ".abrdf-journal", ".abrdf-unfinished",
                              ".abrdf-whole"};

/// The smallest --memory that the program names for a job.
std::string smallestMemory(std::vector<std::string> words, const fs::path& folder) {
    words.insert(words.end(), {"-o", "none", "--memory", "8M"});
    const std::string text = JobRun(words, folder, {}).end().err;
    const auto at = text.find("works is ");
    if (at == std::string::npos) throw std::runtime_error("no smallest memory is named: " + text);
    return std::to_string(std::stoul(text.substr(at + 9)) + 8) + "M";
}

std::vector<Job> makeJobs(const fs::path& data) {
    const std::string zip = data / "cloth.zip";
    std::vector<std::string> spatial = {"convert",  zip,        "--texels", "full",      "--method",
                                        "measured", "--layout", "spatial",  "--threads", "2"};
    spatial.insert(spatial.end(), {"--memory", smallestMemory(spatial, data)});
    const std::string model = data / "m.model";
    return {
        {"angular",
         {"convert", zip, "--texels", "full", "--method", "measured", "--compression", "piz"},
         "a.exr",
         true},
        {"spatial", spatial, "s.exr", true},
        {"prior",
         {"convert", data / "cloth", "--texels", "full", "--plan", "greedy:40", "--model", model},
         "p.exr",
         true},
        {"merge", {"merge", data / "part1.exr", data / "part2.exr"}, "m.exr"},
        {"export", {"export", data / "whole.exr", "--to", "utia-bin"}, "e.bin"},
        {"preview",
         {"preview", data / "whole.exr", "--size", "64x64", "--light", "30,40"},
         "p.png"},
        {"train", {"train", "--plan", "greedy:20", "--materials", "20"}, "t.model"},
        {"demo", {"demo", "--size", "2"}, "d.zip"},
    };
}

std::vector<std::string> wordsOf(const Job& job, bool resume) {
    std::vector<std::string> words = job.words;
    words.emplace_back("-q");
    if (job.name == "demo") {
        words.push_back(job.output);
    } else {
        words.insert(words.end(), {"-o", job.output});
    }
    if (resume) words.emplace_back("--resume");
    return words;
}

void must(const std::vector<std::string>& words, const fs::path& folder) {
    const Outcome outcome = JobRun(words, folder, {}).end();
    if (outcome.status != 0) throw std::runtime_error(words[0] + ": " + outcome.err);
}

}  // namespace

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

FaultBench::FaultBench(bool isLong) : isLong_(isLong) {
    fs::create_directory(data());
    fs::create_directory(work());
    // For runs as another user.
    for (const fs::path& path : {folder_.path(), data(), work()}) {
        fs::permissions(path, fs::perms::all);
    }
    for (const char* target : {"cloth.zip", "cloth"}) {
        must({"demo", target, "--size", "8", "-q"}, data());
    }
    must({"train", "--plan", "greedy:40", "--materials", "30", "-q", "-o", "m.model"}, data());
    const std::vector<std::string> convert = {"convert",  "cloth.zip", "--texels", "full",
                                              "--method", "measured",  "-q",       "-o"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), convert.begin(), convert.end());
        must(more, data());
    };
    with({"whole.exr"});
    with({"part1.exr", "--shard", "1/2"});
    with({"part2.exr", "--shard", "2/2"});
    jobs_ = makeJobs(data());
    for (Job& job : jobs_) {
        begin(job, false);
        const Outcome outcome = run(job, {});
        if (outcome.status != 0) throw std::runtime_error(job.name + ": " + outcome.err);
        job.reference = contentOf(work() / job.output);
        job.seconds = outcome.seconds;
    }
}

const Job& FaultBench::job(const std::string& name) const {
    return *std::ranges::find(jobs_, name, &Job::name);
}

std::vector<Job> FaultBench::fewJobs() const {
    if (isLong_) return jobs_;
    return {job("angular"), job("spatial"), job("merge")};
}

void FaultBench::begin(const Job& job, bool old) {
    for (const auto& entry : fs::directory_iterator(work())) fs::remove_all(entry.path());
    old_ = old;
    if (old) std::ofstream(work() / job.output) << kOld;
}

void FaultBench::inject(const std::string& kind, const std::string& what) {
    kind_ = kind;
    what_ = what;
    if (!counts_.contains(kind)) kinds_.push_back(kind);
    ++counts_[kind].injected;
}

void FaultBench::expect(bool holds, const std::string& promise) {
    if (holds) return;
    ++counts_[kind_].violations;
    std::printf("VIOLATION %s, %s: %s\n", kind_.c_str(), what_.c_str(), promise.c_str());
}

Outcome FaultBench::run(const Job& job, const Attack& attack, bool resume) const {
    return JobRun(wordsOf(job, resume), work(), attack).end();
}

void FaultBench::expectNothingHalf(const Job& job, bool mayContinue) {
    const std::string found = contentOf(work() / job.output);
    const bool exists = fs::exists(work() / job.output);
    expect(found == job.reference || (old_ ? found == kOld : !exists),
           job.output + " is neither absent, old nor whole");
    for (const std::string& name : filesIn(work())) {
        const bool isSideFile = job.name == "export" && name == job.output + ".json";
        const bool isContinued = mayContinue && std::ranges::any_of(kLeft, [&](const char* ending) {
                                     return name == "." + job.output + ending ||
                                            name == "." + job.output + ".json" + ending;
                                 });
        expect(name == job.output || isSideFile || isContinued, name + " was left over");
    }
}

void FaultBench::expectSentence(const Outcome& outcome, const std::vector<std::string>& names) {
    expect(outcome.status == 1, "status " + std::to_string(outcome.status) + ": " + outcome.err);
    const auto line = outcome.err.rfind("abrdf: ");
    expect(line != std::string::npos && outcome.err.ends_with("\n"), "no sentence: " + outcome.err);
    const bool named = std::ranges::any_of(names, [&](const std::string& name) {
        return outcome.err.find(name, line) != std::string::npos;
    });
    expect(named, "the sentence names none of its files: " + outcome.err);
}

void FaultBench::expectRerun(const Job& job, bool resume) {
    const Outcome outcome = run(job, {}, resume && job.resumable);
    expect(outcome.status == 0, "the next run fails: " + outcome.err);
    expect(contentOf(work() / job.output) == job.reference, "the next run gives other bytes");
    expectNothingHalf(job, false);
}

std::size_t FaultBench::printTable() const {
    std::size_t violations = 0;
    std::size_t injected = 0;
    std::printf("%-44s %8s %10s\n", "fault", "injected", "violations");
    for (const std::string& kind : kinds_) {
        const Count& count = counts_.at(kind);
        std::printf("%-44s %8zu %10zu\n", kind.c_str(), count.injected, count.violations);
        injected += count.injected;
        violations += count.violations;
    }
    std::printf("%-44s %8zu %10zu\n", "all", injected, violations);
    return violations;
}

}  // namespace abrdf
