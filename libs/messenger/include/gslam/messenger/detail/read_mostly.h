// A value that is read all the time, without locks, and replaced now and then.
#ifndef GSLAM_MESSENGER_DETAIL_READ_MOSTLY_H
#define GSLAM_MESSENGER_DETAIL_READ_MOSTLY_H

#include <gslam/base/platform.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <thread>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Sleepable read-copy-update: readers count themselves in and out of one of two phases, and a
/// writer waits until both were empty once since it replaced the value (P. McKenney, "Sleepable
/// Read-Copy Update", LWN 2006; here with sequentially consistent counters of all threads).
///
/// Reading costs two atomic additions, from as many threads as there are. A reader may take long,
/// may sleep, and may replace the value that it reads.
template <class Value>
class ReadMostly {
  struct Phase {
    std::atomic<std::uint64_t> entered{0};
    std::atomic<std::uint64_t> left{0};
    bool isEmpty() const noexcept {
      const std::uint64_t out = left.load();  // before those who came in
      return entered.load() == out;
    }
  };
  // A value and the one before, which readers may still see.
  struct Version {
    const Value value;
    Version* before;
  };
  struct Old {
    Old() = default;
    ~Old() {
      while (first != nullptr) {
        Version* const ended = first;
        first = ended->before;
        delete ended;
      }
    }
    Version* first = nullptr;
  };

 public:
  explicit ReadMostly(Value initial) : now_(new Version{std::move(initial), nullptr}) {}
  ~ReadMostly() { delete now_.load(); }
  ReadMostly(const ReadMostly&) = delete;
  ReadMostly& operator=(const ReadMostly&) = delete;

  /// Keeps the value of its beginning alive.
  class Reader {
   public:
    explicit Reader(ReadMostly& owner) noexcept
        : owner_(owner), phase_(owner.phases_[owner.phase_.load() & 1]) {
      phase_.entered.fetch_add(1);
      value_ =
          &owner.now_.load()->value;  // after it was counted: what is replaced later stays alive
    }
    ~Reader() {
      phase_.left.fetch_add(1);
      if (owner_.has_old_.load(std::memory_order_relaxed)) owner_.dropUnused();
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    const Value& operator*() const noexcept { return *value_; }

   private:
    ReadMostly& owner_;
    Phase& phase_;
    const Value* value_;
  };

  /// Replaces the value by what `change(value)` makes of it. Readers that are in it still see the
  /// old one. Old values are destroyed where nobody is inside, without a lock.
  template <class Change>
  void replace(Change change) {
    Old unused;
    const std::lock_guard<std::mutex> lock(mutex_);
    Version* const next = new Version{change(now_.load()->value), nullptr};
    Version* const last = now_.exchange(next);
    last->before = old_.first;
    old_.first = last;
    has_old_.store(true);
    takeUnused(unused);
  }

  /// Waits until all readers have left that were in when this was called. Must not be called by one
  /// of them.
  void waitForReaders() {
    Old unused;
    const std::lock_guard<std::mutex> phase_lock(phase_mutex_);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      std::swap(unused.first, old_.first);
      has_old_.store(false);
    }
    const std::uint64_t phase = phase_.load();
    waitUntilEmpty(phases_[(phase + 1) & 1]);  // those who were late when phases last changed
    phase_.store(phase + 1);
    waitUntilEmpty(phases_[phase & 1]);
  }

  /// A copy; it is not counted as a reading.
  Value copy() const {
    const std::lock_guard<std::mutex> lock(mutex_);  // the present value cannot become an old one
    return now_.load()->value;
  }

  /// How often it has been read.
  std::uint64_t readCount() const noexcept {
    return phases_[0].entered.load() + phases_[1].entered.load();
  }

 private:
  static void waitUntilEmpty(const Phase& phase) {
    for (int i = 0; !phase.isEmpty(); ++i) {
      if (i < 100) {
        std::this_thread::yield();
      } else {
        std::this_thread::sleep_for(std::chrono::microseconds(50));
      }
    }
  }

  GSLAM_COLD void dropUnused() {
    Old unused;
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) takeUnused(unused);
  }

  // With nobody inside, whoever comes sees the present value.
  void takeUnused(Old& unused) noexcept {
    if (!phases_[0].isEmpty() || !phases_[1].isEmpty()) return;
    std::swap(unused.first, old_.first);
    has_old_.store(false);
  }

  std::atomic<Version*> now_;
  std::atomic<std::uint64_t> phase_{0};
  Phase phases_[2];
  std::atomic<bool> has_old_{false};
  std::mutex phase_mutex_;    // guards the change of phases
  mutable std::mutex mutex_;  // guards old_, and those who replace
  Old old_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_READ_MOSTLY_H
