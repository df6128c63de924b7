#include "late_answers.h"

namespace replay {

LateAnswers::LateAnswers(gslam::Publisher<gslam::TrackedPose> publisher,
                         std::chrono::nanoseconds latency)
    : publisher_(std::move(publisher)), latency_(latency), thread_([this] { work(); }) {}

LateAnswers::~LateAnswers() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void LateAnswers::add(const gslam::TrackedPose& pose) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    poses_.emplace_back(Clock::now() + latency_, pose);
  }
  changed_.notify_all();
}

void LateAnswers::wait() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return poses_.empty(); });
}

void LateAnswers::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ending_ || !poses_.empty(); });
    if (is_ending_) return;
    const auto next = poses_.front();
    if (changed_.wait_until(lock, next.first, [this] { return is_ending_; })) return;
    lock.unlock();
    publisher_.publish(next.second);
    lock.lock();
    poses_.pop_front();
    changed_.notify_all();
  }
}

}  // namespace replay
