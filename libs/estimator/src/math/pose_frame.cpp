#include <algorithm>
#include <cmath>

#include "math/jacobi_eigen.h"
#include "math/pnp_small.h"
#include "math/pose_form.h"
#include "math/tangents.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pnp {
namespace {

// Variance across the longest axis, of variance 1 in all, below which points are on a line;
// rounding makes 1e-16 of it.
constexpr double kLeastWidth = 1e-14;

// A rotation, in rows, that takes the direction to z; the identity where there is none.
void axesAlong(const double* sum, double n, double* axes) noexcept {
  const double length = std::sqrt(dot3(sum, sum));
  if (!(length > 0.1 * n)) {
    for (int i = 0; i < 9; ++i) axes[i] = i % 4 == 0 ? 1 : 0;
    return;
  }
  const Vec3d z = {{sum[0] / length, sum[1] / length, sum[2] / length}};
  Vec3d x, y;
  tangentsOf(z, x, y);
  for (std::size_t i = 0; i < 3; ++i) {
    axes[i] = x[i];
    axes[3 + i] = y[i];
    axes[6 + i] = z[i];
  }
}

}  // namespace

bool PoseFrame::isWide() const noexcept {
  return spread[1] > kLeastWidth;
}

bool PoseFrame::set(const Rays& rays) noexcept {
  const std::size_t n = rays.size();
  const double n_inverse = 1 / static_cast<double>(n);
  // From the first point on, so that far coordinates cost no digits.
  const Vec3d first = rays.points[0];
  const Vec3d first_origin = rays.origins.empty() ? Vec3d{} : rays.origins[0];
  double mean[3] = {}, bearing[3] = {}, mean_origin[3] = {}, scatter[3][3] = {};
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d d = rays.points[i] - first;
    for (std::size_t k = 0; k < 3; ++k) {
      mean[k] += d[k];
      bearing[k] += rays.bearings[i][k];
      for (std::size_t c = k; c < 3; ++c) scatter[k][c] += d[k] * d[c];
    }
  }
  for (std::size_t i = 0; i < rays.origins.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) mean_origin[k] += rays.origins[i][k] - first_origin[k];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    mean[k] *= n_inverse;
    world_centre[k] = first[k] + mean[k];
    origin[k] = first_origin[k] + mean_origin[k] * n_inverse;
  }
  axesAlong(bearing, static_cast<double>(n), camera_axes);

  double variance = 0;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = r; c < 3; ++c)
      scatter[r][c] = scatter[r][c] * n_inverse - mean[r] * mean[c];
    variance += scatter[r][r];
  }
  scale = std::sqrt(variance);
  inverse_scale = 1 / scale;
  const double sum = dot3(bearing, bearing) + dot3(origin.data(), origin.data());
  if (!(variance > 1e-200 && variance < 1e200 && sum < 1e200)) return false;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c <= r; ++c) {
      scatter[c][r] /= variance;
      scatter[r][c] = scatter[c][r];
    }
  }
  const JacobiEigen<3> eigen(scatter);
  for (std::size_t k = 0; k < 3; ++k) {
    spread[k] = std::max(eigen.values[2 - k], 0.0);
    for (std::size_t c = 0; c < 3; ++c) world_axes[3 * k + c] = eigen.vectors[2 - k][c];
  }
  cross3(world_axes, world_axes + 3, world_axes + 6);
  return true;
}

bool PoseFrame::setPose(const double* q, const double* t, SE3d& pose) const {
  double columns[9], rotation[9], left[9];
  columnsOfQuaternion(q, columns);
  // camera_axes^T R world_axes, in columns: first camera_axes^T of the columns of R.
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      left[3 * j + i] = camera_axes[i] * columns[3 * j] + camera_axes[3 + i] * columns[3 * j + 1] +
                        camera_axes[6 + i] * columns[3 * j + 2];
    }
  }
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      rotation[3 * j + i] = left[i] * world_axes[j] + left[3 + i] * world_axes[3 + j] +
                            left[6 + i] * world_axes[6 + j];
    }
  }
  double whole[4];
  quaternionOfColumns(rotation, whole);
  if (!std::isfinite(whole[0] + whole[1] + whole[2] + whole[3])) return false;
  const SO3d r = SO3d::fromQuaternion(whole[0], whole[1], whole[2], whole[3]);
  const Vec3d moved = r * world_centre;
  Vec3d translation;
  for (std::size_t i = 0; i < 3; ++i) {
    translation[i] =
        scale * (camera_axes[i] * t[0] + camera_axes[3 + i] * t[1] + camera_axes[6 + i] * t[2]) +
        origin[i] - moved[i];
  }
  if (!std::isfinite(translation[0] + translation[1] + translation[2])) return false;
  pose = SE3d(r, translation);
  return true;
}

// S. Shepperd, "Quaternion from rotation matrix", 1978: by the largest of the four.
void quaternionOfColumns(const double* r, double* q) noexcept {
  const double trace = r[0] + r[4] + r[8];
  int largest = 3;
  double value = trace;
  for (int i = 0; i < 3; ++i) {
    if (r[4 * i] > value) {
      largest = i;
      value = r[4 * i];
    }
  }
  if (largest == 3) {
    q[0] = r[5] - r[7], q[1] = r[6] - r[2], q[2] = r[1] - r[3], q[3] = 1 + trace;
  } else {
    const int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = 1 + 2 * r[4 * i] - trace;
    q[j] = r[3 * j + i] + r[3 * i + j];
    q[k] = r[3 * k + i] + r[3 * i + k];
    q[3] = r[3 * j + k] - r[3 * k + j];
  }
  const double inverse = 1 / std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; ++i) q[i] *= inverse;
}

bool rotationOfTwoColumns(const double* r, double* rotation) noexcept {
  // (c1, c2) M^-1/2 with M their products, whose square root is (M + s I) / sqrt(tr M + 2 s).
  const double a = dot3(r, r), b = dot3(r, r + 3), c = dot3(r + 3, r + 3);
  const double determinant = a * c - b * b;
  if (!(determinant > 1e-14 * (a + c) * (a + c))) return false;
  const double s = std::sqrt(determinant);
  const double factor = std::sqrt(a + c + 2 * s) / ((a + s) * (c + s) - b * b);
  for (int i = 0; i < 3; ++i) {
    rotation[i] = factor * ((c + s) * r[i] - b * r[3 + i]);
    rotation[3 + i] = factor * ((a + s) * r[3 + i] - b * r[i]);
  }
  cross3(rotation, rotation + 3, rotation + 6);
  return true;
}

}  // namespace pnp
}  // namespace detail
}  // namespace v1
}  // namespace gslam
