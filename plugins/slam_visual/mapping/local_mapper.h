#ifndef GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_LOCAL_MAPPER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_LOCAL_MAPPER_H

#include <gslam/core.h>

#include <vector>

#include "mapping/bundle.h"
#include "mapping/triangulator.h"
#include "matching/matcher.h"
#include "options.h"
#include "scene/world.h"
#include "tracking/tracker.h"

namespace visual {

/// Adds what is close to a view and has no point yet, nearest first: all that is within reach of
/// its depth, or the nearest 100.
/// @param added  the new points, appended
void addPointsFromDepth(World& world, gslam::KeyframeId id, std::vector<gslam::PointId>& added);

/// Lets the world grow by one keyframe after the other. It changes the world; one thread calls it.
class LocalMapper {
 public:
  explicit LocalMapper(const Options& options);

  /// A world in which one or two keyframes were put by somebody else: their points are recent.
  void begin(const World& world);
  /// Adds a keyframe, with points from its depth.
  gslam::KeyframeId add(World& world, const KeyframeRequest& request);
  /// Removes points that were not confirmed, adds those that the keyframe and its neighbours see,
  /// merges those that are there twice, adjusts what is around, and removes keyframes that say
  /// nothing new.
  /// @param removed  keyframes that are no more, appended
  void improve(World& world, gslam::KeyframeId id, std::vector<gslam::KeyframeId>& removed);
  /// The same without the part that takes long, for when more keyframes wait.
  void improveLittle(World& world, gslam::KeyframeId id);

 private:
  void growAround(World& world, gslam::KeyframeId id);
  void cullPoints(World& world);
  void triangulate(World& world, gslam::KeyframeId id);
  void fuse(World& world, gslam::KeyframeId id);
  void fuseInto(World& world, gslam::KeyframeId id, const std::vector<gslam::PointId>& points);
  void adjust(World& world, gslam::KeyframeId id);
  void cullKeyframes(World& world, gslam::KeyframeId id, std::vector<gslam::KeyframeId>& removed);

  Options options_;
  Triangulator triangulator_;
  ProjectionMatcher projector_;
  Bundle bundle_;
  std::vector<gslam::PointId> recent_;
  std::vector<SoughtPoint> sought_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_LOCAL_MAPPER_H
