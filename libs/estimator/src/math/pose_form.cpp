#include "math/pose_form.h"

#include <cmath>

#include "math/pnp_small.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pnp {
namespace {

// Sums over the rays, as the form needs them.
struct PoseSums {
  double weighted[10][6] = {};  // x_j x_k P (6), x_j P (3), P; P in six elements
  double depth[3][3] = {};      // x_j b
  double bearing[3] = {};
  double pull[4][3] = {};  // x_j P o (3), P o
  double constant = 0;     // o^T P o
  double depth_0 = 0;      // b^T o

  void add(const double* x, const double* b) noexcept {
    const double xx = b[0] * b[0], yy = b[1] * b[1], zz = b[2] * b[2];
    // 1 - zz with all digits.
    const double p[6] = {yy + zz, -b[0] * b[1], -b[0] * b[2], xx + zz, -b[1] * b[2], xx + yy};
    const double w[10] = {x[0] * x[0], x[0] * x[1], x[0] * x[2], x[1] * x[1], x[1] * x[2],
                          x[2] * x[2], x[0],        x[1],        x[2],        1};
    for (int i = 0; i < 10; ++i) {
      for (int k = 0; k < 6; ++k) weighted[i][k] += w[i] * p[k];
    }
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) depth[j][k] += x[j] * b[k];
      bearing[j] += b[j];
    }
  }
  void addOrigin(const double* x, const double* b, const double* o) noexcept {
    const double along = dot3(b, o);
    for (int k = 0; k < 3; ++k) {
      const double p = o[k] - along * b[k];
      for (int j = 0; j < 3; ++j) pull[j][k] += x[j] * p;
      pull[3][k] += p;
      constant += o[k] * p;
    }
    depth_0 += along;
  }
};

}  // namespace

bool PoseForm::set(const Rays& rays, const PoseFrame& frame) noexcept {
  PoseSums sums;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    double x[3] = {}, b[3] = {}, o[3] = {};
    frame.load(rays, i, x, b, o);
    sums.add(x, b);
    if (!rays.origins.empty()) sums.addOrigin(x, b, o);
  }
  const double n_inverse = 1 / static_cast<double>(rays.size());

  // t = -C^-1 (B r - p): z last, whose pivot may be small and is right all the same.
  double c[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) c[i][k] = sums.weighted[9][kSix[i][k]];
  }
  double b[10][3], solved[10][3];
  for (int j = 0; j < 3; ++j) {
    for (int a = 0; a < 3; ++a) {
      for (int i = 0; i < 3; ++i) b[3 * j + a][i] = -sums.weighted[6 + j][kSix[i][a]];
    }
  }
  for (int i = 0; i < 3; ++i) b[9][i] = sums.pull[3][i];
  for (int k = 0; k < 10; ++k) {
    for (int i = 0; i < 3; ++i) solved[k][i] = b[k][i];
  }
  const double trace = c[0][0] + c[1][1] + c[2][2];
  if (!solveSymmetric<3, 10>(c, 1e-28 * trace, solved)) return false;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 9; ++k) translation[i][k] = solved[k][i];
    translation_0[i] = solved[9][i];
  }

  double sum = 0;
  for (std::size_t k = 0; k < 9; ++k) {
    for (std::size_t l = k; l < 9; ++l) {
      const double full = sums.weighted[kSix[k / 3][l / 3]][kSix[k % 3][l % 3]];
      const double value = n_inverse * (full - dot3(b[k], solved[l]));
      omega[kStride * k + l] = omega[kStride * l + k] = value;
      sum += value;
    }
    omega[kStride * k + 9] = 0;
    linear[k] = n_inverse * (-sums.pull[k / 3][k % 3] - dot3(b[k], solved[9]));
    depth[k] = sums.depth[k / 3][k % 3];
    for (int i = 0; i < 3; ++i) depth[k] += sums.bearing[i] * translation[i][k];
    depth[k] *= n_inverse;
    sum += linear[k] + depth[k];
  }
  constant = n_inverse * (sums.constant - dot3(b[9], solved[9]));
  depth_0 = n_inverse * (dot3(sums.bearing, translation_0) - sums.depth_0);
  return std::isfinite(sum + constant + depth_0);
}

double PoseForm::cost(const double* r) const noexcept {
  double y[kStride];
  halfGradient(*this, r, y);
  return costOf(*this, r, y);
}

double PoseForm::meanDepth(const double* r) const noexcept {
  double sum = depth_0;
  for (int i = 0; i < 9; ++i) sum += depth[i] * r[i];
  return sum;
}

void PoseForm::translationOf(const double* r, double* t) const noexcept {
  for (int i = 0; i < 3; ++i) {
    t[i] = translation_0[i];
    for (int k = 0; k < 9; ++k) t[i] += translation[i][k] * r[k];
  }
}

}  // namespace pnp
}  // namespace detail
}  // namespace v1
}  // namespace gslam
