#ifndef GSLAM_CORE_SLAM_THREAD_H
#define GSLAM_CORE_SLAM_THREAD_H

#include <gslam/base/error.h>
#include <gslam/core/detail/merge_samples.h>
#include <gslam/core/slam.h>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

/// @file
/// A SLAM system in a thread of its own.

namespace gslam {
inline namespace v1 {

/// What SlamThread::feed() does while as many frames wait as may.
enum class WhenBusy {
  wait,        ///< until one of them is taken
  drop_oldest  ///< the one that waited longest; its inertial and satellite samples go to the next
};

/// Runs a SLAM system in a thread of its own: feed() returns before the frame is handled. All calls
/// of the system come from that thread.
///
/// What the system throws in feed() ends its work: frames that wait or come later are not handled,
/// and each call but the destructor throws it again.
///
/// One thread at a time may call it, as any Slam; dropped() and isIdle() may be called by others.
class SlamThread : public Slam {
 public:
  /// @param slam       the system, not configured yet
  /// @param room       frames that may wait, 1 or more
  /// @param when_busy  what happens when as many wait
  /// @throws ArgumentError when slam is null or room is 0
  explicit SlamThread(std::shared_ptr<Slam> slam, std::size_t room = 1,
                      WhenBusy when_busy = WhenBusy::wait)
      : slam_(std::move(slam)), room_(room), when_busy_(when_busy) {
    if (slam_ == nullptr) throw ArgumentError("slam", "is null, expected a SLAM system");
    if (room_ == 0) throw ArgumentError("room", "is 0, expected room for 1 frame or more");
    thread_ = std::thread([this] { work(); });
  }
  SlamThread(const SlamThread&) = delete;
  SlamThread& operator=(const SlamThread&) = delete;
  /// Ends after the frame in work; those that wait are not handled.
  ~SlamThread() override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_ending_ = true;
      frames_.clear();
    }
    changed_.notify_all();
    thread_.join();
  }

  /// As Slam, and waits for it.
  void configure(const SlamSetup& setup) override {
    call([&] { slam_->configure(setup); });
  }

  /// Puts the frame into the queue.
  void feed(const std::shared_ptr<const Frame>& frame) override {
    if (frame == nullptr) throw ArgumentError("frame", "is null");
    {
      std::unique_lock<std::mutex> lock(mutex_);
      if (when_busy_ == WhenBusy::wait) {
        changed_.wait(lock, [this] { return frames_.size() < room_ || error_ != nullptr; });
      }
      if (error_ != nullptr) ++dropped_;
      rethrow();
      std::shared_ptr<const Frame> added = frame;
      while (frames_.size() >= room_) {
        std::shared_ptr<const Frame>& heir = frames_.size() > 1 ? frames_[1] : added;
        heir = detail::withSamplesBefore(*frames_.front(), heir);
        frames_.pop_front();
        ++dropped_;
      }
      frames_.push_back(std::move(added));
    }
    changed_.notify_all();
  }

  /// The map when all frames that were fed are handled.
  std::shared_ptr<const Map> map() override {
    std::shared_ptr<const Map> map;
    call([&] { map = slam_->map(); });
    return map;
  }

  /// When all frames that were fed are handled.
  void finish() override {
    call([&] { slam_->finish(); });
  }

  /// Waits until all frames that were fed are handled.
  void waitUntilIdle() {
    call([] {});
  }

  /// Whether no frame waits or is in work.
  bool isIdle() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return frames_.empty() && !is_busy_;
  }

  /// Id of the last frame that the system was given.
  std::uint64_t lastFrame() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_frame_;
  }

  /// Frames that were dropped, also because the system failed before them.
  std::uint64_t dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  // Runs a function in the thread, after the frames that wait.
  void call(const std::function<void()>& function) {
    std::unique_lock<std::mutex> lock(mutex_);
    rethrow();
    call_ = &function;
    changed_.notify_all();
    changed_.wait(lock, [this] { return call_ == nullptr; });
    rethrow();
  }

  void rethrow() const {
    if (error_ != nullptr) std::rethrow_exception(error_);
  }

  void work() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return is_ending_ || call_ != nullptr || !frames_.empty(); });
      if (!frames_.empty()) {
        const std::shared_ptr<const Frame> frame = std::move(frames_.front());
        frames_.pop_front();
        last_frame_ = frame->id;
        perform(lock, [&] { slam_->feed(frame); });
      } else if (call_ != nullptr) {
        perform(lock, *call_);
        call_ = nullptr;
      } else {
        return;
      }
      changed_.notify_all();
    }
  }

  // Does a piece of work without the lock, unless one before it failed.
  template <class Work>
  void perform(std::unique_lock<std::mutex>& lock, const Work& work) {
    if (error_ != nullptr) return;
    is_busy_ = true;
    lock.unlock();
    std::exception_ptr error;
    try {
      work();
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    is_busy_ = false;
    error_ = error;
    if (error_ == nullptr) return;
    dropped_ += frames_.size();
    frames_.clear();
  }

  const std::shared_ptr<Slam> slam_;
  const std::size_t room_;
  const WhenBusy when_busy_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<const Frame>> frames_;
  const std::function<void()>* call_ = nullptr;
  std::exception_ptr error_;
  std::uint64_t dropped_ = 0;
  std::uint64_t last_frame_ = 0;
  bool is_busy_ = false;
  bool is_ending_ = false;

  std::thread thread_;  // last, since it uses all others
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_SLAM_THREAD_H
