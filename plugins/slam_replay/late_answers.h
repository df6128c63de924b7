#ifndef GSLAM_PLUGINS_SLAM_REPLAY_LATE_ANSWERS_H
#define GSLAM_PLUGINS_SLAM_REPLAY_LATE_ANSWERS_H

#include <gslam/core.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace replay {

/// Publishes poses a while after they were handed over, from a thread of its own, in their order.
class LateAnswers {
 public:
  LateAnswers(gslam::Publisher<gslam::TrackedPose> publisher, std::chrono::nanoseconds latency);
  LateAnswers(const LateAnswers&) = delete;
  LateAnswers& operator=(const LateAnswers&) = delete;
  /// Those that wait are not published.
  ~LateAnswers();

  void add(const gslam::TrackedPose& pose);
  /// Waits until all were published.
  void wait();

 private:
  using Clock = std::chrono::steady_clock;
  void work();

  const gslam::Publisher<gslam::TrackedPose> publisher_;
  const std::chrono::nanoseconds latency_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<Clock::time_point, gslam::TrackedPose>> poses_;  // until they are published
  bool is_ending_ = false;
  std::thread thread_;  // last, since it uses all others
};

}  // namespace replay

#endif  // GSLAM_PLUGINS_SLAM_REPLAY_LATE_ANSWERS_H
