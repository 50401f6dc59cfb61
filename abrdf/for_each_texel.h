// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace abrdf {

/// Bounds the threads of every loop below while it lives. threads: 1 .. ; one such object at a
/// time.
class ThreadLimit {
  public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    void* control_;
};

/// The processors this process may run on.
int availableThreads();

/// The threads that the loops below use at most.
int threadsInUse();

/// Calls body(begin, end) for the blocks [begin, end) of `blockSize` texels (the last may be
/// shorter) that cover 0 .. count-1: in any order, on any thread. The only door to threads: what
/// is thrown inside is thrown again here, and a cancelled job stops between two blocks.
void forEachTexelBlock(std::size_t count, std::size_t blockSize,
                       const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls body(texel) once for each texel below `count`.
void forEachTexel(std::size_t count, const std::function<void(std::size_t texel)>& body);

/// Calls body(image) once for each image below `count`; each is a task of its own, as images are
/// large and cost what they like.
void forEachImage(std::size_t count, const std::function<void(std::size_t image)>& body);

/// Calls both, at once where a thread is free; what is thrown inside is thrown again here.
void callBoth(const std::function<void()>& first, const std::function<void()>& second);

/// Sum of term(texel), the same bits for every number of threads: partial sums of fixed blocks,
/// added in their order.
double sumOverTexels(std::size_t count, const std::function<double(std::size_t texel)>& term);

}  // namespace abrdf
