#ifndef GSLAM_BASE_PARALLEL_H
#define GSLAM_BASE_PARALLEL_H

#include <gslam/base/thread_pool.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

/// @file
/// Loops over an index range on several threads, with results that do not depend on their number.
///
/// The range is cut into chunks of `grain` indices, whatever the number of threads, and the caller
/// works on them, too; so loops may be nested. When bodies throw, the exception of the lowest
/// failing chunk is rethrown once all running bodies have ended; chunks above it may be left out.

namespace gslam {
inline namespace v1 {

/// How a parallel loop runs.
struct ParallelOptions {
  std::size_t grain = 1;  ///< indices in a chunk; 0 counts as 1. Aim at 10 us of work or more.
  /// Most threads at work, the caller's among them; 0: as many as the pool and the caller, for the
  /// shared pool defaultThreadCount() as it was at the first loop
  unsigned threads = 0;
  ThreadPool* pool = nullptr;  ///< whose workers help; null: ThreadPool::shared()
};

namespace detail {

// Chunks 0 to count - 1 of one loop, taken in order by whoever has time.
// Helpers may come late, after the loop is over: they find no chunk left and touch nothing else.
class ChunkLoop {
 public:
  explicit ChunkLoop(std::size_t count) : count_(count) {}

  // Runs chunks until none is left.
  template <class RunChunk>
  void work(const RunChunk& run_chunk) {
    std::size_t chunk;
    while (take(chunk)) {
      std::size_t finished = 1;
      try {
        run_chunk(chunk);
      } catch (...) {
        keepError(chunk, std::current_exception());
        finished += leaveTheRest();
      }
      if (done_.fetch_add(finished, std::memory_order_acq_rel) + finished == count_) {
        std::lock_guard<std::mutex> lock(mutex_);
        all_done_.notify_all();
      }
    }
  }

  // Waits for the chunks that others took, then throws what they threw.
  void finish() {
    std::unique_lock<std::mutex> lock(mutex_);
    all_done_.wait(lock, [this] { return done_.load(std::memory_order_acquire) == count_; });
    if (error_) std::rethrow_exception(std::move(error_));
  }

 private:
  bool take(std::size_t& chunk) {
    chunk = next_.load(std::memory_order_relaxed);
    while (chunk < count_) {
      if (next_.compare_exchange_weak(chunk, chunk + 1, std::memory_order_relaxed)) return true;
    }
    return false;
  }

  // Takes all chunks that nobody took yet, and says how many. Those below a failed one are taken.
  std::size_t leaveTheRest() { return count_ - next_.exchange(count_, std::memory_order_relaxed); }

  void keepError(std::size_t chunk, std::exception_ptr error) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (chunk >= lowest_failed_) return;
    lowest_failed_ = chunk;
    error_ = std::move(error);
  }

  const std::size_t count_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;  // guards the two below
  std::size_t lowest_failed_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr error_;
  std::condition_variable all_done_;
};

// The pool that a loop uses; null where the system has no thread left for the shared one.
inline ThreadPool* poolOf(const ParallelOptions& options) {
  if (options.pool != nullptr) return options.pool;
  try {
    return &ThreadPool::shared();
  } catch (const std::system_error&) {
    return nullptr;
  }
}

// Most threads that a loop uses. The shared pool may have a worker more than GSLAM_THREADS allows.
inline std::size_t threadBound(const ParallelOptions& options) {
  if (options.threads != 0) return options.threads;
  if (options.pool != nullptr) return options.pool->size() + std::size_t(1);
  static const unsigned bound = defaultThreadCount();
  return bound;
}

template <class RunChunk>
void runChunks(std::size_t count, const ParallelOptions& options, const RunChunk& run_chunk) {
  if (count == 0) return;
  const std::size_t threads = std::min(threadBound(options), count);
  ThreadPool* const pool = threads > 1 ? poolOf(options) : nullptr;
  if (pool == nullptr) {
    for (std::size_t chunk = 0; chunk < count; ++chunk) run_chunk(chunk);
    return;
  }
  const std::size_t helpers = std::min<std::size_t>(pool->size(), threads - 1);
  const auto loop = std::make_shared<ChunkLoop>(count);
  const RunChunk* const body = &run_chunk;  // outlives every chunk: finish() waits for them
  try {
    for (std::size_t i = 0; i < helpers; ++i) pool->post([loop, body] { loop->work(*body); });
  } catch (...) {  // NOLINT(bugprone-empty-catch): fewer helpers; leaving now lets `body` dangle
  }
  loop->work(run_chunk);
  loop->finish();
}

inline std::size_t chunkCount(std::size_t size, std::size_t grain) {
  return size / grain + (size % grain != 0 ? 1 : 0);
}

}  // namespace detail

/// Calls `body(first, last)` for consecutive pieces [first, last) of [begin, end), of
/// `options.grain` indices each (the last may be shorter). Nothing is called when begin >= end.
template <class Body>
void parallelChunks(std::size_t begin, std::size_t end, const Body& body,
                    const ParallelOptions& options = ParallelOptions()) {
  if (begin >= end) return;
  const std::size_t grain = std::max<std::size_t>(1, options.grain);
  detail::runChunks(detail::chunkCount(end - begin, grain), options, [&](std::size_t chunk) {
    const std::size_t first = begin + chunk * grain;
    body(first, first + std::min(grain, end - first));
  });
}

/// Calls `body(i)` for each i of [begin, end), in ascending order within a chunk.
template <class Body>
void parallelFor(std::size_t begin, std::size_t end, const Body& body,
                 const ParallelOptions& options = ParallelOptions()) {
  parallelChunks(
      begin, end,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) body(i);
      },
      options);
}

/// Combines `map(first, last)` over the chunks of [begin, end), in their order:
/// `combine(... combine(combine(initial, chunk 0), chunk 1) ..., last chunk)`.
///
/// The result has the same bits for any number of threads, but not for another grain when
/// `combine` rounds.
/// @tparam T  copyable and default constructible
template <class T, class Map, class Combine>
T parallelReduce(std::size_t begin, std::size_t end, T initial, const Map& map,
                 const Combine& combine, const ParallelOptions& options = ParallelOptions()) {
  if (begin >= end) return initial;
  struct Slot {  // keeps std::vector<bool> away from threads that write side by side
    T value;
  };
  const std::size_t grain = std::max<std::size_t>(1, options.grain);
  std::vector<Slot> parts(detail::chunkCount(end - begin, grain));
  parallelChunks(
      begin, end,
      [&](std::size_t first, std::size_t last) {
        parts[(first - begin) / grain].value = map(first, last);
      },
      options);
  for (Slot& part : parts) initial = combine(std::move(initial), std::move(part.value));
  return initial;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_PARALLEL_H
