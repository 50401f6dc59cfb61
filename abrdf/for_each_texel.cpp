// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"

#include "abrdf/cancel.h"

#include <sched.h>

#include <algorithm>
#include <vector>

// ThreadSanitizer cannot see into Debian's libtbb and reports false races there, so that build
// runs the same blocks on plain threads.
#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#endif

namespace abrdf {

namespace {

// One size whatever the number of threads, so that sums keep their bits.
constexpr std::size_t kTexelBlock = 64;

#ifdef __SANITIZE_THREAD__

int gThreads = 4;

void forEachBlock(std::size_t blocks, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next = 0;
    std::exception_ptr error;
    std::mutex errorMutex;
    std::vector<std::thread> workers;
    for (int i = 0; i < gThreads; ++i) {
        workers.emplace_back([&] {
            try {
                for (std::size_t block = next++; block < blocks; block = next++) body(block);
            } catch (...) {
                const std::lock_guard lock(errorMutex);
                error = std::current_exception();
                next = blocks;
            }
        });
    }
    for (std::thread& worker : workers) worker.join();
    if (error) std::rethrow_exception(error);
}

#else

void forEachBlock(std::size_t blocks, const std::function<void(std::size_t)>& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
                      });
}

#endif

}  // namespace

#ifdef __SANITIZE_THREAD__
ThreadLimit::ThreadLimit(int threads) : control_(nullptr) {
    gThreads = std::max(1, threads);
}
ThreadLimit::~ThreadLimit() = default;
int threadsInUse() {
    return gThreads;
}
#else
ThreadLimit::ThreadLimit(int threads)
    : control_(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       static_cast<std::size_t>(std::max(1, threads)))) {}
ThreadLimit::~ThreadLimit() {
    delete static_cast<tbb::global_control*>(control_);
}
int threadsInUse() {
    return static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}
#endif

int availableThreads() {
    cpu_set_t set;
    CPU_ZERO(&set);
    return sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

void forEachTexelBlock(std::size_t count, std::size_t blockSize,
                       const std::function<void(std::size_t, std::size_t)>& body) {
    const std::size_t blocks = (count + blockSize - 1) / blockSize;
    forEachBlock(blocks, [&](std::size_t block) {
        throwIfCancelled();
        body(block * blockSize, std::min(count, (block + 1) * blockSize));
    });
}

void forEachTexel(std::size_t count, const std::function<void(std::size_t)>& body) {
    forEachTexelBlock(count, kTexelBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t texel = begin; texel < end; ++texel) body(texel);
    });
}

void forEachImage(std::size_t count, const std::function<void(std::size_t)>& body) {
    forEachTexelBlock(count, 1, [&](std::size_t begin, std::size_t) { body(begin); });
}

void callBoth(const std::function<void()>& first, const std::function<void()>& second) {
    forEachBlock(2, [&](std::size_t which) { which == 0 ? first() : second(); });
}

double sumOverTexels(std::size_t count, const std::function<double(std::size_t)>& term) {
    std::vector<double> sums((count + kTexelBlock - 1) / kTexelBlock);
    forEachTexelBlock(count, kTexelBlock, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t texel = begin; texel < end; ++texel) sum += term(texel);
        sums[begin / kTexelBlock] = sum;
    });
    double total = 0;
    for (const double sum : sums) total += sum;
    return total;
}

}  // namespace abrdf
