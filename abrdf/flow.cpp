// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/flow.h"

#include "abrdf/cancel.h"

// As in for_each_texel.cpp: plain threads for ThreadSanitizer.
#ifdef __SANITIZE_THREAD__
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/parallel_pipeline.h>
#endif

namespace abrdf {

namespace {

void call(const Flow::Step& step, std::size_t item, const Flow& flow) {
    // Items are delivered in order, so that the one before in this slot has left.
    if (step) step(item, item % flow.slots);
}

}  // namespace

#ifdef __SANITIZE_THREAD__

namespace {

/// Three steps an item, the outer two in order of the items.
class PlainFlow {
  public:
    explicit PlainFlow(const Flow& flow) : flow_(flow) {}

    void run() {
        std::vector<std::thread> workers;
        for (int i = 0; i < 4; ++i) workers.emplace_back([&] { workUntilDone(); });
        for (std::thread& worker : workers) worker.join();
        if (error_) std::rethrow_exception(error_);
    }

  private:
    void workUntilDone() {
        try {
            while (doOne()) {
            }
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!error_) error_ = std::current_exception();
            changed_.notify_all();
        }
    }

    bool doOne() {
        std::size_t item = 0;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] {
                return error_ || (!fetching_ && fetched_ < delivered_ + flow_.slots);
            });
            if (error_ || fetched_ == flow_.items) return false;
            fetching_ = true;
            item = fetched_;
        }
        throwIfCancelled();
        call(flow_.fetch, item, flow_);
        {
            const std::lock_guard lock(mutex_);
            fetching_ = false;
            ++fetched_;
            changed_.notify_all();
        }
        call(flow_.work, item, flow_);
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return error_ || delivered_ == item; });
        if (error_) return false;
        lock.unlock();
        call(flow_.deliver, item, flow_);
        lock.lock();
        ++delivered_;
        changed_.notify_all();
        return true;
    }

    const Flow& flow_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool fetching_ = false;
    std::size_t fetched_ = 0;
    std::size_t delivered_ = 0;
    std::exception_ptr error_;
};

}  // namespace

void runFlow(const Flow& flow) {
    PlainFlow(flow).run();
}

#else

void runFlow(const Flow& flow) {
    std::size_t next = 0;
    const auto fetch = [&](tbb::flow_control& control) -> std::size_t {
        if (next == flow.items) {
            control.stop();
            return 0;
        }
        throwIfCancelled();
        call(flow.fetch, next, flow);
        return next++;
    };
    const auto work = [&](std::size_t item) {
        call(flow.work, item, flow);
        return item;
    };
    const auto deliver = [&](std::size_t item) { call(flow.deliver, item, flow); };
    using Mode = tbb::filter_mode;
    tbb::parallel_pipeline(flow.slots,
                           tbb::make_filter<void, std::size_t>(Mode::serial_in_order, fetch) &
                               tbb::make_filter<std::size_t, std::size_t>(Mode::parallel, work) &
                               tbb::make_filter<std::size_t, void>(Mode::serial_in_order, deliver));
}

#endif

}  // namespace abrdf
