#ifndef GSLAM_CORE_PLAYER_H
#define GSLAM_CORE_PLAYER_H

#include <gslam/base/error.h>
#include <gslam/base/log.h>
#include <gslam/core/dataset.h>
#include <gslam/core/detail/exception_text.h>
#include <gslam/core/slam.h>
#include <gslam/core/slam_thread.h>
#include <gslam/messenger/messenger.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

/// @file
/// Plays a dataset to a SLAM system and to all who listen.

namespace gslam {
inline namespace v1 {

/// When the next frame goes out.
enum class Pace {
  every_frame,  ///< when all have handled this one: nothing is lost, and runs can be repeated
  real_time     ///< by its stamp: what the SLAM system is too late for is dropped, and counted
};

/// What to play, and how fast.
struct PlayOptions {
  Pace pace = Pace::every_frame;  ///< when the next frame goes out
  double speed = 1;               ///< of the clock, in real time
  std::size_t first = 0;          ///< index of the first frame; a live dataset begins where it is
  std::size_t count = std::numeric_limits<std::size_t>::max();  ///< most frames that are played
};

/// How playing ended.
enum class PlayEnd {
  finished,  ///< at the last frame
  stopped,   ///< by Player::stop()
  failed     ///< by an exception of the SLAM system or the dataset, or because 100 frames in a row
             ///< cannot be read
};

/// What came of playing.
struct PlayReport {
  PlayEnd end = PlayEnd::finished;  ///< how it ended
  std::string failure;              ///< what was thrown; else empty
  std::uint64_t played = 0;         ///< frames that were read and published
  std::uint64_t dropped = 0;        ///< of these, those the SLAM system was too late for
  std::uint64_t unreadable = 0;     ///< frames that could not be read
  std::uint64_t last_frame = 0;     ///< id of the last one that was played, or that it failed at
  double seconds = 0;               ///< it took, without pauses
};

/// What the player does, on "/run/status".
struct RunStatus {
  /// What it does.
  enum class State : std::uint8_t { playing, paused, finished, stopped, failed };
  State state = State::playing;   ///< now
  std::uint64_t frame = 0;        ///< frames played
  std::uint64_t frame_count = 0;  ///< of the dataset; 0: unknown
  std::string message;            ///< of a failure
};

/// Plays a dataset: hands each frame to a SLAM system, and publishes it for everyone else.
///
/// Topics, which cost next to nothing while nobody listens:
///
///     /sensor/frame        Frame
///     /sensor/imu          ImuSample, one by one
///     /sensor/gps          GnssSample, one by one
///     /sensor/groundtruth  StampedPose: T_world_body at the stamp of the frame
///     /run/status          RunStatus, latched
///
/// A frame is published before the SLAM system gets it. In Pace::every_frame the next one waits for
/// the SLAM system, and for subscribers that are synchronous or block the publisher.
///
/// play() runs in the thread that calls it; stop(), pause() and resume() may be called by any.
class Player {
 public:
  /// @param dataset    must outlive this; nobody else may use it meanwhile
  /// @param messenger  that the topics are published on
  Player(Dataset& dataset, const Messenger& messenger)
      : dataset_(dataset),
        frames_(messenger.advertise<Frame>("/sensor/frame")),
        imu_(messenger.advertise<ImuSample>("/sensor/imu")),
        gnss_(messenger.advertise<GnssSample>("/sensor/gps")),
        truth_(messenger.advertise<StampedPose>("/sensor/groundtruth")),
        status_(messenger.advertise<RunStatus>("/run/status", Latch::on)) {}
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Plays to the topics and to a SLAM system that is configured. finish() of it is left to the
  /// caller. What it throws is reported, not thrown on.
  /// @throws ArgumentError for a speed that is not positive or a first frame that is not there,
  ///   Error when the dataset cannot begin there
  PlayReport play(Slam& slam, const PlayOptions& options = PlayOptions()) {
    if (options.pace == Pace::every_frame) return playTo(&slam, nullptr, options);
    SlamThread thread(std::shared_ptr<Slam>(std::shared_ptr<Slam>(), &slam), 1,
                      WhenBusy::drop_oldest);
    return playTo(&thread, &thread, options);
  }

  /// Plays to the topics alone.
  /// @throws as play(Slam&, const PlayOptions&)
  PlayReport play(const PlayOptions& options = PlayOptions()) {
    return playTo(nullptr, nullptr, options);
  }

  /// Ends playing after the frame in work; a later play() ends at once.
  void stop() { command(true, false); }
  /// Stays at the frame in work.
  void pause() { command(false, true); }
  /// Goes on.
  void resume() { command(false, false); }

 private:
  using Clock = std::chrono::steady_clock;

  PlayReport playTo(Slam* slam, SlamThread* thread, const PlayOptions& options) {
    if (!(options.speed > 0) || !std::isfinite(options.speed)) {
      throw ArgumentError("speed",
                          "is " + std::to_string(options.speed) + ", expected a factor above 0");
    }
    if (options.first > 0 || !dataset_.info().is_live) dataset_.seek(options.first);
    PlayReport report;
    const Clock::time_point begin = Clock::now();
    paused_for_ = Clock::duration::zero();
    is_paced_ = false;
    try {
      playFrames(slam, options, report);
      if (thread != nullptr) thread->waitUntilIdle();
    } catch (...) {
      report.end = PlayEnd::failed;
      report.failure = detail::exceptionText();
      if (thread != nullptr) report.last_frame = thread->lastFrame();
    }
    if (thread != nullptr) report.dropped = thread->dropped();
    report.seconds = std::chrono::duration<double>(Clock::now() - begin - paused_for_).count();
    publishStatus(stateOf(report.end), report);
    return report;
  }

  void playFrames(Slam* slam, const PlayOptions& options, PlayReport& report) {
    for (std::size_t i = 0; i < options.count; ++i) {
      if (!mayGoOn(report)) return;
      const std::shared_ptr<const Frame> frame = readFrame(report);
      if (frame == nullptr) return;
      if (options.pace == Pace::real_time && !waitFor(frame->stamp, options.speed, report)) return;
      report.last_frame = frame->id;
      ++report.played;
      publish(frame);
      publishStatus(RunStatus::State::playing, report);
      if (slam != nullptr) slam->feed(frame);
    }
  }

  // The next frame that can be read; null behind the last.
  std::shared_ptr<const Frame> readFrame(PlayReport& report) {
    // A dataset that fails without going on must not hold us for ever.
    for (int failures = 0;; ++failures) {
      try {
        return dataset_.next();
      } catch (const Error& error) {
        ++report.unreadable;
        GSLAM_LOG(warning) << "a frame is left out: " << error.what();
        if (failures + 1 == kMostFailures) throw;
      }
    }
  }

  void publish(const std::shared_ptr<const Frame>& frame) {
    frames_.publish(frame);
    for (const ImuSample& sample : frame->imu) imu_.publish(sample);
    for (const GnssSample& sample : frame->gnss) gnss_.publish(sample);
    SE3d pose;
    if (dataset_.info().ground_truth.interpolate(frame->stamp, pose)) {
      truth_.publish(StampedPose{frame->stamp, pose});
    }
  }

  // Waits until the clock, which starts with the first frame, shows the stamp.
  bool waitFor(std::int64_t stamp, double speed, PlayReport& report) {
    if (!is_paced_) {
      is_paced_ = true;
      first_stamp_ = stamp;
      first_time_ = Clock::now() - paused_for_;
    }
    const double seconds = (double(stamp) - double(first_stamp_)) * 1e-9 / speed;
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      // Far stamps come from broken files; a wait of a year is as good as any.
      const double bounded = std::max(-3e7, std::min(3e7, seconds));
      const Clock::time_point due =
          first_time_ + paused_for_ +
          std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(bounded));
      if (!changed_.wait_until(lock, due, [this] { return is_stopped_ || is_paused_; }))
        return true;
      lock.unlock();
      if (!mayGoOn(report)) return false;
      lock.lock();
    }
  }

