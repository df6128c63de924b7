#ifndef GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_CLOSER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_CLOSER_H

#include <gslam/core.h>

#include <string>
#include <vector>

#include "loops/loop_detector.h"
#include "options.h"
#include "scene/world.h"

namespace visual {

/// What closing a loop did.
struct LoopReport {
  bool is_closed = false;  ///< else the world is as it was
  std::size_t merged = 0;  ///< points that were there twice
  double moved = 0;        ///< metres by which the newest keyframe was moved
  double stretched = 1;    ///< lengths around it are so many times what they were
  std::string optimizer;   ///< a line on the pose graph
};

/// Bends the map so that both ends of a loop meet: merges the points that are there twice, adds the
/// edge, and optimises the graph of poses (SIM3 for a single camera without depth, else SE3), with
/// points carried along by the keyframe that saw them first.
LoopReport closeLoop(World& world, const Loop& loop, const Options& options);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_CLOSER_H
