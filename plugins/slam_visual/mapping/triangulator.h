#ifndef GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_TRIANGULATOR_H
#define GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_TRIANGULATOR_H

#include <gslam/core.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "matching/descriptors.h"
#include "scene/world.h"

namespace visual {

/// Finds new points that two keyframes see. Keeps its memory from one pair to the next.
class Triangulator {
 public:
  /// Matches features that see no point along epipolar lines, and adds the points whose place is
  /// certain: parallax (or depth that was measured), in front of both, where both see them, of the
  /// size that both see.
  /// @param added  the new points, appended
  void addPoints(World& world, gslam::KeyframeId first, gslam::KeyframeId second,
                 std::vector<gslam::PointId>& added);

 private:
  /// The features of a keyframe that see no point, with their directions.
  struct Free {
    std::vector<std::uint32_t> features;
    std::vector<gslam::Vec3d> bearings;
    std::vector<float> x, y, z;  // the same, for the kernel
    std::vector<float> slack;    // sine of the angle by which each may be off
  };
  struct Pair {
    std::uint32_t first, second;  // places in Free
    float distance;
  };
  static void collect(const Scene& scene, gslam::KeyframeId id, Free& free);
  void match(const Scene& scene, gslam::KeyframeId first, gslam::KeyframeId second);

  Free first_, second_;
  std::vector<Pair> pairs_;
  std::vector<float> off_, distances_;
  std::vector<std::uint32_t> near_, rows_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_TRIANGULATOR_H
