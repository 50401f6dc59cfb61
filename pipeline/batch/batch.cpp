// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/batch/batch.h"

#include "abrdf/cancel.h"
#include "abrdf/stopwatch.h"
#include "pipeline/batch/child_process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <list>
#include <map>
#include <sstream>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr std::uint64_t kMega = std::uint64_t{1} << 20;
constexpr std::uint64_t kLeastMemory = 512 * kMega;  ///< Of one of several at once.
constexpr useconds_t kPollMicroseconds = 3000;

/// What the program said, without its name before each sentence.
std::vector<std::string> sentencesOf(const std::string& err) {
    std::vector<std::string> sentences;
    std::istringstream stream(err);
    for (std::string line; std::getline(stream, line);) {
        constexpr std::string_view kName = "abrdf: ";
        if (line.starts_with(kName)) line.erase(0, kName.size());
        if (!line.empty()) sentences.push_back(line);
    }
    return sentences;
}

void checkOutputs(const std::vector<BatchItem>& items) {
    std::map<fs::path, std::string> inputOf;
    for (const BatchItem& item : items) {
        const auto path = fs::absolute(item.output).lexically_normal();
        const auto [place, isNew] = inputOf.try_emplace(path, item.input);
        if (isNew) continue;
        throw std::invalid_argument(
            fmt::format("{} and {} would both become {}; put {{name}} into the output, or give "
                        "each its own",
                        place->second, item.input, item.output));
    }
}

class Batch {
  public:
    Batch(const std::vector<BatchItem>& items, const BatchOptions& options,
          const ProgressSink& progress)
        : items_(items), options_(options), progress_(progress), results_(items.size()) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            const auto part = static_cast<int>(i % static_cast<std::size_t>(options.shard.count));
            if (part + 1 == options.shard.index) own_.push_back(i);
        }
        const std::uint64_t byMemory = std::max<std::uint64_t>(1, options.memory / kLeastMemory);
        atOnce_ =
            std::min({static_cast<std::size_t>(options.threads), static_cast<std::size_t>(byMemory),
                      std::max<std::size_t>(1, own_.size())});
    }

    /// All are asked to end before any is waited for.
    ~Batch() {
        for (const Running& running : running_) running.process.askToEnd();
    }
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;

    ordered_json run() {
        const Stopwatch time;
        while (next_ < own_.size() || !running_.empty()) {
            throwIfCancelled();
            while (running_.size() < atOnce_ && next_ < own_.size() && !stopped_) begin();
            if (stopped_ && running_.empty()) break;
            if (!endSome()) usleep(kPollMicroseconds);
        }
        for (; next_ < own_.size(); ++next_) resultOf(own_[next_], "skipped");
        return summary(time.seconds());
    }

  private:
    struct Running {
        std::size_t item;
        int slot;  ///< Its share of the threads.
        Stopwatch time;
        ChildProcess process;
    };

    ordered_json& resultOf(std::size_t item, const char* status) {
        results_[item] = {
            {"input", items_[item].input}, {"output", items_[item].output}, {"status", status}};
        return results_[item];
    }

    void begin() {
        const BatchItem& item = items_[own_[next_]];
        if (const fs::path folder = fs::path(item.output).parent_path(); !folder.empty()) {
            fs::create_directories(folder);
        }
        // The first slots take the threads that do not divide.
        const auto slots = static_cast<int>(atOnce_);
        const int slot = freeSlot();
        const int extra = slot < options_.threads % slots ? 1 : 0;
        std::vector<std::string> words = {options_.program.string(), "convert"};
        words.insert(words.end(), item.words.begin(), item.words.end());
        words.insert(words.end(), {fmt::format("--threads={}", options_.threads / slots + extra),
                                   fmt::format("--memory={}K", options_.memory / atOnce_ / 1024),
                                   "--progress=none", "--json"});
        running_.push_back({own_[next_], slot, Stopwatch(), ChildProcess(words)});
        ++next_;
    }

    int freeSlot() const {
        int slot = 0;
        while (std::ranges::count(running_, slot, &Running::slot) > 0) ++slot;
        return slot;
    }

    bool endSome() {
        bool some = false;
        for (auto it = running_.begin(); it != running_.end();) {
            const auto ended = it->process.poll();
            if (!ended) {
                ++it;
                continue;
            }
            take(*it, *ended);
            it = running_.erase(it);
            some = true;
            if (progress_) progress_({"run", "materials", ++ended_, own_.size()});
        }
        return some;
    }

    void take(const Running& running, const ChildProcess::Ended& ended) {
        const BatchItem& item = items_[running.item];
        std::vector<std::string> said = sentencesOf(ended.err);
        if (ended.status == 0) {
            const ordered_json report = ordered_json::parse(ended.out, nullptr, false);
            const bool kept = !report.is_object() || report.contains("finished_before");
            ordered_json& result = resultOf(running.item, kept ? "kept" : "done");
            result["seconds"] = running.time.seconds();
            if (report.is_object()) result["report"] = report;
        } else {
            ordered_json& result = resultOf(running.item, "failed");
            result["seconds"] = running.time.seconds();
            result["exit_status"] = ended.status;
            result["error"] =
                said.empty() ? fmt::format("ended with status {}", ended.status) : said.back();
            if (!said.empty()) said.pop_back();
            stopped_ = stopped_ || !options_.keepGoing;
        }
        for (const std::string& sentence : said) {
            if (options_.warn) options_.warn(fmt::format("{}: {}", item.input, sentence));
        }
    }

    ordered_json summary(double seconds) const {
        ordered_json counts = {{"done", 0}, {"kept", 0}, {"failed", 0}, {"skipped", 0}};
        ordered_json materials = ordered_json::array();
        for (const std::size_t item : own_) {
            materials.push_back(results_[item]);
            auto& count = counts[results_[item]["status"].get<std::string>()];
            count = count.get<int>() + 1;
        }
        ordered_json result = {{"command", "run"}, {"version", ABRDF_VERSION}};
        if (options_.shard.count > 1) {
            result["shard"] = {options_.shard.index, options_.shard.count};
        }
        result["at_once"] = atOnce_;
        result["counts"] = counts;
        result["time"] = {{"total", seconds}};
        result["materials"] = materials;
        return result;
    }

    const std::vector<BatchItem>& items_;
    const BatchOptions& options_;
    const ProgressSink& progress_;
    std::vector<std::size_t> own_;
    std::vector<ordered_json> results_;
    std::size_t atOnce_ = 1;
    std::size_t next_ = 0;
    std::size_t ended_ = 0;
    bool stopped_ = false;
    std::list<Running> running_;
};

}  // namespace

