#ifndef GSLAM_OPTIMIZER_SRC_FACTORS_REPROJECTION_H
#define GSLAM_OPTIMIZER_SRC_FACTORS_REPROJECTION_H

#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

// Where a point of the world is seen, less where it was seen, and the derivatives.

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::size_t kMostCameraParameters = 48;

// The formulas of RadtanProjection (see gslam/geometry/camera/radtan.h), without its limits.
// c: N coefficients. Null: not wanted. False where the result is not finite.
template <std::size_t N>
inline bool distortEverywhere(const double (&c)[N], const Vec2d& flat, Vec2d& image, Mat2d* by_flat,
                              Mat<double, 2, N>* by_coefficients) {
  const auto at = [&c](std::size_t i) { return i < N ? c[i < N ? i : 0] : 0.0; };
  const double x = flat[0], y = flat[1];
  const double xx = x * x, yy = y * y, xy = x * y, s = xx + yy;
  const double inverse = N >= 8 ? 1 / (1 + s * (at(5) + s * (at(6) + s * at(7)))) : 1.0;
  const double g = (1 + s * (c[0] + s * (c[1] + s * at(4)))) * inverse;
  image[0] = x * g + 2 * c[2] * xy + c[3] * (s + 2 * xx) + s * (at(8) + s * at(9));
  image[1] = y * g + c[2] * (s + 2 * yy) + 2 * c[3] * xy + s * (at(10) + s * at(11));
  if (by_flat != nullptr) {
    double slope = (c[0] + s * (2 * c[1] + s * 3 * at(4))) * inverse;
    if (N >= 8) slope -= g * inverse * (at(5) + s * (2 * at(6) + s * 3 * at(7)));
    const double mixed = 2 * (xy * slope + c[2] * x + c[3] * y);
    const double along_x = 2 * at(8) + 4 * at(9) * s, along_y = 2 * at(10) + 4 * at(11) * s;
    *by_flat = {g + 2 * xx * slope + 2 * c[2] * y + 6 * c[3] * x + along_x * x, mixed + along_x * y,
                mixed + along_y * x,
                g + 2 * yy * slope + 6 * c[2] * y + 2 * c[3] * x + along_y * y};
  }
  if (by_coefficients != nullptr) {
    Mat<double, 2, N>& j = *by_coefficients;
    j = Mat<double, 2, N>{};
    const double powers[] = {s, s * s, s * s * s};
    for (std::size_t row = 0; row < 2; ++row) {
      const double here = flat[row];
      j(row, 0) = here * powers[0] * inverse;
      j(row, 1) = here * powers[1] * inverse;
      j(row, 2 + row) = 2 * xy;
      j(row, 3 - row) = s + 2 * here * here;
      if (N >= 5) j(row, std::min<std::size_t>(4, N - 1)) = here * powers[2] * inverse;
      for (std::size_t i = 5; i < std::min<std::size_t>(N, 8); ++i) {
        j(row, i) = -here * powers[i - 5] * g * inverse;
      }
      for (std::size_t i = 8; i < std::min<std::size_t>(N, 12); ++i) {
        if ((i - 8) / 2 == row) j(row, i) = powers[i % 2];
      }
    }
  }
  return std::isfinite(image[0]) && std::isfinite(image[1]);
}

// The image on a tilted sensor (see SensorTilt), also beyond the horizon of the sensor. The
// derivatives so far, of rows x and y, are carried on; null: not wanted.
inline bool tiltEverywhere(double taux, double tauy, Vec2d& image, Mat2d* by_flat,
                           Mat<double, 2, 14>* by_coefficients) {
  const double cx = std::cos(taux), sx = std::sin(taux), cy = std::cos(tauy), sy = std::sin(tauy);
  const Mat3d rx = {1, 0, 0, 0, cx, sx, 0, -sx, cx}, ry = {cy, 0, -sy, 0, 1, 0, sy, 0, cy};
  const auto shift = [](const Mat3d& r, double one) -> Mat3d {
    return {r(2, 2), 0, -r(0, 2), 0, r(2, 2), -r(1, 2), 0, 0, one};
  };
  const Mat3d r = ry * rx, shift_r = shift(r, 1), h = shift_r * r;
  const Vec3d flat = {image[0], image[1], 1}, p = h * flat;
  if (!(p[2] != 0)) return false;
  image = {p[0] / p[2], p[1] / p[2]};
  Mat2d slope;
  for (std::size_t i = 0; i < 4; ++i) {
    slope.values[i] = (h(i / 2, i % 2) - image[i / 2] * h(2, i % 2)) / p[2];
  }
  if (by_flat != nullptr) *by_flat = slope * *by_flat;
  if (by_coefficients != nullptr) {
    *by_coefficients = slope * *by_coefficients;
    const Mat3d slopes[] = {ry * Mat3d{0, 0, 0, 0, -sx, cx, 0, -cx, -sx},
                            Mat3d{-sy, 0, -cy, 0, 0, 0, cy, 0, -sy} * rx};
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3d d = shift_r * (slopes[i] * flat) + shift(slopes[i], 0) * (r * flat);
      for (std::size_t k = 0; k < 2; ++k) {
        (*by_coefficients)(k, 12 + i) = (d[k] - image[k] * d[2]) / p[2];
      }
    }
  }
  return std::isfinite(image[0]) && std::isfinite(image[1]);
}

