// What one writes by hand: a deque behind a mutex, and a thread that waits for it.
#include <condition_variable>
#include <deque>
#include <mutex>
#include <vector>

#include "queue.h"

namespace {

class Consumer {
 public:
  Consumer(std::size_t capacity, Handled& handled)
      : capacity_(capacity), handled_(handled), thread_([this] { work(); }) {}
  ~Consumer() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stop_ = true;
    }
    not_empty_.notify_one();
    thread_.join();
  }
  void push(const QueuedMessage& message) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      not_full_.wait(lock, [this] { return capacity_ == 0 || waiting_.size() < capacity_; });
      waiting_.push_back(message);
    }
    not_empty_.notify_one();
  }

 private:
  void work() {
    for (;;) {
      std::unique_lock<std::mutex> lock(mutex_);
      not_empty_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      const QueuedMessage message = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      if (capacity_ != 0) not_full_.notify_one();
      handled_.add(message);
    }
  }

  const std::size_t capacity_;
  Handled& handled_;
  std::mutex mutex_;
  std::condition_variable not_empty_;
  std::condition_variable not_full_;
  std::deque<QueuedMessage> waiting_;
  bool stop_ = false;
  std::thread thread_;
};

class MutexDeque {
 public:
  MutexDeque(std::size_t subscribers, std::size_t capacity, Handled& handled) {
    for (std::size_t i = 0; i < subscribers; ++i) {
      consumers_.emplace_back(new Consumer(capacity, handled));
    }
  }
  void push(const QueuedMessage& message) {
    for (const auto& consumer : consumers_) consumer->push(message);
  }

 private:
  std::vector<std::unique_ptr<Consumer>> consumers_;
};

BURST_PEER(MutexDeque, "mutex_deque");
ONE_BY_ONE_PEER(MutexDeque, "mutex_deque");
PUBLISHERS_PEER(MutexDeque, "mutex_deque");

}  // namespace