ordered_json runBatch(const std::vector<BatchItem>& items, const BatchOptions& options,
                      const ProgressSink& progress) {
    checkOutputs(items);
    return Batch(items, options, progress).run();
}

std::string batchTable(const ordered_json& summary) {
    std::size_t width = 8;
    for (const ordered_json& material : summary["materials"]) {
        width = std::max(width, material["input"].get<std::string>().size());
    }
    std::string text = fmt::format("{:<{}}  {:<8}{:>9}{:>9}{:>10}  {}\n", "material", width,
                                   "status", "seconds", "images", "MB", "");
    for (const ordered_json& m : summary["materials"]) {
        std::string images;
        std::string bytes;
        if (m.contains("report")) {
            images = m["report"]["plan"]["images_read"].dump();
            bytes = fmt::format("{:.1f}", m["report"]["output"]["bytes"].get<double>() / 1e6);
        }
        text += fmt::format(
            "{:<{}}  {:<8}{:>9}{:>9}{:>10}  {}\n", m["input"].get<std::string>(), width,
            m["status"].get<std::string>(),
            m.contains("seconds") ? fmt::format("{:.1f}", m["seconds"].get<double>()) : "", images,
            bytes, m.value("error", m["output"].get<std::string>()));
    }
    const ordered_json& counts = summary["counts"];
    text += fmt::format("{} done, {} kept, {} failed, {} skipped, in {:.1f} s\n",
                        counts["done"].dump(), counts["kept"].dump(), counts["failed"].dump(),
                        counts["skipped"].dump(), summary["time"]["total"].get<double>());
    return text;
}

}  // namespace abrdf
