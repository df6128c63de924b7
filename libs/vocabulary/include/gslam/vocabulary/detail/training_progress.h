// How far a training is, and whether it is to go on.
#ifndef GSLAM_VOCABULARY_DETAIL_TRAINING_PROGRESS_H
#define GSLAM_VOCABULARY_DETAIL_TRAINING_PROGRESS_H

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>

namespace gslam {
inline namespace v1 {
namespace detail {

// Thread-safe. The callback runs in one thread at a time.
class TrainingProgress {
 public:
  explicit TrainingProgress(const std::function<bool(double)>& callback) : callback_(callback) {}

  // Work to be done, of which add() says what has been.
  void setTotal(std::uint64_t total) noexcept { total_ = std::max<std::uint64_t>(1, total); }

  void setDone(std::uint64_t work) noexcept { done_.store(work, std::memory_order_relaxed); }

  bool isCancelled() const noexcept { return is_cancelled_.load(std::memory_order_relaxed); }

  // Asks the callback after each hundredth.
  void add(std::uint64_t work) {
    const std::uint64_t before = done_.fetch_add(work, std::memory_order_relaxed);
    const std::uint64_t step = total_ / 100 + 1;
    if (before / step != (before + work) / step) ask();
  }

  // Asks the callback, and says whether to go on.
  bool goesOn() {
    ask();
    return !isCancelled();
  }

  // Asks the callback whether to go on.
  void ask() {
    if (!callback_) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (isCancelled()) return;
    const auto done = static_cast<double>(done_.load(std::memory_order_relaxed));
    if (!callback_(std::min(1.0, done / static_cast<double>(total_)))) is_cancelled_.store(true);
  }

 private:
  const std::function<bool(double)>& callback_;
  std::uint64_t total_ = 1;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<bool> is_cancelled_{false};
  std::mutex mutex_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_TRAINING_PROGRESS_H
