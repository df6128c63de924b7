#ifndef GSLAM_OPTIMIZER_CERES_SRC_PLAIN_LENS_H
#define GSLAM_OPTIMIZER_CERES_SRC_PLAIN_LENS_H

#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// Pinhole cameras without or with up to five coefficients, as the numbers that they are. To make a
// Camera of these takes long, as it finds out how far its lens is one-to-one.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

struct PlainLens {
  static constexpr std::size_t kNumbers = 9;

  bool is_plain = false;                // whether the rest is set
  bool is_possible = true;              // whether a Camera would take the numbers
  double focal[4] = {};                 // fx fy cx cy
  double coefficients[5] = {};          // k1 k2 p1 p2 k3
  std::uint8_t columns[kNumbers] = {};  // which of them are free
  std::size_t column_count = 0;
  double aspect = 0;  // as FreeIntrinsics
  bool is_at_body = true;
  Mat3d rotation_back = Mat3d::identity();  // body to camera
  Vec3d translation_back{};

  static bool hasForm(const Camera& camera) {
    const std::size_t n = camera.parameterCount();
    const bool is_radtan = camera.modelName() == "radtan" && (n == 8 || n == 9);
    return camera.modelName() == "pinhole" || is_radtan;
  }

  void setNumbers(const std::vector<double>& parameters) {
    std::copy_n(parameters.begin(), 4, focal);
    std::copy(parameters.begin() + 4, parameters.end(), coefficients);
    is_possible = focal[0] > 0 && focal[1] > 0 &&
                  std::all_of(parameters.begin(), parameters.end(),
                              [](double v) { return std::isfinite(v); });
  }

  void setExtrinsic(const SE3d& T_body_camera) {
    const SE3d back = T_body_camera.inverse();
    rotation_back = back.rotation().matrix();
    translation_back = back.translation();
    is_at_body = rotation_back == Mat3d::identity() && translation_back == Vec3d{};
  }
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_PLAIN_LENS_H
