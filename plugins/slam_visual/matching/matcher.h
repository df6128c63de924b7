#ifndef GSLAM_PLUGINS_SLAM_VISUAL_MATCHING_MATCHER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_MATCHING_MATCHER_H

#include <gslam/core.h>

#include <cstdint>
#include <vector>

#include "matching/descriptors.h"
#include "scene/scene.h"

namespace visual {

/// A feature of a view that sees a point of the map.
struct Match {
  std::uint32_t feature;
  gslam::PointId point;
  float distance;  ///< of their descriptors
};

/// When two descriptors match.
struct MatchRules {
  float most = kLooseDistance;  ///< distance
  float ratio = 1;  ///< of the distances of the nearest and the second nearest: less than this
};

/// Two features of two views.
struct FeaturePair {
  std::uint32_t first;
  std::uint32_t second;
};

/// Pairs that are each other's nearest, by descriptors alone.
/// @param first, second             descriptors, one a row
/// @param first_rows, second_rows   those that count
std::vector<FeaturePair> matchDescriptors(const gslam::Image& first,
                                          gslam::Span<const std::uint32_t> first_rows,
                                          const gslam::Image& second,
                                          gslam::Span<const std::uint32_t> second_rows,
                                          const MatchRules& rules);

/// Keeps the pairs that turn by about the same angle from one image to the other, as all do where a
/// camera rolls.
void keepCommonTurn(const std::vector<gslam::Feature>& first,
                    const std::vector<gslam::Feature>& second, std::vector<FeaturePair>& pairs);

/// Features of a view that see points of a keyframe, by descriptors alone: for places that were
/// not expected.
std::vector<Match> matchKeyframe(const View& view, const Scene& scene, gslam::KeyframeId keyframe,
                                 const MatchRules& rules);

/// A point that is looked for.
struct SoughtPoint {
  gslam::PointId id;
  gslam::Vec3d position;           ///< world
  const std::uint8_t* descriptor;  ///< lives in the map
  int level;                       ///< of the pyramid on which it should be
  double window;                   ///< pixels around where it should be, on that level
};

/// Looks for points where they should be. Keeps its memory from one call to the next.
class ProjectionMatcher {
 public:
  /// @param view            where to look
  /// @param eye             that took it
  /// @param T_camera_world  from where
  /// @param points          what is looked for
  /// @param rules           the ratio counts against candidates of the same level only
  /// @param taken           features that are not to be used, one number each, not 0; or empty
  /// @return one feature a point and one point a feature, by feature
  const std::vector<Match>& match(const View& view, const Eye& eye,
                                  const gslam::SE3d& T_camera_world,
                                  gslam::Span<const SoughtPoint> points, const MatchRules& rules,
                                  gslam::Span<const std::uint8_t> taken = {});

 private:
  std::vector<Match> matches_, best_of_feature_;
  std::vector<std::uint32_t> near_, candidates_;
  std::vector<float> distances_;
};

/// The points of a list that a camera can be expected to see: in the image, in their range of
/// distances, not from behind; with the level on which they should be.
/// @param window  pixels; it is wider for those that are seen from another side
/// @param sought  results, appended
void findVisible(const Scene& scene, const gslam::SE3d& T_camera_world,
                 gslam::Span<const gslam::PointId> points, double window,
                 std::vector<SoughtPoint>& sought);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_MATCHING_MATCHER_H
