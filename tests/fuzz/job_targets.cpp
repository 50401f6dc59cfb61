// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/content_hash.h"
#include "abrdf/output_file.h"
#include "cli/batch_file.h"
#include "cli/config_file.h"
#include "pipeline/convert/tile_journal.h"
#include "pipeline/plan/plan_file.h"
#include "pipeline/report/report_files.h"
#include "stages/train/model_file.h"
#include "tests/fuzz/small_task.h"
#include "tests/fuzz/targets.h"
#include "tests/support/small_files.h"

#include <nlohmann/json.hpp>

#include <array>
#include <stdexcept>
#include <string_view>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

template <typename Action>
void mayFail(const Action& action) {
    try {
        action();
    } catch (const std::runtime_error&) {
    } catch (const std::invalid_argument&) {
    }
}

void runJob(std::span<const char> bytes) {
    const fs::path file = fuzzFile("fuzz.toml", bytes);
    fs::current_path(file.parent_path());  // Patterns look around from here.
    // None may walk the whole disk.
    if (std::string_view(bytes.data(), bytes.size()).find("/*") == std::string_view::npos) {
        mayFail([&] { batchFromFile(file); });
    }
    mayFail([&] { withConfigFile({"convert", "a.zip", "--config", file.string()}); });
}

/// The first byte says which form the name promises.
void runPlan(std::span<const char> bytes) {
    if (bytes.empty()) return;
    constexpr std::array kNames = {"plan.toml", "plan.csv", "grid.csv"};
    const auto choice = static_cast<unsigned char>(bytes[0]) % kNames.size();
    const fs::path file = fuzzFile(kNames[choice], bytes.subspan(1));
    mayFail([&] {
        if (choice == 2) {
            AngularGrid(directionsFromCsv(file));
            return;
        }
        const SamplePlan plan = planFromFile(file);
        const std::string text = planText({"again", plan.samples, {}}, PlanNotes{});
        fuzzCheck(planFromFile(fuzzFile("again.toml", text)).samples.size() == plan.samples.size(),
                  "a plan that was read can be written and read again");
    });
}

void tryModel(const fs::path& file) {
    mayFail([&] {
        ReconstructionTask task = smallTask();
        task.prior = std::make_shared<const PriorModel>(readModel(file));
        task.mean.assign(task.samples.count(), {0.5F, 0.25F, 0.125F});
        const auto reconstructor = methodFromName("prior").make(task);
        reconstructAndCheck(*reconstructor, task.output, task.mean, 1);
    });
}

/// As it is, and under a head that vouches for it.
void runModel(std::span<const char> bytes) {
    tryModel(fuzzFile("fuzz.model", bytes));
    static const std::string kMagic = smallModelBytes().substr(0, 16);
    const std::string body(bytes.begin(), bytes.end());
    const ByteWriter whole = ByteWriter().text(kMagic).put(contentHash(body)).text(body);
    tryModel(fuzzFile("fuzz.model", whole.bytes()));
}

nlohmann::ordered_json smallJob() {
    return {{"input", "a.zip"}, {"rank", 16}};
}

/// A journal, and beside it an atlas of a few bytes.
void runJournal(std::span<const char> bytes) {
    const fs::path output = fuzzFile(".out.exr.abrdf-journal", bytes).parent_path() / "out.exr";
    fuzzFile(partialBeside(output).filename().string(), std::string(64, 'x'));
    mayFail([&] {
        TileJournal journal(output, smallJob(), PixelType::kHalf, true);
        fuzzCheck(journal.written().end <= 64, "a journal says no more than the atlas confirms");
        journal.add({});
    });
}

void runReports(std::span<const char> bytes) {
    mayFail([&] {
        PageContent content;
        addReports({fuzzFile("a.json", bytes), fuzzFile("b.json", bytes)}, content);
    });
}

std::vector<std::string> jobSeeds() {
    return {R"(input = "*.toml"
output = "a/{name}.exr"
texels = "4x4"
quiet = true
)",
            R"(output = '{name}{name}.exr'
alpha = 9.5e1
elevations = [30, 75]
[[material]]
input = ["fuzz.*", """fuzz.toml"""]
method = "prior"
[[material]]
input = "[a-f]uzz?toml"
rank = 0x1F
)"};
}

std::vector<std::string> planSeeds() {
    const SamplePlan plan{"small", {{{0.2, 1}, {0.5, 2}}, {{0, 0}, {1.2, 6}}}, {}};
    return {std::string(1, '\0') +
                planText(plan, {.expectedError = {3.5, 2}, .sweep = {}, .comments = {"a comment"}}),
            "\1theta_i,phi_i,theta_v,phi_v\n0,0,15,-30\n# a\n75 1e1 8 9",
            "\2theta_deg,phi_deg\n0,0\n 45.5, 300\n"};
}

std::vector<std::string> modelSeeds() {
    const std::string whole = smallModelBytes();
    return {whole.substr(24), whole};
}

std::vector<std::string> journalSeeds() {
    const std::string head =
        nlohmann::ordered_json{{"job", smallJob()}, {"pixel", "half"}}.dump() + "\n";
    const std::string hash = std::to_string(contentHash(std::string(8, 'x')));
    return {head + "0 16 0 0 0 0 whole\n1 24 " + hash + " 1 2 3 whole\n2 40", head,
            R"({"job":{"input":"b.zip","rank":16,"more":[1,{}]},"pixel":"float"})"
            "\n"};
}

std::vector<std::string> reportSeeds() {
    return {R"({"command":"evaluate","input":"a","results":[{"method":"prior","plan":"eight",
"samples":204,"delta_e":1.5,"psnr":30,"highlight":{"delta_e":1,"psnr":2},"microseconds_per_abrdf":9}]})",
            R"({"command":"chart","results":[{"method":"m","input":"i","samples":8,"delta_e":2,
"microseconds_per_abrdf":7}]})",
            R"({"command":"stress","results":[{"case":"noise","method":"rbf","breakdown":0.5},
{"case":"noise","method":"idw","breakdown":null}]})",
            R"({"command":"convert","output":{"path":"a.exr"},"method":"prior","texels":[4,4],
"plan":{"name":"eight"},"peak_memory":1e9,"time":{"total":2}})"};
}

constexpr std::array kTargets{
    FuzzTarget{"job", runJob, jobSeeds},
    FuzzTarget{"plan", runPlan, planSeeds},
    FuzzTarget{"model", runModel, modelSeeds},
    FuzzTarget{"journal", runJournal, journalSeeds},
    FuzzTarget{"reports", runReports, reportSeeds},
};

}  // namespace

std::span<const FuzzTarget> jobTargets() {
    return kTargets;
}

}  // namespace abrdf
