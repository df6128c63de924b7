#ifndef GSLAM_PLUGINS_SLAM_REPLAY_LOSSES_H
#define GSLAM_PLUGINS_SLAM_REPLAY_LOSSES_H

#include <gslam/core/slam.h>

#include <cstdint>
#include <string>
#include <vector>

namespace replay {

/// How a frame is answered.
struct Answer {
  bool is_given = true;  ///< whether anything is said of it at all
  gslam::TrackingState state = gslam::TrackingState::tracking;
  bool is_finite = true;  ///< the pose
};

/// When tracking is not what it should be: "100-149, 200-209:guessed, 2.5s-3s:none". Intervals have
/// both ends in them; they are of Frame::id, or with an s of seconds since the first frame. What
/// stands behind the colon is lost (which it is without), guessed, starting, none (no answer), or
/// nan (tracking, with a pose that is not finite).
class Losses {
 public:
  Losses() = default;
  /// @throws ArgumentError that shows what is no interval
  explicit Losses(const std::string& text);

  /// @param frame  its id
  /// @param time   since the first frame, nanoseconds
  Answer answerTo(std::uint64_t frame, std::int64_t time) const;

 private:
  struct Interval {
    bool is_time;
    std::int64_t first, last;  // frames or nanoseconds
    Answer answer;
  };
  static Interval parse(const std::string& word);

  std::vector<Interval> intervals_;
};

}  // namespace replay

#endif  // GSLAM_PLUGINS_SLAM_REPLAY_LOSSES_H
