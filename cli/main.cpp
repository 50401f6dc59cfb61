// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/cancel.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "abrdf/printable.h"
#include "cli/command.h"
#include "cli/config_file.h"
#include "cli/progress_display.h"
#include "cli/report_path.h"
#include "cli/suggestion.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string_view>
#include <system_error>

namespace {

using abrdf::SharedOptions;

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

volatile std::sig_atomic_t gSignal = 0;

extern "C" void onSignal(int signal) {
    gSignal = signal;
    abrdf::requestCancel();
}

void logToStderr(const SharedOptions& shared) {
    auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(
        std::getenv("NO_COLOR") != nullptr ? spdlog::color_mode::never
                                           : spdlog::color_mode::automatic);
    auto logger = std::make_shared<spdlog::logger>("abrdf", sink);
    logger->set_pattern("abrdf: %l: %v");
    logger->set_level(shared.quiet     ? spdlog::level::err
                      : shared.verbose ? spdlog::level::info
                                       : spdlog::level::warn);
    spdlog::set_default_logger(logger);
}

/// --threads, else the environment of farms, else all processors that we may use.
int chosenThreads(const SharedOptions& shared) {
    if (shared.threads > 0) return shared.threads;
    for (const char* name : {"ABRDF_THREADS", "CUE_THREADS", "SLURM_CPUS_PER_TASK"}) {
        const char* value = std::getenv(name);
        if (value == nullptr || *value == '\0') continue;
        char* end = nullptr;
        const long threads = std::strtol(value, &end, 10);
        if (*end != '\0' || threads < 1 || threads > 4096) {
            throw std::invalid_argument(
                fmt::format("{} is '{}', not a number of threads from 1 to 4096", name, value));
        }
        return static_cast<int>(threads);
    }
    return abrdf::availableThreads();
}

std::string methodList() {
    std::string list;
    for (const abrdf::Method& method : abrdf::methods()) {
        list += fmt::format("{:<12}{} ({})\n", method.name, method.description, method.cost);
    }
    return list;
}

/// "convert, inspect or demo".
std::string commandNames(const CLI::App& app) {
    std::string names;
    const auto commands =
        app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
    for (std::size_t i = 0; i < commands.size(); ++i) {
        names += (i == 0 ? "" : i + 1 == commands.size() ? " or " : ", ") + commands[i]->get_name();
    }
    return names;
}

int runChosen(const abrdf::RunCommand& run, SharedOptions& shared,
              const std::vector<std::string>& words) {
    logToStderr(shared);
    shared.threads = chosenThreads(shared);
    const auto style =
        shared.quiet ? abrdf::ProgressStyle::kNone : abrdf::progressStyleFromName(shared.progress);
    if (!shared.report.empty()) abrdf::checkReportPath(shared.report, words);
    // Times in archives do not matter, and with no zone named the C library would look up the
    // machine's own for each of an archive's thousands of entries.
    setenv("TZ", "UTC0", 0);
    // One arena, ours: the libraries' own threads would stand on its feet.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    const abrdf::ThreadLimit limit(shared.threads);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        // What a parent wants ignored, as nohup does, stays so.
        struct sigaction inherited {};
        sigaction(signal, nullptr, &inherited);
        if (inherited.sa_handler != SIG_IGN) std::signal(signal, onSignal);
    }
    std::signal(SIGCHLD, SIG_DFL);  // Ignored, children would leave no status.
    // As errors of the write that meets them, they leave no half file behind.
    for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
    return run(shared, abrdf::makeProgressDisplay(style));
}

