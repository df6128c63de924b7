#ifndef GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_BUNDLE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_BUNDLE_H

#include <gslam/core.h>
#include <gslam/optimizer/bundle_problem.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "options.h"
#include "scene/scene.h"

namespace visual {

/// A part of a scene as a bundle adjustment has it. Keeps its memory from one to the next.
class Bundle {
 public:
  /// @param moving  keyframes whose poses are variables; the first keyframe of all stays where it
  /// is
  /// @param points  that are variables; keyframes that see them, but are not moving, are fixed
  void gather(const Scene& scene, gslam::Span<const gslam::KeyframeId> moving,
              gslam::Span<const gslam::PointId> points);

  /// Optimises with a robust loss, takes out what does not fit, and optimises again.
  /// @param iterations  of each; the second time twice as many
  /// @return whether poses and points are better than before
  bool adjust(const Scene& scene, const Options& options, std::size_t iterations = 5);

  std::size_t movingCount() const noexcept { return moving_count_; }
  gslam::KeyframeId keyframe(std::size_t i) const noexcept { return keyframes_[i]; }
  const gslam::SE3d& T_world_body(std::size_t i) const noexcept { return poses_[i]; }
  const std::vector<gslam::PointId>& points() const noexcept { return points_; }
  const gslam::Vec3d& position(std::size_t i) const noexcept { return positions_[i]; }
  /// Observations that do not fit, after adjust().
  const std::vector<gslam::Observation>& outliers() const noexcept { return outliers_; }
  const std::string& report() const noexcept { return report_; }

 private:
  std::uint32_t indexOf(gslam::KeyframeId id);
  bool solve(const Scene& scene, const Options& options, std::size_t iterations);
  void dropOutliers(const Scene& scene);

  std::size_t moving_count_ = 0;
  std::vector<gslam::KeyframeId> keyframes_;  // the moving ones first
  std::vector<std::uint32_t> index_of_;       // by keyframe; kNone
  std::vector<gslam::SE3d> poses_;
  std::vector<std::uint8_t> fixed_;
  std::vector<gslam::PointId> points_;
  std::vector<gslam::Vec3d> positions_;
  std::vector<std::uint32_t> of_pose_, of_point_;
  std::vector<gslam::Vec2d> pixels_;
  std::vector<gslam::Vec3d> information_;
  std::vector<double> right_;
  std::vector<gslam::Observation> observations_, outliers_;
  std::string report_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_BUNDLE_H
