#include "math/homography_motions.h"

#include <gslam/geometry/detail/symmetric_eigen.h>

#include <cmath>

#include "math/rotation_fit.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Of the squares of singular values, from 1: what rounding makes of 1.
constexpr double kRounding = 4e-15;
// Twice the least translation that counts, in distances of the plane.
constexpr double kLeastStretch = 2e-9;

// The motion for a plane through the origin spanned by two unit vectors at right angles, of which h
// changes neither length nor angle.
bool motionOf(const Mat3d& h, const Vec3d& p, const Vec3d& q, HomographyMotion& motion) noexcept {
  const Vec3d n = p.cross(q);
  const Vec3d hp = h * p;
  const Vec3d hq = h * q;
  const Mat3d r = outer(hp, p) + outer(hq, q) + outer(hp.cross(hq), n);
  for (const double value : r.values) {
    if (!(std::fabs(value) < 2)) return false;
  }
  const SO3d rotation = rotationOf(r);
  motion = {SE3d(rotation, h * n - rotation * n), n};
  return true;
}

HomographyMotion opposite(const HomographyMotion& m) noexcept {
  return {SE3d(m.T_second_first.rotation(), -m.T_second_first.translation()), -m.normal_first};
}

}  // namespace

std::size_t homographyMotions(const Mat3d& H, std::array<HomographyMotion, 4>& motions) noexcept {
  double largest = 0;
  for (const double value : H.values) largest = std::fmax(largest, std::fabs(value));
  if (!(largest > 1e-290 && largest < 1e290)) return 0;
  for (const double value : H.values) {
    if (std::isnan(value)) return 0;  // fmax() leaves it out
  }
  Mat3d h = (1 / largest) * H;
  const SymmetricEigen<double, 3> eigen(h.transpose() * h);
  const double middle = eigen.values[1];
  if (!(middle > 1e-12 * eigen.values[0])) return 0;
  h *= 1 / std::sqrt(middle);
  double longer = eigen.values[0] / middle - 1;
  double shorter = 1 - eigen.values[2] / middle;
  if (std::fmax(longer, shorter) < kLeastStretch) {
    SO3d rotation;
    if (!fitRotation(h, 3.1, rotation)) return 0;
    motions[0] = {SE3d(rotation, {{0, 0, 0}}), {{0, 0, 0}}};
    return 1;
  }
  // The camera moved along the normal: the two planes are one.
  const bool is_double = longer < kRounding || shorter < kRounding;
  if (longer < kRounding) longer = 0;
  if (shorter < kRounding) shorter = 0;
  const double scale = 1 / std::sqrt(longer + shorter);
  const Vec3d along = (scale * std::sqrt(shorter)) * eigen.vectors.col(0);
  const Vec3d beside = (scale * std::sqrt(longer)) * eigen.vectors.col(2);
  const Vec3d kept = eigen.vectors.col(1);
  HomographyMotion found[2];
  if (!motionOf(h, kept, along + beside, found[0])) return 0;
  if (!is_double && !motionOf(h, kept, along - beside, found[1])) return 0;
  motions[0] = found[0];
  motions[1] = opposite(found[0]);
  if (is_double) return 2;
  motions[2] = found[1];
  motions[3] = opposite(found[1]);
  return 4;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
