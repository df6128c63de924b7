#ifndef GSLAM_PLUGINS_SLAM_VISUAL_MATCHING_POSE_FITTER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_MATCHING_POSE_FITTER_H

#include <gslam/core.h>

#include <cstdint>
#include <vector>

#include "matching/matcher.h"

namespace visual {

/// 95 % of squared errors of a pixel, and of a pixel with its place in the second camera, are below
/// these, in variances.
constexpr double kChi2Pixel = 5.991;
constexpr double kChi2Stereo = 7.815;

/// The squared error of a feature that sees a point, in variances; infinite where the point is
/// behind the camera or the camera does not see it.
double squaredError(const Eye& eye, const View& view, std::uint32_t feature,
                    const gslam::Vec3d& point_in_camera);
/// Whether it is small enough for an inlier.
bool fits(const Eye& eye, const View& view, std::uint32_t feature,
          const gslam::Vec3d& point_in_camera);

/// Finds the pose of a view from its matches. Keeps its memory from one call to the next.
class PoseFitter {
 public:
  /// Refines a pose that is near, and leaves out what does not fit.
  /// @param matches       those that do not fit are removed
  /// @param T_world_body  start and result
  /// @return whether there is a pose: at least 10 matches fit it
  bool refine(const View& view, const Scene& scene, std::vector<Match>& matches,
              gslam::SE3d& T_world_body);
  /// Finds a pose of which nothing is known, by samples of three matches, and refines it.
  /// @param matches       those that do not fit are removed
  /// @param seed          of the samples
  /// @param T_world_body  result
  /// @return whether there is one
  bool find(const View& view, const Scene& scene, std::vector<Match>& matches, std::uint64_t seed,
            gslam::SE3d& T_world_body);

 private:
  void gather(const View& view, const Scene& scene, const std::vector<Match>& matches);
  gslam::Span<const double> weights(const std::vector<std::uint8_t>& fitting);

  std::vector<gslam::Vec3d> points_;
  std::vector<gslam::Vec2d> pixels_;
  std::vector<double> information_, right_, weights_;
  std::vector<std::uint8_t> fitting_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_MATCHING_POSE_FITTER_H
