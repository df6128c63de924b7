// Messages that wait for a subscriber.
#ifndef GSLAM_MESSENGER_DETAIL_MESSAGE_QUEUE_H
#define GSLAM_MESSENGER_DETAIL_MESSAGE_QUEUE_H

#include <gslam/base/detail/ring.h>
#include <gslam/messenger/detail/brief_wait.h>
#include <gslam/messenger/detail/wait_time.h>
#include <gslam/messenger/options.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

/// What became of messages.
struct QueueCounts {
  std::uint64_t dropped;  ///< that came and were not delivered
  std::size_t waiting;    ///< that are there now
};

/// A count that outlives its queue.
using SharedCount = std::shared_ptr<std::atomic<std::uint64_t>>;

/// Messages from any number of publishers to one consumer.
template <class Item>
class MessageQueue {
 public:
  explicit MessageQueue(const SubscribeOptions& options)
      : capacity_(options.capacity), overflow_(options.overflow), spin_(waitTime(options.spin)) {}

  /// Lets a message wait, or drops one, as the options say. True where a consumer that had nothing
  /// to do should be started.
  bool push(Item item) {
    Item dropped = Item();  // destroyed without the lock
    std::unique_lock<std::mutex> lock(mutex_);
    const bool is_full = ring_.size() >= capacity_;
    if (is_full && overflow_ == Overflow::block_publisher && !isConsumer()) waitForRoom(lock);
    if (is_closed_ || (is_full && overflow_ == Overflow::drop_newest)) return drop(item, dropped);
    if (is_full && overflow_ == Overflow::drop_oldest) {
      dropped = ring_.pop();
      ++*dropped_;
    }
    ring_.push(std::move(item));
    size_.store(ring_.size(), std::memory_order_relaxed);
    const bool was_idle = !is_busy_;
    is_busy_ = true;
    const bool wake = sleepers_ > 0;
    lock.unlock();
    if (wake) not_empty_.notify_one();
    return was_idle;
  }

  /// The next message at once, or none.
  bool tryPop(Item& item) {
    std::unique_lock<std::mutex> lock(mutex_);
    return take(item, lock);
  }

  /// Waits for the next message; false when the queue was closed and holds no more.
  bool waitPop(Item& item) {
    lookAround();
    std::unique_lock<std::mutex> lock(mutex_);
    waitForMessage(lock);
    return take(item, lock);
  }

  /// All that waits, in exchange for an empty ring; false when closed and empty. For queues without
  /// bound: what was taken has no place in them. The consumer says how much of it still waits.
  bool waitPopAll(Ring<Item>& items) {
    lookAround();
    std::unique_lock<std::mutex> lock(mutex_);
    waitForMessage(lock);
    ring_.swap(items);
    size_.store(0, std::memory_order_relaxed);
    setTaken(items.size());
    return !items.empty();
  }

  /// How many of those that waitPopAll() gave are still to be delivered.
  void setTaken(std::size_t count) noexcept { taken_.store(count, std::memory_order_relaxed); }

  /// The same as waitPop(), but no longer than that; false also where none came.
  template <class Rep, class Period>
  bool waitPopFor(Item& item, const std::chrono::duration<Rep, Period>& time) {
    const auto end = std::chrono::steady_clock::now() + waitTime(time);
    std::unique_lock<std::mutex> lock(mutex_);
    ++sleepers_;
    not_empty_.wait_until(lock, end, [this] { return !ring_.empty() || is_closed_; });
    --sleepers_;
    return take(item, lock);
  }