  // Waits while paused; false when stopped.
  bool mayGoOn(PlayReport& report) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (is_paused_ && !is_stopped_) {
      const Clock::time_point begin = Clock::now();
      lock.unlock();
      publishStatus(RunStatus::State::paused, report);
      lock.lock();
      changed_.wait(lock, [this] { return !is_paused_ || is_stopped_; });
      paused_for_ += Clock::now() - begin;
    }
    if (is_stopped_) report.end = PlayEnd::stopped;
    return !is_stopped_;
  }

  void command(bool stop, bool pause) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_stopped_ = is_stopped_ || stop;
      is_paused_ = pause;
    }
    changed_.notify_all();
  }

  void publishStatus(RunStatus::State state, const PlayReport& report) {
    RunStatus status;
    status.state = state;
    status.frame = report.played;
    status.frame_count = dataset_.info().frame_count;
    status.message = report.failure;
    status_.publish(std::move(status));
  }

  static RunStatus::State stateOf(PlayEnd end) noexcept {
    switch (end) {
      case PlayEnd::finished:
        return RunStatus::State::finished;
      case PlayEnd::stopped:
        return RunStatus::State::stopped;
      default:
        return RunStatus::State::failed;
    }
  }

  static constexpr int kMostFailures = 100;  // frames in a row that cannot be read

  Dataset& dataset_;
  Publisher<Frame> frames_;
  Publisher<ImuSample> imu_;
  Publisher<GnssSample> gnss_;
  Publisher<StampedPose> truth_;
  Publisher<RunStatus> status_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_stopped_ = false;
  bool is_paused_ = false;

  // Of the thread that plays.
  bool is_paced_ = false;
  std::int64_t first_stamp_ = 0;
  Clock::time_point first_time_;
  Clock::duration paused_for_ = Clock::duration::zero();
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_PLAYER_H