int runProgram(std::vector<std::string> words) {
    CLI::App app("Reconstructs apparent BRDFs from sparse samples of BTF databases.", "abrdf");
    app.set_version_flag("--version", "abrdf " ABRDF_VERSION);
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.fallthrough();
    bool listMethods = false;
    app.add_flag("--list-methods", listMethods, "print the methods: name, what it does, cost");
    SharedOptions shared;
    abrdf::addSharedOptions(app, shared);
    abrdf::RunCommand run;
    abrdf::addConvert(app, run);
    abrdf::addInspect(app, run);
    abrdf::addEvaluate(app, run);
    abrdf::addChart(app, run);
    abrdf::addPlan(app, run);
    abrdf::addTrain(app, run);
    abrdf::addExport(app, run);
    abrdf::addStress(app, run);
    abrdf::addPreview(app, run);
    abrdf::addReport(app, run);
    abrdf::addExpand(app, run);
    abrdf::addMerge(app, run);
    abrdf::addRun(app, run);
    abrdf::addDemo(app, run);
    abrdf::addDescribe(app, run);
    app.require_subcommand(0, 1);
    try {
        words = abrdf::withConfigFile(std::move(words));
        std::vector<std::string> fromTheBack(words.rbegin(), words.rend());
        app.parse(fromTheBack);  // CLI11 takes them off it.
    } catch (const CLI::Success& success) {
        app.exit(success);
        abrdf::checkStandardOutput();
        return 0;
    } catch (const CLI::ParseError& error) {
        std::cerr << fmt::format("abrdf: {}{}\n", abrdf::printable(error.what()),
                                 abrdf::suggestion(app, words));
        return kWrongUsage;
    }
    if (listMethods) {
        std::cout << methodList();
        abrdf::checkStandardOutput();
        return 0;
    }
    if (!run) {
        std::cerr << fmt::format("abrdf: which command? {}; abrdf --help says more\n",
                                 commandNames(app));
        return kWrongUsage;
    }
    return runChosen(run, shared, words);
}

constexpr const char* kNoMemory =
    "there is not enough memory for this job; give it fewer --threads or, where it has them, fewer "
    "--texels or less --memory to keep within";

/// Whether the system gave no memory, or no thread, which takes some. TBB says the latter in words.
bool isLackOfMemory(const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
           (system != nullptr &&
            (system->code().value() == EAGAIN || system->code().value() == ENOMEM)) ||
           std::string_view(error.what()).starts_with("pthread_create");
}

/// Takes no memory where there is none, not even a string's.
void sayFailed(const std::exception& error) noexcept {
    if (!isLackOfMemory(error)) {
        try {
            std::cerr << "abrdf: " << abrdf::printable(error.what()) << "\n";
            return;
        } catch (const std::bad_alloc&) {
        }
    }
    std::cerr << "abrdf: " << kNoMemory << "\n";
}

/// Where an exception has nobody to catch it, as in the libraries' own threads.
[[noreturn]] void onTerminate() {
    try {
        if (std::current_exception()) std::rethrow_exception(std::current_exception());
    } catch (const std::exception& error) {
        sayFailed(error);
        std::_Exit(kFailed);
    } catch (...) {
    }
    std::abort();
}

/// The exit status; what failed stands on stderr.
int statusOf(int argc, char** argv) {
    try {
        return runProgram(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const abrdf::Cancelled& cancelled) {
        std::cerr << "\nabrdf: " << cancelled.what() << "\n";
        // Ends by the signal itself, so that a script's loop ends as well.
        std::signal(gSignal, SIG_DFL);
        std::raise(gSignal);
    } catch (const std::invalid_argument& error) {
        sayFailed(error);
        return kWrongUsage;
    } catch (const std::exception& error) {
        sayFailed(error);
    }
    return kFailed;
}

}  // namespace

int main(int argc, char** argv) {
    std::set_terminate(onTerminate);
    const int status = statusOf(argc, argv);
#ifdef __SANITIZE_ADDRESS__
    return status;  // Leaks are looked for at exit.
#else
    // OpenBLAS, which OpenImageIO brings along, would wait at exit for a thread of its own, for
    // ever where that got no memory. Nothing here needs the libraries' destructors.
    std::cout.flush();
    std::fflush(nullptr);
    std::_Exit(status);
#endif
}