// Stands for the formulas of one model; others are asked through project().
struct ProjectEverywhere {
  using Result = bool;
  const Vec3d& point;
  Vec2d& pixel;
  Mat<double, 2, 3>* by_point;
  double* by_parameters;

  template <class Model>
  bool operator()(const Model& model) const {
    return ProjectOne{point, pixel, by_point, by_parameters}(model);
  }
  static bool none() { return false; }

  bool operator()(const PinholeCamera<double>& model) const {
    Vec2d flat{};
    if (!flatten(flat)) return false;
    pixel = {model.fx() * flat[0] + model.cx(), model.fy() * flat[1] + model.cy()};
    if (by_point != nullptr) setByPoint(model.fx(), model.fy(), flat, Mat2d::identity());
    if (by_parameters != nullptr) setByFocal(flat, 4);
    return std::isfinite(pixel[0]) && std::isfinite(pixel[1]);
  }

  template <std::size_t N>
  bool operator()(const RadtanCamera<double, N>& model) const {
    Vec2d flat{}, image{};
    if (!flatten(flat)) return false;
    double c[N];
    for (std::size_t i = 0; i < N; ++i) c[i] = model.projection().parameter(i);
    Mat2d by_flat;
    Mat<double, 2, N> by_coefficients;
    Mat2d* const slope = by_point != nullptr ? &by_flat : nullptr;
    Mat<double, 2, N>* const slopes = by_parameters != nullptr ? &by_coefficients : nullptr;
    if (!distortEverywhere(c, flat, image, slope, slopes)) return false;
    if (!tilt(c, image, slope, slopes)) return false;
    const double focal[] = {model.fx(), model.fy()};
    pixel = {focal[0] * image[0] + model.cx(), focal[1] * image[1] + model.cy()};
    if (by_point != nullptr) setByPoint(focal[0], focal[1], flat, by_flat);
    if (by_parameters != nullptr) {
      setByFocal(image, 4 + N);
      for (std::size_t i = 0; i < 2 * N; ++i) {
        by_parameters[i / N * (4 + N) + 4 + i % N] = focal[i / N] * by_coefficients.values[i];
      }
    }
    return std::isfinite(pixel[0]) && std::isfinite(pixel[1]);
  }

 private:
  bool flatten(Vec2d& flat) const {
    if (!(point[2] != 0)) return false;
    flat = {point[0] / point[2], point[1] / point[2]};
    return true;
  }

  template <std::size_t N>
  static bool tilt(const double (&)[N], Vec2d&, Mat2d*, Mat<double, 2, N>*) {
    return true;
  }
  static bool tilt(const double (&c)[14], Vec2d& image, Mat2d* by_flat,
                   Mat<double, 2, 14>* by_coefficients) {
    return tiltEverywhere(c[12], c[13], image, by_flat, by_coefficients);
  }

  void setByPoint(double fx, double fy, const Vec2d& flat, const Mat2d& by_flat) const {
    const double inverse = 1 / point[2];
    const double focal[] = {fx, fy};
    for (std::size_t r = 0; r < 2; ++r) {
      const double a = focal[r] * by_flat(r, 0) * inverse, b = focal[r] * by_flat(r, 1) * inverse;
      (*by_point)(r, 0) = a;
      (*by_point)(r, 1) = b;
      (*by_point)(r, 2) = -(a * flat[0] + b * flat[1]);
    }
  }

  // Columns fx fy cx cy of rows of `count`; the others are set to zero.
  void setByFocal(const Vec2d& image, std::size_t count) const {
    std::fill(by_parameters, by_parameters + 2 * count, 0.0);
    for (std::size_t r = 0; r < 2; ++r) {
      by_parameters[r * count + r] = image[r];
      by_parameters[r * count + 2 + r] = 1;
    }
  }
};

