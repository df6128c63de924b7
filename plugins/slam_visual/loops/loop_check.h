#ifndef GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_CHECK_H
#define GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_CHECK_H

#include <gslam/core.h>

#include <vector>

#include "matching/matcher.h"

namespace visual {

/// How a keyframe is seen from the place where it was before.
struct LoopGeometry {
  gslam::KeyframeId here;
  gslam::KeyframeId there;
  gslam::SE3d T_world_body;  ///< of `here`, from the points of the old place
  double scale;              ///< of lengths there in lengths here

  gslam::SIM3d S_there_here(const Scene& scene) const;
};

/// Asks those who did not take part: do the points that `here` has itself, of what it sees of the
/// old place, look right to the keyframes of that place? For a single camera their distances say
/// the scale, too. And can what was measured on the way be as wrong as the loop says?
/// @param place    keyframes of the old place
/// @param matches  features of `here` that see points of the old place, and fit the pose
/// @param loop     without a scale; gets it
bool checkLoop(const Scene& scene, const std::vector<gslam::KeyframeId>& place,
               const std::vector<Match>& matches, LoopGeometry& loop);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_CHECK_H
