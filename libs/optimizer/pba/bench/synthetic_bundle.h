// Bundles with the counts and the locality of well-known ones.
#ifndef GSLAM_OPTIMIZER_PBA_BENCH_SYNTHETIC_BUNDLE_H
#define GSLAM_OPTIMIZER_PBA_BENCH_SYNTHETIC_BUNDLE_H

#include <gslam/optimizer/bundle_problem.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace synthetic_bundle {

/// What is made. Cameras stand along a street that is walked several times, and look to its side;
/// a point is seen by some of those that are near.
struct Shape {
  std::size_t cameras = 10;         ///< poses; each with a camera of its own where bal is set
  std::size_t points = 1000;        ///< points
  std::size_t observations = 5000;  ///< about as many
  std::size_t walks = 1;            ///< times that the street is walked
  double reach = 8;                 ///< steps along the street within which a point is seen
  bool bal = false;                 ///< 9 variables a camera; else one fixed pinhole camera
  double pixel_noise = 0.5;         ///< standard deviation
  double start_noise = 1;           ///< 0 starts at the truth
  std::uint64_t seed = 1;           ///< of all that is drawn
};

Shape ladybug();    ///< 49 cameras, 7.8k points, 32k observations
Shape trafalgar();  ///< 257 cameras, 65k points, 225k observations
Shape venice();     ///< 1778 cameras, 994k points, 5.0M observations
Shape local();      ///< 10 keyframes, 1000 points, 5000 observations, 6 variables

/// Arrays of a bundle.
struct Arrays {
  std::vector<gslam::SE3d> T_world_body;             ///< poses
  std::vector<std::uint8_t> pose_fixed;              ///< the first two, where not bal
  std::vector<gslam::Vec3d> points;                  ///< points
  std::vector<gslam::Camera> cameras;                ///< intrinsics
  std::vector<gslam::CameraFreedom> camera_freedom;  ///< f k1 k2, where bal
  std::vector<std::uint32_t> observation_pose;       ///< indices
  std::vector<std::uint32_t> observation_point;      ///< indices
  std::vector<std::uint32_t> observation_camera;     ///< indices
  std::vector<gslam::Vec2d> pixels;                  ///< where seen

  /// Views of the arrays.
  gslam::BundleProblem problem();
};

/// Makes a bundle, the same for the same shape.
Arrays make(const Shape& shape);

}  // namespace synthetic_bundle

#endif  // GSLAM_OPTIMIZER_PBA_BENCH_SYNTHETIC_BUNDLE_H