  /// The consumer of an executor has nothing more to do; false where something came meanwhile.
  bool goIdle() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!ring_.empty()) return false;
    is_busy_ = false;
    idle_.notify_all();
    return true;
  }
  /// The consumer could not be started: what waits does so until the next message starts it.
  void stayIdle() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_busy_ = false;
    idle_.notify_all();
  }
  /// Waits until goIdle() was true and nothing waits, or the consumer could not be started.
  void waitUntilIdle() {
    std::unique_lock<std::mutex> lock(mutex_);
    idle_.wait(lock, [this] { return !is_busy_; });
  }

  /// Takes no more messages; what waits is dropped or stays for the consumer.
  void close(Pending pending) {
    Ring<Item> dropped;  // destroyed without the lock
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
    is_closing_.store(true, std::memory_order_relaxed);
    if (pending == Pending::discard) {
      *dropped_ += ring_.size();
      ring_.swap(dropped);
      size_.store(0, std::memory_order_relaxed);
    }
    not_empty_.notify_all();
    not_full_.notify_all();
  }

  /// Messages that were taken out and not delivered.
  void countDropped(std::size_t count) noexcept { *dropped_ += count; }
  /// Goes on after the queue.
  const SharedCount& dropped() const noexcept { return dropped_; }
  bool isBounded() const noexcept { return capacity_ != std::numeric_limits<std::size_t>::max(); }
  QueueCounts counts() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return {dropped_->load(), ring_.size() + taken_.load(std::memory_order_relaxed)};
  }

  /// Which queue this thread delivers from just now.
  class Consuming {
   public:
    explicit Consuming(const void* queue) noexcept : outer_(current()) { current() = queue; }
    ~Consuming() { current() = outer_; }
    Consuming(const Consuming&) = delete;
    Consuming& operator=(const Consuming&) = delete;
    static const void*& current() noexcept {
      static thread_local const void* queue = nullptr;
      return queue;
    }

   private:
    const void* outer_;
  };
  bool isConsumer() const noexcept { return Consuming::current() == this; }

 private:
  bool drop(Item& item, Item& dropped) {
    dropped = std::move(item);
    ++*dropped_;
    return false;
  }

  void waitForRoom(std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    publishers_wait_.untilThereIs([this] {
      const std::size_t size = size_.load(std::memory_order_relaxed);
      return size < capacity_ ? capacity_ - size : 0;
    });
    lock.lock();
    ++waiting_publishers_;
    not_full_.wait(lock, [this] { return ring_.size() < capacity_ || is_closed_; });
    --waiting_publishers_;
  }

  bool take(Item& item, std::unique_lock<std::mutex>& lock) {
    if (ring_.empty()) return false;
    item = ring_.pop();
    size_.store(ring_.size(), std::memory_order_relaxed);
    const bool wake = waiting_publishers_ > 0;
    lock.unlock();
    if (wake) not_full_.notify_one();
    return true;
  }

  void waitForMessage(std::unique_lock<std::mutex>& lock) {
    if (!ring_.empty() || is_closed_) return;
    const auto begin = std::chrono::steady_clock::now();
    ++sleepers_;
    not_empty_.wait(lock, [this] { return !ring_.empty() || is_closed_; });
    --sleepers_;
    const auto slept = std::chrono::steady_clock::now() - begin;
    was_short_ = slept < std::chrono::microseconds(50);
  }

  // Looks for messages a while before it sleeps, without the lock. In between others have the
  // processor: the one who is to publish may need it.
  void lookAround() {
    const auto waiting = [this] { return size_.load(std::memory_order_relaxed); };
    if (was_short_) wait_.untilThereIs(waiting);
    if (spin_.count() == 0 || waiting() > 0) return;
    const auto end = std::chrono::steady_clock::now() + spin_;
    for (int i = 1; waiting() == 0 && !is_closing_.load(std::memory_order_relaxed); ++i) {
      if (i % 64 != 0) continue;
      if (std::chrono::steady_clock::now() > end) return;
      std::this_thread::yield();
    }
  }

  const std::size_t capacity_;
  const Overflow overflow_;
  const std::chrono::nanoseconds spin_;
  const SharedCount dropped_ = std::make_shared<std::atomic<std::uint64_t>>(0);
  std::atomic<std::size_t> taken_{0};    // by waitPopAll(), and still to be delivered
  BriefWait wait_{false};                // of a consumer with a thread of its own
  bool was_short_ = false;               // so was its last sleep: the wait may be better
  BriefWait publishers_wait_{true};      // for room
  std::atomic<std::size_t> size_{0};     // of ring_, for lookAround()
  std::atomic<bool> is_closing_{false};  // is_closed_, for lookAround()
  mutable std::mutex mutex_;             // guards all below
  std::condition_variable not_empty_;
  std::condition_variable not_full_;
  std::condition_variable idle_;
  Ring<Item> ring_;
  std::size_t waiting_publishers_ = 0;
  std::size_t sleepers_ = 0;  // consumers that wait for not_empty_
  bool is_busy_ = false;      // a consumer on an executor is at work, or about to be
  bool is_closed_ = false;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_MESSAGE_QUEUE_H
