// The cost of a pose given rays and the points on them, as a quadratic form of the rotation, and
// the search for its least values. Shared by the solvers of absolute pose from n points.
#ifndef GSLAM_ESTIMATOR_MATH_POSE_FORM_H
#define GSLAM_ESTIMATOR_MATH_POSE_FORM_H

#include <gslam/base/platform.h>
#include <gslam/base/span.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

#include "math/pnp_small.h"
#include "math/quaternion.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pnp {

// Number of the element (i, j) among the six of a symmetric matrix: 00 01 02 11 12 22.
constexpr int kSix[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

// Ray i starts at origins[i] (at 0 where there are none) in the direction bearings[i], of length
// 1, and goes through points[i] of the world.
struct Rays {
  Span<const Vec3d> origins;
  Span<const Vec3d> bearings;
  Span<const Vec3d> points;

  std::size_t size() const noexcept { return points.size(); }
};

// Coordinates in which the arithmetic is done. World: principal axes from the longest to the
// shortest, centre 0, mean square distance from it 1. Camera: z along the mean bearing, so that the
// small elements of the projections orthogonal to near-parallel bearings are sums of squares
// instead of differences; same unit.
struct PoseFrame {
  Vec3d world_centre;
  double world_axes[9];   // rows: axes
  double camera_axes[9];  // rows: axes
  Vec3d origin;           // mean of the origins of the rays
  double scale;           // metres of the unit of length
  double inverse_scale;
  double spread[3];  // variance along the axes, of sum 1

  // False where there is no such frame: all points equal, or numbers that are not finite.
  bool set(const Rays& rays) noexcept;

  // False where the points are on a line, about which the world could be turned.
  bool isWide() const noexcept;

  // Correspondence i in these coordinates.
  GSLAM_ALWAYS_INLINE void load(const Rays& rays, std::size_t i, double* point, double* bearing,
                                double* origin_of_ray) const noexcept {
    const Vec3d d = inverse_scale * (rays.points[i] - world_centre);
    const Vec3d& b = rays.bearings[i];
    for (int k = 0; k < 3; ++k) {
      point[k] = dot3(world_axes + 3 * k, d.data());
      bearing[k] = dot3(camera_axes + 3 * k, b.data());
    }
    if (rays.origins.empty()) return;
    const Vec3d o = inverse_scale * (rays.origins[i] - origin);
    for (int k = 0; k < 3; ++k) origin_of_ray[k] = dot3(camera_axes + 3 * k, o.data());
  }
  // The pose in metres, T_camera_world, of one in these coordinates. False where it is not finite.
  bool setPose(const double* quaternion, const double* translation, SE3d& pose) const;
};

// With the rotation as r = (c1, c2, c3), the columns c_j of its matrix one after the other, and
// P_i = I - b_i b_i^T, the mean of |P_i (R x_i + t - o_i)|^2 over all rays, least over t, is
// r^T omega r + 2 linear^T r + constant, reached at t = translation r + translation_0.
struct PoseForm {
  static constexpr std::size_t kStride = 10;  // of omega: whole vector registers

  double omega[9 * kStride];
  double linear[9];
  double constant;
  double translation[3][9];
  double translation_0[3];
  double depth[9];  // the mean depth along the rays, as a linear function of r
  double depth_0;

  // False where the rays are all parallel, or numbers are not finite.
  bool set(const Rays& rays, const PoseFrame& frame) noexcept;

  double cost(const double* r) const noexcept;
  double meanDepth(const double* r) const noexcept;
  void translationOf(const double* r, double* t) const noexcept;
};

// to += m's three columns from `first` on, times the three numbers of v.
inline void addColumns(const PoseForm& form, int first, const double* v, double* to) noexcept {
  const double* const m = form.omega + PoseForm::kStride * static_cast<std::size_t>(first);
  for (std::size_t i = 0; i < PoseForm::kStride; ++i) {
    to[i] += v[0] * m[i] + v[1] * m[PoseForm::kStride + i] + v[2] * m[2 * PoseForm::kStride + i];
  }
}

// Half the gradient of the cost by r.
inline void halfGradient(const PoseForm& form, const double* r, double* y) noexcept {
  for (int i = 0; i < 9; ++i) y[i] = form.linear[i];
  y[9] = 0;
  for (int j = 0; j < 9; j += 3) addColumns(form, j, r + j, y);
}

inline double costOf(const PoseForm& form, const double* r, const double* y) noexcept {
  double cost = form.constant;
  for (int i = 0; i < 9; ++i) cost += r[i] * (y[i] + form.linear[i]);
  return cost;
}

// A pose in the coordinates of a PoseFrame.
struct FramePose {
  Quaternion q;  // of length 1
  double t[3];
  double cost;  // mean square distance of the points from the rays, half lines
};

// r of a unit quaternion x y z w.
inline void columnsOfQuaternion(const double* q, double* r) noexcept {
  const double x2 = 2 * q[0], y2 = 2 * q[1], z2 = 2 * q[2];
  const double xx = x2 * q[0], xy = x2 * q[1], xz = x2 * q[2], xw = x2 * q[3];
  const double yy = y2 * q[1], yz = y2 * q[2], yw = y2 * q[3];
  const double zz = z2 * q[2], zw = z2 * q[3];
  r[0] = 1 - (yy + zz), r[1] = xy + zw, r[2] = xz - yw;
  r[3] = xy - zw, r[4] = 1 - (xx + zz), r[5] = yz + xw;
  r[6] = xz + yw, r[7] = yz - xw, r[8] = 1 - (xx + yy);
}

// The quaternion of the columns of a rotation matrix.
void quaternionOfColumns(const double* r, double* q) noexcept;
// r of the rotation whose first columns are next to the first two of r; false where they are
// parallel.
bool rotationOfTwoColumns(const double* r, double* rotation) noexcept;

// Newton's method on the rotations: goes from q to a near minimum of the form, and gives its cost.
double descend(const PoseForm& form, Quaternion& q) noexcept;

// Gauss-Newton on the rays themselves, which restores the digits that were lost by the squares in
// the form, and sets the cost.
void polish(const Rays& rays, const PoseFrame& frame, FramePose& pose) noexcept;

// The least minimum, and others whose root mean square residual is at most twice its, from the
// least to the greatest cost.
std::size_t solvePose(const Rays& rays, Span<SE3d> poses);

}  // namespace pnp
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_POSE_FORM_H
