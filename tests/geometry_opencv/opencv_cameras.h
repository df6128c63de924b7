// Cameras, points and pixels in OpenCV's types.
#ifndef GSLAM_TESTS_GEOMETRY_OPENCV_OPENCV_CAMERAS_H
#define GSLAM_TESTS_GEOMETRY_OPENCV_OPENCV_CAMERAS_H

#include <gslam/geometry/camera.h>

#include <opencv2/core.hpp>
#include <random>
#include <vector>

namespace opencv_cameras {

inline cv::Matx33d cameraMatrix(const gslam::Camera& camera) {
  return {camera.parameter("fx"),
          0,
          camera.parameter("cx"),
          0,
          camera.parameter("fy"),
          camera.parameter("cy"),
          0,
          0,
          1};
}

/// What follows fx fy cx cy.
inline std::vector<double> coefficients(const gslam::Camera& camera) {
  const std::vector<double> all = camera.parameters();
  return {all.begin() + 4, all.end()};
}

/// Points that the camera sees inside its image, 0.3 to 30 m away.
inline std::vector<cv::Point3d> pointsInImage(const gslam::Camera& camera, std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0, camera.width() - 1), v(0, camera.height() - 1),
      exponent(-0.5, 1.5);
  std::vector<cv::Point3d> points;
  while (points.size() < count) {
    gslam::Vec3d b;
    if (!camera.unproject({u(random), v(random)}, b)) continue;
    const double distance = std::pow(10, exponent(random));
    points.emplace_back(b[0] * distance, b[1] * distance, b[2] * distance);
  }
  return points;
}

inline gslam::Vec3d vec(const cv::Point3d& p) {
  return {p.x, p.y, p.z};
}

/// One camera for each number of coefficients; the first two are EuRoC's and TUM fr1's.
inline std::vector<gslam::Camera> radtanCameras() {
  const auto make = [](int width, int height, const std::vector<double>& values) {
    return gslam::Camera::fromParameters("radtan", width, height, values);
  };
  std::vector<double> full = {380,  385,  322.5, 239.1,  0.9,     0.21,    0.0011, -0.0007, 0.012,
                              1.21, 0.42, 0.041, 0.0012, -0.0004, -0.0021, 0.0003, 0.06,    -0.04};
  const auto first = [&](std::size_t count) {
    return std::vector<double>(full.begin(), full.begin() + static_cast<std::ptrdiff_t>(count));
  };
  return {make(752, 480,
               {458.654, 457.296, 367.215, 248.375, -0.28340811, 0.07395907, 0.00019359,
                1.76187114e-05}),
          make(640, 480,
               {517.306408, 516.469215, 318.643040, 255.313989, 0.262383, -0.953104, -0.005358,
                0.002628, 1.163314}),
          make(640, 480, first(12)), make(640, 480, first(16)), make(640, 480, first(18))};
}

}  // namespace opencv_cameras

#endif  // GSLAM_TESTS_GEOMETRY_OPENCV_OPENCV_CAMERAS_H
