#ifndef GSLAM_APPS_WATCHED_SLAM_H
#define GSLAM_APPS_WATCHED_SLAM_H

#include <gslam/core.h>
#include <gslam/evaluation/frame_times.h>

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "frame_log.h"
#include "live_trajectory.h"
#include "run_board.h"

namespace app {

/// What the results of a run are written to while it goes on.
struct RunRecorders {
  RunBoard& board;
  LiveTrajectory& live;
  FrameLog& frames;
};

/// Why a call failed, from the exception in work: "exception", or of an isolated system "signal",
/// "exit", "timeout", "memory", "garbage" (it sent what is no answer), "lost" (it is gone, nobody
/// knows how).
std::string causeOfException();

/// A SLAM system around one that is measured: writes its poses, what became of its frames, and on
/// the board where it is. What comes in the thread of feed() is written when that has returned, so
/// that writing is not measured; what other threads publish, at once.
class WatchedSlam : public gslam::Slam {
 public:
  /// @param slam       that is watched
  /// @param tree       whose processes are measured
  /// @param recorders  outlive it
  WatchedSlam(std::shared_ptr<gslam::Slam> slam, std::shared_ptr<gslam::ProcessTree> tree,
              const RunRecorders& recorders);

  void configure(const gslam::SlamSetup& setup) override;
  void feed(const std::shared_ptr<const gslam::Frame>& frame) override;
  std::shared_ptr<const gslam::Map> map() override;
  void finish() override;

  /// Notes a frame that was played: its time begins, and those that are not fed before a later one
  /// were dropped.
  void notePlayed(const gslam::Frame& frame);
  /// No frame comes any more: those that were played and not fed were dropped. Lines of frames
  /// whose poses were published again are written again.
  void end();

  const gslam::MeasuredSlam& measured() const { return measured_; }
  /// What made a call fail, as causeOfException() says; empty: none did.
  const std::string& cause() const { return cause_; }

 private:
  template <class Call>
  void watch(RunPhase phase, const Call& call);
  void write(const gslam::TrackedPose& pose);
  void takePose(const gslam::TrackedPose& pose);
  void takeFrame(const gslam::FrameTime& frame);
  void writeWaiting();
  bool isInside() const { return feeder_ == std::this_thread::get_id(); }

  const RunRecorders recorders_;
  gslam::MeasuredSlam measured_;
  std::string cause_;
  std::atomic<std::thread::id> feeder_{};  // that is in feed(); else none
  // What waits for the end of feed().
  std::mutex mutex_;
  std::vector<gslam::TrackedPose> poses_;
  std::vector<gslam::FrameTime> frames_;
  gslam::Subscriber subscriber_;  // last: ends before the rest goes
};

/// A dataset around another: notes frames that cannot be read.
class WatchedDataset : public gslam::Dataset {
 public:
  WatchedDataset(std::unique_ptr<gslam::Dataset> dataset, FrameLog& frames)
      : dataset_(std::move(dataset)), frames_(frames) {}
  const gslam::DatasetInfo& info() const override { return dataset_->info(); }
  std::shared_ptr<const gslam::Frame> next() override;
  void seek(std::size_t index) override { dataset_->seek(index); }

 private:
  const std::unique_ptr<gslam::Dataset> dataset_;
  FrameLog& frames_;
};

}  // namespace app

#endif  // GSLAM_APPS_WATCHED_SLAM_H
