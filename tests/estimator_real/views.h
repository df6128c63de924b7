// Views of real sequences: features, cameras, true poses, depths.
#ifndef GSLAM_TESTS_ESTIMATOR_REAL_VIEWS_H
#define GSLAM_TESTS_ESTIMATOR_REAL_VIEWS_H

#include <gslam/geometry/camera.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

/// What one camera saw.
struct View {
  std::string name;
  gslam::Camera camera;
  gslam::SE3d T_world_camera;
  std::vector<gslam::Vec2d> pixels;
  std::vector<double> depths;  ///< along the axis, metres, 0 where unknown; empty without sensor
  cv::Mat descriptors;
};

/// The images number `image` of each frame that has a true pose, with SIFT features.
/// @param path      below GSLAM_TEST_DATA
/// @param image     its place in Frame::images
/// @param features  most of one image
std::vector<View> viewsOf(const std::string& path, std::size_t image, int features);

/// Those of 7-Scenes' kitchen, with ORB features. Its published intrinsics and poses are the depth
/// camera's; the colour camera has a focal length of about 525 pixels (its makers' default), and
/// depths are looked up where its rays meet the depth image.
std::vector<View> kitchenViews();

/// Indices of features that are each other's nearest, clearly nearer than the second nearest.
struct Match {
  std::size_t first, second;
};
std::vector<Match> matchesOf(const View& first, const View& second);

/// Order number k of n: 0 is the given one, all others are shuffled.
std::vector<std::size_t> orderOf(std::size_t n, unsigned k);

/// @{
/// Degrees between two rotations; between two directions.
double rotationDegrees(const gslam::SO3d& a, const gslam::SO3d& b);
double directionDegrees(const gslam::Vec3d& a, const gslam::Vec3d& b);
/// @}

#endif  // GSLAM_TESTS_ESTIMATOR_REAL_VIEWS_H
