#include "prefetcher.h"

#include <algorithm>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace reading {

Prefetcher::Prefetcher(std::size_t count, int threads, int ahead,
                       std::function<Images(std::size_t)> load)
    : count_(count),
      threads_(static_cast<std::size_t>(std::max(threads, 0))),
      load_(std::move(load)),
      slots_(static_cast<std::size_t>(std::max(ahead, 1))) {
  window_ = firstWindow();
}

Prefetcher::~Prefetcher() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wanted_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

Prefetcher::Images Prefetcher::next() {
  if (threads_ == 0) return load_(position_++);
  if (workers_.empty()) start();
  std::unique_lock<std::mutex> lock(mutex_);
  Slot& slot = slotOf(position_);
  loaded_.wait(lock, [&slot] { return slot.is_loaded; });
  Slot taken = std::move(slot);
  slot = Slot();
  ++position_;
  window_ = std::min(2 * window_, slots_.size());
  lock.unlock();
  wanted_.notify_all();
  if (taken.failure != nullptr) std::rethrow_exception(taken.failure);
  return std::move(taken.images);
}

void Prefetcher::seek(std::size_t position) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (position == position_) return;
    position_ = asked_ = position;
    window_ = firstWindow();
    ++generation_;
    std::fill(slots_.begin(), slots_.end(), Slot());
  }
  wanted_.notify_all();
}

// As many as the system gives, if it is one.
void Prefetcher::start() {
  workers_.reserve(threads_);
  try {
    while (workers_.size() < threads_) workers_.emplace_back([this] { work(); });
  } catch (...) {
    if (workers_.empty()) throw;
  }
}

void Prefetcher::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wanted_.wait(lock,
                 [this] { return stopping_ || (asked_ < count_ && asked_ - position_ < window_); });
    if (stopping_) return;
    const std::size_t frame = asked_++, generation = generation_;
    lock.unlock();
    Slot result;
    result.is_loaded = true;
    try {
      result.images = load_(frame);
    } catch (...) {
      result.failure = std::current_exception();
    }
    lock.lock();
    if (generation != generation_) continue;
    slotOf(frame) = std::move(result);
    loaded_.notify_one();
  }
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
