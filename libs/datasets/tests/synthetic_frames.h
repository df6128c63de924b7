// Synthetic datasets for tests, and what their depth images say of space.
#ifndef GSLAM_DATASETS_TESTS_SYNTHETIC_FRAMES_H
#define GSLAM_DATASETS_TESTS_SYNTHETIC_FRAMES_H

#include <gslam/datasets/synthetic.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "frame_at.h"

namespace synthetic_frames {

using gslam::Camera;
using gslam::CameraImage;
using gslam::CameraSensor;
using gslam::Dataset;
using gslam::Frame;
using gslam::ImageKind;
using gslam::SE3d;
using gslam::SO3d;
using gslam::SyntheticOptions;
using gslam::Vec2d;
using gslam::Vec3d;

/// Nothing errs, depth has all digits.
inline SyntheticOptions clean(const std::string& world = "room") {
  SyntheticOptions options;
  options.world = world;
  options.noise = 0;
  options.blur = false;
  options.depth_float = true;
  return options;
}

/// Camera axes (right, down, forward) for a body whose x is forward.
inline SO3d forward() {
  return SO3d::fromMatrix({{0, 0, 1, -1, 0, 0, 0, -1, 0}});
}

inline CameraSensor sensor(const std::string& name, ImageKind kind, const Camera& camera,
                           const SE3d& T_body_camera) {
  CameraSensor result;
  result.name = name;
  result.kind = kind;
  result.camera = camera;
  result.T_body_camera = T_body_camera;
  return result;
}

/// A depth image with the pose of its camera.
class DepthView {
 public:
  DepthView(const Dataset& dataset, const Frame& frame, std::size_t image)
      : image_(frame.images[image]) {
    const gslam::StampedPose* const pose = dataset.info().ground_truth.nearest(frame.stamp);
    EXPECT_EQ(pose->stamp, frame.stamp);
    T_world_camera_ = pose->pose * image_.T_body_camera;
  }

  const Camera& camera() const { return image_.camera; }
  double depthAt(int u, int v) const { return double(image_.image.at<float>(u, v)); }

  /// World coordinates of what a pixel sees, or false.
  bool point(const Vec2d& pixel, double depth, Vec3d& world) const {
    Vec3d bearing{};
    if (!(depth > 0) || !image_.camera.unproject(pixel, bearing) || bearing[2] < 0.05) return false;
    world = T_world_camera_ * (bearing * (depth / bearing[2]));
    return true;
  }

  /// Where a place is seen, and how deep it is.
  bool project(const Vec3d& world, Vec2d& pixel, double& depth) const {
    const Vec3d p = T_world_camera_.inverse() * world;
    depth = p[2];
    return p[2] > 0.05 && image_.camera.project(p, pixel) && image_.camera.isInImage(pixel);
  }

  /// Between four pixels; of a plane the inverse depth of a pinhole camera is linear. False where
  /// the four are on no common plane.
  bool interpolate(const Vec2d& pixel, double& depth) const {
    const int u = int(std::floor(pixel[0])), v = int(std::floor(pixel[1]));
    if (u < 1 || v < 1 || u + 2 >= camera().width() || v + 2 >= camera().height()) return false;
    double inverse[4][4];
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) {
        const double at = depthAt(u + x - 1, v + y - 1);
        if (!(at > 0)) return false;
        inverse[y][x] = 1 / at;
      }
    }
    const double bend = 2e-3 * inverse[1][1];
    for (int k = 0; k < 4; ++k) {
      for (int i = 1; i < 3; ++i) {
        if (std::fabs(inverse[k][i - 1] - 2 * inverse[k][i] + inverse[k][i + 1]) > bend)
          return false;
        if (std::fabs(inverse[i - 1][k] - 2 * inverse[i][k] + inverse[i + 1][k]) > bend)
          return false;
      }
    }
    const double fx = pixel[0] - u, fy = pixel[1] - v;
    depth = 1 / ((1 - fy) * ((1 - fx) * inverse[1][1] + fx * inverse[1][2]) +
                 fy * ((1 - fx) * inverse[2][1] + fx * inverse[2][2]));
    return true;
  }

 private:
  const CameraImage& image_;
  SE3d T_world_camera_;
};

/// What came of going from one view to another and back.
struct ThereAndBack {
  int seen = 0;      ///< pixels of the first that are on smooth surfaces in the second
  int hidden = 0;    ///< by something nearer
  int wrong = 0;     ///< not hidden, but not there
  double worst = 0;  ///< pixels, of those that are neither
};

inline ThereAndBack thereAndBack(const DepthView& a, const DepthView& b, double tolerance) {
  ThereAndBack result;
  for (int v = 2; v < a.camera().height(); v += 7) {
    for (int u = 3; u < a.camera().width(); u += 7) {
      const Vec2d from = {{double(u), double(v)}};
      Vec3d world{}, seen{};
      Vec2d to{}, back{};
      double expected = 0, found = 0, unused = 0;
      if (!a.point(from, a.depthAt(u, v), world) || !b.project(world, to, expected)) continue;
      if (!b.interpolate(to, found)) continue;
      ++result.seen;
      if (!b.point(to, found, seen) || !a.project(seen, back, unused)) continue;
      const double error = (back - from).norm();
      if (error <= tolerance) {
        result.worst = std::max(result.worst, error);
      } else if (found < expected) {
        ++result.hidden;
      } else {
        ++result.wrong;
      }
    }
  }
  return result;
}

}  // namespace synthetic_frames

#endif  // GSLAM_DATASETS_TESTS_SYNTHETIC_FRAMES_H
