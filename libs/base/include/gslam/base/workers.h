#ifndef GSLAM_BASE_WORKERS_H
#define GSLAM_BASE_WORKERS_H

#include <gslam/base/detail/ring.h>
#include <gslam/base/error.h>
#include <gslam/base/log_hook.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

/// @file
/// A fixed set of worker threads, without futures, which cost those who include them: thread_pool.h
/// has these.

namespace gslam {
inline namespace v1 {

/// How many threads GSLAM uses unless told: the environment variable `GSLAM_THREADS`, else the
/// number of processors; at least 1.
/// @throws ArgumentError when `GSLAM_THREADS` is no number from 1 to 4096
inline unsigned defaultThreadCount() {
  const char* const wish = std::getenv("GSLAM_THREADS");
  if (wish == nullptr || *wish == '\0') return std::max(1u, std::thread::hardware_concurrency());
  char* end = nullptr;
  const long count = std::strtol(wish, &end, 10);
  if (*end != '\0' || count < 1 || count > 4096) {
    throw ArgumentError("GSLAM_THREADS",
                        "is \"" + std::string(wish) + "\", expected a number from 1 to 4096");
  }
  return static_cast<unsigned>(count);
}

namespace detail {
template <class Task>
struct Submitted;  // in thread_pool.h
}  // namespace detail

/// Worker threads that run tasks in the order they were submitted.
///
/// All members are thread-safe. The destructor runs what is queued, then joins. A task must not
/// block on the future of another task of the same pool: with every worker waiting, nobody works
/// (parallelFor() may be nested, because its caller works, too). A task must not destroy its own
/// pool. After fork() a child has none of the threads and must not use the pool.
class ThreadPool {
 public:
  /// @param threads  number of workers; 0 means defaultThreadCount()
  explicit ThreadPool(unsigned threads = 0)
      : workers_(threads == 0 ? defaultThreadCount() : threads) {
    try {
      for (std::thread& worker : workers_) worker = std::thread([this] { work(); });
    } catch (...) {  // the system has no more threads: join those that run before telling
      stop();
      throw;
    }
  }
  ~ThreadPool() { stop(); }
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// The pool that parallelFor() uses unless told: with its caller it makes defaultThreadCount()
  /// threads, but it has one worker at least. Made at the first call and never destroyed, so static
  /// destructors may use it.
  /// @throws std::system_error when the system has no thread for it
  static ThreadPool& shared() {
    static ThreadPool* const pool = new ThreadPool(std::max(2u, defaultThreadCount()) - 1);
    return *pool;
  }

  /// Number of workers.
  unsigned size() const noexcept { return static_cast<unsigned>(workers_.size()); }

  /// Queues a call of `task()`. To be had from thread_pool.h.
  /// @return its result, or what it throws, as a std::future
  template <class Task>
  typename detail::Submitted<Task>::Future submit(Task&& task);

  /// Queues a task whose end nobody waits for. What it throws is logged as an error and dropped:
  /// where failure matters, use submit().
  void post(std::function<void()> task) {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      tasks_.push(std::move(task));
    }
    ready_.notify_one();
  }

 private:
  void work() noexcept {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      ready_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
      if (tasks_.empty()) return;
      {
        const std::function<void()> task = tasks_.pop();
        lock.unlock();
        try {
          task();
        } catch (const std::exception& error) {
          detail::logParts(LogLevel::error, __FILE__, __LINE__,
                           {"a task of the thread pool threw: ", error.what()});
        } catch (...) {
          detail::logParts(LogLevel::error, __FILE__, __LINE__,
                           {"a task of the thread pool threw something that is no exception"});
        }
      }  // the task's captures end before the lock is taken again
      lock.lock();
    }
  }

  void stop() {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
    }
    ready_.notify_all();
    for (std::thread& worker : workers_) {
      if (worker.joinable()) worker.join();  // those that could not be made are not
    }
  }

  std::mutex mutex_;  // guards tasks_ and stopping_
  std::condition_variable ready_;
  detail::Ring<std::function<void()>> tasks_;
  bool stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_WORKERS_H