// Camera::project(), but pinhole and radtan models are evaluated by their formulas wherever the
// point is not in the plane of the camera (as BAL, Ceres' and COLMAP's bundle adjusters do).
// by_parameters: 2 rows of camera.parameterCount() columns. Null: not wanted.
inline bool projectEverywhere(const Camera& camera, const Vec3d& point, Vec2d& pixel,
                              Mat<double, 2, 3>* by_point = nullptr,
                              double* by_parameters = nullptr) {
  return camera.visit(ProjectEverywhere{point, pixel, by_point, by_parameters});
}

// Rows: u, v, and u in the right image. Tangents are (translation, rotation) on the right.
struct ReprojectionJacobians {
  Mat<double, 3, 6> by_pose;       // of T_world_body
  Mat<double, 3, 6> by_extrinsic;  // of T_body_camera
  Mat<double, 3, 3> by_point;
  double by_camera[3 * kMostCameraParameters];  // 3 rows of parameterCount() columns
};

// What an observation says; rows without one have residual 0 and derivatives 0.
struct ReprojectionObservation {
  Vec2d pixel{};
  double right_u = 0;   // of a rectified pair; has_right says whether it is there
  double baseline = 0;  // metres
  bool has_right = false;
};

// u, v and, where it is asked for, u in the right image: that of the same camera, `baseline` along
// x. by_parameters: 3 rows. Null: not wanted.
inline bool projectPair(const Camera& camera, const Vec3d& point,
                        const ReprojectionObservation& observation, Vec3d& pixels, Mat3d* by_point,
                        double* by_parameters) {
  Vec2d left{}, right{};
  Mat<double, 2, 3> slope;
  if (!projectEverywhere(camera, point, left, by_point != nullptr ? &slope : nullptr,
                         by_parameters)) {
    return false;
  }
  const std::size_t count = by_parameters != nullptr ? camera.parameterCount() : 0;
  if (by_point != nullptr) {
    *by_point = Mat3d{};
    by_point->setBlock(0, 0, slope);
  }
  if (by_parameters != nullptr) std::fill_n(by_parameters + 2 * count, count, 0.0);
  pixels = {left[0], left[1], 0};
  if (!observation.has_right) return true;
  double by_right[2 * kMostCameraParameters];
  const Vec3d point_right = {point[0] - observation.baseline, point[1], point[2]};
  if (!projectEverywhere(camera, point_right, right, by_point != nullptr ? &slope : nullptr,
                         by_parameters != nullptr ? by_right : nullptr)) {
    return false;
  }
  pixels[2] = right[0];
  for (std::size_t c = 0; c < 3 && by_point != nullptr; ++c) (*by_point)(2, c) = slope(0, c);
  if (by_parameters != nullptr) std::copy_n(by_right, count, by_parameters + 2 * count);
  return true;
}

// Predicted less observed, not whitened. Whether the camera sees the point. Without `with_camera`
// by_camera is left as it is.
inline bool reprojectionResidual(const SE3d& T_world_body, const SE3d& T_body_camera,
                                 const Camera& camera, const Vec3d& point_world,
                                 const ReprojectionObservation& observation, Vec3d& residual,
                                 ReprojectionJacobians* jacobians = nullptr,
                                 bool with_camera = true) {
  const Vec3d in_body = T_world_body.inverse() * point_world;
  const Vec3d in_camera = T_body_camera.inverse() * in_body;
  Vec3d pixels{};
  Mat3d by_in_camera;
  if (!projectPair(camera, in_camera, observation, pixels,
                   jacobians != nullptr ? &by_in_camera : nullptr,
                   jacobians != nullptr && with_camera ? jacobians->by_camera : nullptr)) {
    return false;
  }
  residual = {pixels[0] - observation.pixel[0], pixels[1] - observation.pixel[1],
              observation.has_right ? pixels[2] - observation.right_u : 0.0};
  if (jacobians == nullptr) return true;
  // exp(-d) p = p - translation + p x rotation, to first order.
  const Mat3d by_in_body = by_in_camera * T_body_camera.rotation().matrix().transpose();
  jacobians->by_pose.setBlock(0, 0, -by_in_body);
  jacobians->by_pose.setBlock(0, 3, by_in_body * SO3d::hat(in_body));
  jacobians->by_extrinsic.setBlock(0, 0, -by_in_camera);
  jacobians->by_extrinsic.setBlock(0, 3, by_in_camera * SO3d::hat(in_camera));
  jacobians->by_point = by_in_body * T_world_body.rotation().matrix().transpose();
  return true;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FACTORS_REPROJECTION_H
