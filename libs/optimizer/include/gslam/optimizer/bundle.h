#ifndef GSLAM_OPTIMIZER_BUNDLE_H
#define GSLAM_OPTIMIZER_BUNDLE_H

#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer/id_map.h>

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// A bundle that owns its arrays: what files hold.

namespace gslam {
inline namespace v1 {

/// The arrays of a BundleProblem, owned. Fields as there.
///
/// Thread-safety: as a vector.
struct Bundle {
  std::vector<SE3d> T_world_body;                 ///< poses
  std::vector<std::uint8_t> pose_fixed;           ///< empty or one for each pose
  std::vector<Vec3d> points;                      ///< world, metres
  std::vector<std::uint8_t> point_fixed;          ///< empty or one for each point
  std::vector<Camera> cameras;                    ///< intrinsics
  std::vector<CameraFreedom> camera_freedom;      ///< empty or one for each camera
  std::vector<SE3d> T_body_camera;                ///< empty or one for each camera
  std::vector<std::uint32_t> observation_pose;    ///< n
  std::vector<std::uint32_t> observation_point;   ///< n
  std::vector<std::uint32_t> observation_camera;  ///< n
  std::vector<Vec2d> pixels;                      ///< n
  std::vector<Vec3d> information;                 ///< empty or n
  /// n numbers that the file has for features of their images; or empty
  std::vector<std::uint32_t> observation_key;
  std::vector<Vec3f> colors;             ///< of points, red green blue from 0 to 1; or empty
  std::vector<std::string> image_names;  ///< of poses; or empty
  IdMap pose_ids;                        ///< names that the file has for poses; or empty
  IdMap point_ids;                       ///< names that the file has for points; or empty
  IdMap camera_ids;                      ///< names that the file has for cameras; or empty

  /// Views of the arrays, for optimizeBundle(). They must not outlive this object, nor a change of
  /// the size of one.
  GSLAM_OPTIMIZER_EXPORT BundleProblem problem();
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_BUNDLE_H
