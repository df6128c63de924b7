// Random instances whose answer is known: the same for every implementation, on every machine.
#ifndef GSLAM_BENCH_ESTIMATOR_PEERS_INSTANCES_H
#define GSLAM_BENCH_ESTIMATOR_PEERS_INSTANCES_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <cstdint>
#include <vector>

/// Numbers of a model, to be compared: a matrix row by row; a pose as its rotation matrix row by
/// row, and its translation.
using Numbers = std::vector<double>;

/// One instance without noise. What a solver does not need is empty.
struct Instance {
  std::vector<gslam::Vec3d> first;    ///< bearings of the first camera, or points
  std::vector<gslam::Vec3d> second;   ///< bearings of the second or only camera, or points
  std::vector<gslam::Vec3d> points;   ///< of the world, metres
  std::vector<gslam::Vec3d> origins;  ///< of the rays of a rig
  gslam::SE3d pose;                   ///< T_second_first, or T_camera_world
  Numbers truth;                      ///< of the model that is sought
};

using Instances = std::vector<Instance>;

/// How many are solved to find the lost ones: 1e4, or 1e5 where GSLAM_PEERS_SLOW is set.
std::size_t instanceCount();

/// @{
/// Two cameras, one unit apart, that see n points 2 to 10 units away; truth: the matrix or
/// rotation.
const Instances& essentialInstances(std::size_t n);
const Instances& verticalInstances(std::size_t n);     ///< truth: the pose
const Instances& fundamentalInstances(std::size_t n);  ///< bearings with z = 1: normalised points
const Instances& relativeRotationInstances();          ///< 5 points; truth: the rotation
const Instances& homographyInstances();                ///< 4 points of a plane; z = 1
const Instances& pureRotationInstances();              ///< 2 points
const Instances& triangulationInstances();             ///< 1 point
/// @}

/// @{
/// One camera, or a rig of four, that sees n points; truth: the pose.
const Instances& absoluteInstances(std::size_t n);
const Instances& collinearInstances();  ///< 3 points within 1e-4 of a line
const Instances& planarInstances(std::size_t n);
const Instances& rigInstances(std::size_t n);
const Instances& planarRigInstances(std::size_t n);
/// @}

/// @{
/// Points in `first` and where they came to in `second`; truth: the transform.
const Instances& similarityInstances();  ///< 3 points; rotation and translation, then the scale
const Instances& affine2DInstances();    ///< 3 points with z = 0
const Instances& affine3DInstances();    ///< 4 points
const Instances& planeInstances();       ///< 3 points
/// @}

/// The instances of n points as a function without arguments: of<essentialInstances, 5>.
template <const Instances& (*all)(std::size_t), std::size_t n>
const Instances& of() {
  return all(n);
}

/// Matches with 1 px of noise and outliers, seen by a camera of 640 x 480 pixels with f = 500.
struct Scene {
  std::vector<gslam::Vec2d> first;   ///< pixels
  std::vector<gslam::Vec2d> second;  ///< pixels
  std::vector<gslam::Vec3d> points;  ///< of the world, for `second`
  gslam::SE3d pose;                  ///< T_second_first, or T_camera_world
  gslam::Mat3d homography;           ///< in pixels, of planar scenes
};

constexpr double kFocal = 500;
constexpr double kCentreX = 319.5;
constexpr double kCentreY = 239.5;
constexpr int kWidth = 640;
constexpr int kHeight = 480;

/// What the scenes are made of.
enum class SceneKind { TwoViews, TwoViewsOfPlane, Points };

/// 100 scenes of n matches.
const std::vector<Scene>& scenes(SceneKind kind, std::size_t n, double outliers);

#endif  // GSLAM_BENCH_ESTIMATOR_PEERS_INSTANCES_H
