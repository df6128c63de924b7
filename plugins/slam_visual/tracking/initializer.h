#ifndef GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_INITIALIZER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_INITIALIZER_H

#include <gslam/core.h>

#include <memory>
#include <string>
#include <vector>

#include "matching/matcher.h"
#include "options.h"
#include "scene/world.h"

namespace visual {

/// Makes the first keyframes and points of an empty world.
///
/// With depth one frame is enough; the world begins at its body. A single camera needs two frames
/// with parallax: their relative pose is that of the essential matrix, or of the homography where
/// all is on one plane, whichever explains the matches (estimateRelativePose() chooses, and says
/// where two poses explain a plane equally well: then it waits). The world begins at the body of
/// the first one, and lengths are such that the median depth of its points is 1.
class Initializer {
 public:
  explicit Initializer(const Options& options);

  /// @param view    the next frame
  /// @param world   an empty one, which gets one or two keyframes
  /// @param reason  why there is no map yet, for people
  /// @return whether the world has begun; its newest keyframe is of this view then
  bool begin(const std::shared_ptr<const View>& view, World& world, std::string& reason);
  /// Forgets what it has seen.
  void reset();

 private:
  /// Matches of the reference frame with this one, whose points are certain.
  struct TwoViews {
    gslam::SE3d T_second_first;
    std::vector<FeaturePair> pairs;
    std::vector<gslam::Vec3d> points;  ///< of the pairs, first camera
  };
  bool beginWithDepth(const std::shared_ptr<const View>& view, World& world, std::string& reason);
  bool beginWithMotion(const std::shared_ptr<const View>& view, World& world, std::string& reason);
  std::vector<FeaturePair> matchReference(const View& view) const;
  bool reconstruct(const View& view, const Eye& eye, const std::vector<FeaturePair>& pairs,
                   TwoViews& result, std::string& reason) const;
  bool build(const std::shared_ptr<const View>& view, const TwoViews& views, World& world) const;

  Options options_;
  std::shared_ptr<const View> reference_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_INITIALIZER_H
