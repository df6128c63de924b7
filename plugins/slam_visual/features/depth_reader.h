#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_DEPTH_READER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_DEPTH_READER_H

#include <gslam/core.h>

#include <cstdint>
#include <string>
#include <vector>

#include "scene/eye.h"

namespace visual {

/// Reads from depth images how far away features are. Keeps its memory from one image to the next.
///
/// A depth is that of the nearest pixel, or where that has none, the least of its four neighbours.
/// Where these differ by more than a tenth there is an edge, and nobody knows which side of it the
/// feature is on: it gets no depth.
class DepthReader {
 public:
  /// @param eye     camera whose pixels features have
  /// @param camera  of depth images
  /// @param T_body_depth  takes its coordinates to those of the body
  DepthReader(const Eye& eye, const gslam::Camera& camera, const gslam::SE3d& T_body_depth);

  /// Whether an image has the kind, type (u16 or f32) and size that is needed.
  /// @param problem  result where it has not: a sentence that names the camera
  bool accepts(const gslam::CameraImage& image, std::string& problem) const;
  /// @param image    of the depth camera, one that is accepted
  /// @param depth    results: of each feature, along the axis of the eye, metres; 0: not measured
  /// @param right_u  results: where a second camera would see it; NaN: not measured
  void read(const gslam::CameraImage& image, const std::vector<gslam::Feature>& features,
            std::vector<float>& depth, std::vector<float>& right_u);

 private:
  void project(const gslam::CameraImage& image);
  template <class T>
  void projectRows(const gslam::Image& image, double scale);

  Eye eye_;
  gslam::Camera camera_;
  gslam::SE3d T_eye_depth_;
  bool is_same_;  // as the eye: pixel for pixel
  // Otherwise what the eye would see, in cells of some pixels; 0: nothing.
  int cell_ = 1, columns_ = 0, rows_ = 0;
  std::vector<float> seen_;
  std::vector<gslam::Vec3d> bearings_;  // of each depth pixel, at depth 1; all zero: none
  std::vector<gslam::Vec3d> points_;    // of a row
  std::vector<gslam::Vec2d> pixels_;
  std::vector<std::uint8_t> is_seen_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_DEPTH_READER_H
