// What all implementations solve.
#ifndef GSLAM_BENCH_OPTIMIZER_PEERS_SCENES_H
#define GSLAM_BENCH_OPTIMIZER_PEERS_SCENES_H

#include <gslam/optimizer.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "synthetic_bundle.h"

/// A bundle with one variable camera a pose (9 variables, BAL), or one camera that is fixed (6).
using BundleArrays = synthetic_bundle::Arrays;

/// BAL 49-7776 of GSLAM_TEST_DATA; no poses where it is not there.
const BundleArrays& realBundle();

/// Whether focal length and distortion are variables, of a camera of its own for each pose.
bool hasFreeLenses(const BundleArrays& arrays);

/// What peers know of a camera: one focal length, radial distortion.
struct Lens {
  std::array<double, 3> numbers{};  ///< f, k1, k2
  gslam::Vec2d centre{};            ///< principal point, to be taken off the pixels
};
Lens lensOf(const gslam::Camera& camera);

/// Writes back what a peer found of a pose, and of its camera where that is variable.
void setView(BundleArrays& arrays, std::size_t pose, const gslam::SE3d& T_camera_world,
             const std::array<double, 3>& lens);

/// Points that a pinhole camera sees, with half a pixel of noise, and where to start.
struct PoseScene {
  std::vector<gslam::Vec3d> points;
  std::vector<gslam::Vec2d> pixels;
  std::vector<gslam::Camera> cameras;
  gslam::SE3d truth, start;
};
PoseScene poseScene(std::size_t points);

/// sphere2500 or parking-garage of GSLAM_TEST_DATA, chordally initialised; no poses where it is not
/// there.
const gslam::PoseGraph<gslam::SE3d>& realGraph(const std::string& name);

#endif  // GSLAM_BENCH_OPTIMIZER_PEERS_SCENES_H
