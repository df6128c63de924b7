#ifndef GSLAM_CORE_SLAM_H
#define GSLAM_CORE_SLAM_H

#include <gslam/core/frame.h>
#include <gslam/core/map.h>
#include <gslam/core/rig.h>
#include <gslam/geometry/se3.h>
#include <gslam/messenger/messenger.h>
#include <gslam/svar/svar.h>

#include <cstdint>
#include <memory>

/// @file
/// What a SLAM system is to those who use one.

namespace gslam {
inline namespace v1 {

/// How sure a SLAM system is of a pose.
enum class TrackingState : std::uint8_t {
  starting,  ///< there is no map yet; the pose means nothing
  tracking,  ///< the pose is what the sensors say
  guessed,   ///< the pose is from a model of motion or inertia alone
  lost       ///< the pose means nothing
};

/// Its name, such as "tracking"; "unknown" for a number that is no state.
inline const char* trackingStateName(TrackingState state) noexcept {
  static const char* const kNames[] = {"starting", "tracking", "guessed", "lost"};
  const std::size_t i = static_cast<std::size_t>(state);
  return i < 4 ? kNames[i] : "unknown";
}

/// Whether the pose of that state means something.
inline bool hasPose(TrackingState state) noexcept {
  return state == TrackingState::tracking || state == TrackingState::guessed;
}

/// Where the body was at a frame, as a SLAM system says right after it saw it.
struct TrackedPose {
  std::uint64_t frame;  ///< Frame::id
  std::int64_t stamp;   ///< Frame::stamp, nanoseconds
  SE3d T_world_body;    ///< metres
  TrackingState state;  ///< whether it means anything
};

static_assert(sizeof(TrackedPose) == 80, "poses cross plugin borders");

/// What a SLAM system is given before its first frame.
struct SlamSetup {
  Svar parameters;      ///< those of SlamInfo::parameters, with the values the user wants
  SensorRig sensors;    ///< of the dataset
  Messenger messenger;  ///< its own: for its topics, without those of the dataset
};

/// A SLAM system: one class to write, four functions.
///
///     class Mine : public gslam::Slam {
///       void configure(const SlamSetup& setup) override {
///         pose_ = setup.messenger.advertise<TrackedPose>("pose");
///       }
///       void feed(const std::shared_ptr<const Frame>& frame) override {
///         pose_.publish({frame->id, frame->stamp, track(*frame), state_});
///       }
///       ...
///
/// **Threads.** One thread at a time calls it; SlamThread gives it a thread of its own. It may have
/// threads inside, which are idle again when finish() returns.
///
/// **Frames** are handed over, not lent: what is needed later is kept by keeping the pointer. They
/// are never changed.
///
/// **Topics** of the messenger it is given: it publishes a TrackedPose on "pose" for each frame, in
/// feed() or later, and may publish a `Map` on "map" and whatever else it likes on others.
///
/// **Errors** are thrown from any function; the run is over then.
class Slam {
 public:
  virtual ~Slam() = default;

  /// Is called once, before all others.
  virtual void configure(const SlamSetup& setup) = 0;

  /// Takes the next frame, by id and stamp. What it returns from is done: who wants frames to be
  /// handled one by one waits for it.
  virtual void feed(const std::shared_ptr<const Frame>& frame) = 0;

  /// The map as it is, which does not change any more; null where the system has none. It, and
  /// what find() and the like give of it, live as long as the pointer is kept.
  virtual std::shared_ptr<const Map> map() = 0;

  /// No frame comes any more: ends what is still in work, such as a last optimization. map() may
  /// be called after it.
  virtual void finish() = 0;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_SLAM_H
