#include "watched_slam.h"

#include <gslam/base/error.h>
#include <gslam/core/isolated_slam.h>

#include <new>

namespace app {
namespace {

std::string causeOf(const gslam::IsolationFailure& failure) {
  using Kind = gslam::IsolationFailure::Kind;
  switch (failure.kind) {
    case Kind::signal:
      return "signal";
    case Kind::exit:
      return "exit";
    case Kind::timeout:
      return "timeout";
    case Kind::out_of_memory:
      return "memory";
    case Kind::garbage:
      return "garbage";
    default:
      return "lost";
  }
}

}  // namespace

std::string causeOfException() {
  try {
    throw;
  } catch (const gslam::IsolationError& error) {
    return causeOf(error.failure());
  } catch (const std::bad_alloc&) {
    return "memory";
  } catch (const gslam::Error& error) {
    // What an isolated system throws arrives as its text.
    return std::string(error.what()).find("bad_alloc") == std::string::npos ? "exception"
                                                                            : "memory";
  } catch (...) {
    return "exception";
  }
}

WatchedSlam::WatchedSlam(std::shared_ptr<gslam::Slam> slam,
                         std::shared_ptr<gslam::ProcessTree> tree, const RunRecorders& recorders)
    : recorders_(recorders),
      measured_(std::move(slam),
                {std::move(tree), [this](const gslam::FrameTime& frame) { takeFrame(frame); }}) {
  poses_.reserve(1024);  // so that taking a pose allocates nothing
  frames_.reserve(16);
}

template <class Call>
void WatchedSlam::watch(RunPhase phase, const Call& call) {
  recorders_.board.enter(phase);
  try {
    call();
  } catch (...) {
    cause_ = causeOfException();
    recorders_.board.enter(RunPhase::waiting);
    throw;
  }
  recorders_.board.enter(RunPhase::waiting);
}

// Subscribes behind what measures, so that writing is not measured.
void WatchedSlam::configure(const gslam::SlamSetup& setup) {
  watch(RunPhase::configuring, [&] {
    measured_.configure(setup);
    subscriber_ = setup.messenger.subscribe<gslam::TrackedPose>(
        "pose", [this](const gslam::TrackedPose& pose) { takePose(pose); });
  });
}

void WatchedSlam::feed(const std::shared_ptr<const gslam::Frame>& frame) {
  recorders_.live.expect(*frame);
  recorders_.board.frame = frame->id;
  recorders_.board.has_frame = true;
  feeder_ = std::this_thread::get_id();
  try {
    watch(RunPhase::feeding, [&] { measured_.feed(frame); });
  } catch (...) {
    writeWaiting();
    throw;
  }
  writeWaiting();
}

std::shared_ptr<const gslam::Map> WatchedSlam::map() {
  std::shared_ptr<const gslam::Map> map;
  watch(RunPhase::mapping, [&] { map = measured_.map(); });
  return map;
}

void WatchedSlam::finish() {
  watch(RunPhase::finishing, [&] { measured_.finish(); });
}

void WatchedSlam::notePlayed(const gslam::Frame& frame) {
  measured_.noteDelivered(frame.id, frame.stamp);
}

void WatchedSlam::end() {
  measured_.dropWaiting();
  for (const gslam::FrameTime& frame : measured_.frames()) {
    if (frame.corrections > 0) recorders_.frames.add(frame);
  }
}

void WatchedSlam::write(const gslam::TrackedPose& pose) {
  recorders_.live.add(pose);
  recorders_.board.invalid_poses = recorders_.live.invalidCount();
  recorders_.board.wrong_stamps = recorders_.live.wrongStamps();
}

// Behind those that wait, so that they stay in order.
void WatchedSlam::takePose(const gslam::TrackedPose& pose) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (isInside() || !poses_.empty()) {
    poses_.push_back(pose);
  } else {
    write(pose);
  }
}

// The last that is written of a frame counts: what waits must not be older than what is written.
void WatchedSlam::takeFrame(const gslam::FrameTime& frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (gslam::FrameTime& waiting : frames_) {
    if (waiting.frame != frame.frame) continue;
    waiting = frame;
    return;
  }
  if (isInside()) {
    frames_.push_back(frame);
  } else {
    recorders_.frames.add(frame);
  }
}

void WatchedSlam::writeWaiting() {
  const std::lock_guard<std::mutex> lock(mutex_);
  feeder_ = std::thread::id();
  for (const gslam::TrackedPose& pose : poses_) write(pose);
  for (const gslam::FrameTime& frame : frames_) recorders_.frames.add(frame);
  poses_.clear();
  frames_.clear();
}

std::shared_ptr<const gslam::Frame> WatchedDataset::next() {
  try {
    return dataset_->next();
  } catch (const gslam::Error&) {
    frames_.addUnreadable();
    throw;
  }
}

}  // namespace app
