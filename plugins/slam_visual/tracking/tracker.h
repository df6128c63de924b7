#ifndef GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_TRACKER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_TRACKER_H

#include <gslam/core.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "matching/pose_fitter.h"
#include "options.h"
#include "tracking/local_map.h"
#include "tracking/relocalizer.h"

namespace visual {

/// What became of a frame.
struct Tracked {
  gslam::TrackingState state = gslam::TrackingState::lost;
  std::string reason;  ///< why it is lost, for people
  gslam::SE3d T_world_body;
  gslam::KeyframeId reference{};  ///< the keyframe that sees most of what it sees
  gslam::SE3d T_reference_body;   ///< so the pose stays right when the reference moves
  double stretch = 1;             ///< of the reference at that time
  std::vector<Match> matches;     ///< features that see points
  bool is_keyframe_due = false;
};

/// What a keyframe is made of, and what was learnt of points since the last one.
struct KeyframeRequest {
  std::shared_ptr<const View> view;
  gslam::SE3d T_world_body;
  gslam::KeyframeId reference{};
  gslam::SE3d T_reference_body;
  double stretch = 1;  ///< of the reference at that time
  std::vector<Match> matches;
  std::vector<gslam::PointId> expected;  ///< points that should have been seen, once for each time
  std::vector<gslam::PointId> found;     ///< and those that were
};

/// Follows the camera from frame to frame through a scene that it does not change.
///
/// Motion is predicted to go on; points of the frame before are searched where they should be then,
/// or else those of the reference keyframe by descriptors alone, or else the place is searched
/// among all. Then the points around are searched, and the pose is that which explains all of them.
class Tracker {
 public:
  Tracker(const Options& options, Relocalizer& relocalizer);

  /// Begins in a scene with one or more keyframes, of which the newest was made from `view`.
  /// @return what became of the frame: the pose of its keyframe
  Tracked begin(const std::shared_ptr<const View>& view, const Scene& scene);
  /// @param is_mapper_idle  a keyframe would be handled at once
  Tracked track(const std::shared_ptr<const View>& view, const Scene& scene, bool is_mapper_idle);
  /// Of the frame that was tracked last, whose keyframe is due.
  KeyframeRequest takeKeyframe();

 private:
  void recallLast(const Scene& scene);
  bool follow(const View& view, const Scene& scene);
  bool followLast(const View& view, const Scene& scene, double window);
  bool followReference(const View& view, const Scene& scene);
  bool findAgain(const View& view, const Scene& scene);
  bool followMap(const View& view, const Scene& scene);
  bool isKeyframeDue(const View& view, const Scene& scene, bool is_mapper_idle);
  Tracked keep(const std::shared_ptr<const View>& view, const Scene& scene, bool is_mapper_idle);

  Options options_;
  Relocalizer& relocalizer_;
  ProjectionMatcher projector_;
  PoseFitter fitter_;
  LocalMap local_map_;

  // Of this frame
  gslam::SE3d T_world_body_;
  std::vector<Match> matches_;
  std::vector<SoughtPoint> sought_;

  // Of the frame before
  std::shared_ptr<const View> last_;
  std::vector<Match> last_matches_;
  gslam::KeyframeId reference_{};
  gslam::SE3d T_reference_last_;
  double reference_stretch_ = 1;
  gslam::SE3d T_world_last_;
  gslam::SE3d T_last_next_;  // the motion that is expected
  bool is_lost_ = false;
  int frames_lost_ = 0;
  int frames_since_keyframe_ = 0;
  std::size_t most_seen_ = 0;      // points, since the last keyframe
  int frames_since_found_ = 1000;  // after it was lost
  std::size_t found_by_ = 0;       // matches
  std::vector<gslam::PointId> expected_, found_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_TRACKER_H
