#ifndef GSLAM_CORE_RUN_H
#define GSLAM_CORE_RUN_H

#include <gslam/base/error.h>
#include <gslam/core/dataset.h>
#include <gslam/core/detail/exception_text.h>
#include <gslam/core/player.h>
#include <gslam/core/recorder.h>
#include <gslam/core/slam.h>
#include <gslam/core/slam_topics.h>
#include <gslam/messenger/messenger.h>
#include <gslam/svar/svar.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// @file
/// One run of a SLAM system on a dataset, from the first frame to the results.

namespace gslam {
inline namespace v1 {

/// What came of a run. A run that failed has what came before.
struct RunResult {
  PlayReport play;                 ///< how it ended
  std::vector<TrackedPose> poses;  ///< the last pose of each frame, by id
  Trajectory trajectory;           ///< those that mean something
  std::size_t invalid_poses = 0;   ///< poses that were not finite
  std::shared_ptr<const Map> map;  ///< at the end; null where there is none
};

/// What a run needs to know beyond the two that take part.
struct RunSetup {
  std::string name = "slam";  ///< of the SLAM system, the first part of its topics
  Svar parameters;            ///< for SlamSetup::parameters
  PlayOptions play;           ///< what to play, and how fast
  /// Is called with the poses so far when the last frame was played, before finish(), which may
  /// take long. May be empty.
  std::function<void(const RunResult&)> on_played;
};

namespace detail {

// Whether the SLAM system did it; else the report says what it threw.
template <class Call>
bool attempt(PlayReport& report, const Call& call) {
  try {
    call();
    return true;
  } catch (...) {
    report.end = PlayEnd::failed;
    report.failure = exceptionText();
    return false;
  }
}

inline void takePoses(const Recorder& recorder, RunResult& result) {
  result.poses = recorder.poses();
  result.trajectory = recorder.trajectory();
  result.invalid_poses = recorder.invalidCount();
}

}  // namespace detail

/// Configures a SLAM system, plays a dataset to it, finishes it, and keeps what it says.
/// @param slam       not configured yet
/// @param player     of the dataset, which another thread may stop
/// @param dataset    that the player plays
/// @param setup      the rest
/// @param messenger  that poses and maps are published on, as SlamTopics does
/// @throws as Player::play(), and what `on_played` throws. What the SLAM system throws is a result
inline RunResult runSlam(Slam& slam, Player& player, const Dataset& dataset, const RunSetup& setup,
                         const Messenger& messenger) {
  const Recorder recorder(setup.name, messenger);
  const SlamTopics topics(setup.name, messenger);
  RunResult result;
  const bool is_configured = detail::attempt(result.play, [&] {
    slam.configure(SlamSetup{setup.parameters, dataset.info().sensors, topics.inside()});
  });
  if (is_configured) {
    result.play = player.play(slam, setup.play);
    detail::takePoses(recorder, result);
    if (setup.on_played) setup.on_played(result);
  }
  if (result.play.end != PlayEnd::failed) {
    detail::attempt(result.play, [&] {
      slam.finish();
      result.map = slam.map();
    });
  }
  detail::takePoses(recorder, result);
  return result;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_RUN_H
