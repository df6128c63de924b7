#include <gslam/base/platform.h>

#include <algorithm>
#include <cmath>

#include "math/jacobi_eigen.h"
#include "math/pnp_small.h"
#include "math/pose_form.h"
#include "math/quaternion.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pnp {
namespace {

constexpr double kLongestStep = 1;          // radian
constexpr double kConvergedSquare = 1e-10;  // radian^2: the next step would be below 1e-9

// q (w / 2, 1), of length 1: agrees with the exponential map to the second order.
void turnOnRight(const Quaternion& q, const double* w, Quaternion& result) noexcept {
  const Quaternion step = {0.5 * w[0], 0.5 * w[1], 0.5 * w[2], 1};
  multiply(q, step, result);
  (void)normalize(result);
}

// Solves with the 3 x 3 matrix of six elements; false where it is not positive.
bool solvePositive(const double* h, const double* g, double* x) noexcept {
  const double a = h[0];
  const double least = 1e-14 * (std::fabs(h[0]) + std::fabs(h[3]) + std::fabs(h[5]));
  if (!(a > least)) return false;
  const double l10 = h[1] / a, l20 = h[2] / a;
  const double b = h[3] - l10 * h[1];
  if (!(b > least)) return false;
  const double m21 = h[4] - l20 * h[1];
  const double l21 = m21 / b;
  const double c = h[5] - l20 * h[2] - l21 * m21;
  if (!(c > least)) return false;
  const double y1 = g[1] - l10 * g[0];
  const double y2 = g[2] - l20 * g[0] - l21 * y1;
  x[2] = y2 / c;
  x[1] = y1 / b - l21 * x[2];
  x[0] = g[0] / a - l10 * x[1] - l20 * x[2];
  return true;
}

// Gradient and Hessian, halves of both, by w in R exp(w); r and y as in halfGradient().
void differentiate(const PoseForm& form, const double* r, const double* y, double* g,
                   double* h) noexcept {
  const double *c1 = r, *c2 = r + 3, *c3 = r + 6;
  // r changes by (0, c3, -c2), (-c3, 0, c1), (c2, -c1, 0).
  double j[3][3][3];
  for (int i = 0; i < 3; ++i) {
    j[0][0][i] = j[1][1][i] = j[2][2][i] = 0;
    j[0][1][i] = c3[i], j[0][2][i] = -c2[i];
    j[1][0][i] = -c3[i], j[1][2][i] = c1[i];
    j[2][0][i] = c2[i], j[2][1][i] = -c1[i];
  }
  for (int k = 0; k < 3; ++k) {
    const int a = k == 0 ? 1 : 0, b = k == 2 ? 1 : 2;
    g[k] = dot3(j[k][a], y + 3 * a) + dot3(j[k][b], y + 3 * b);
    double v[PoseForm::kStride] = {};
    addColumns(form, 3 * a, j[k][a], v);
    addColumns(form, 3 * b, j[k][b], v);
    for (int l = k; l < 3; ++l) {
      h[kSix[k][l]] = dot3(j[l][0], v) + dot3(j[l][1], v + 3) + dot3(j[l][2], v + 6);
    }
  }
  // The second order of R exp(w) is R (w w^T - |w|^2 I) / 2.
  double s[3][3];
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) s[k][l] = dot3(r + 3 * k, y + 3 * l);
  }
  for (int k = 0; k < 3; ++k) {
    for (int l = k; l < 3; ++l) h[kSix[k][l]] += 0.5 * (s[k][l] + s[l][k]);
  }
  const double trace = s[0][0] + s[1][1] + s[2][2];
  h[0] -= trace, h[3] -= trace, h[5] -= trace;
}

// A way down where the Hessian has negative curvatures: Newton's step with their magnitudes, along
// each principal direction at most so long as is sensible, so that steep directions do not hide
// flat ones. (Y. Dauphin et al., "Identifying and attacking the saddle point problem in
// high-dimensional non-convex optimization", NeurIPS 2014)
GSLAM_COLD void stepFromSaddle(const double* g, const double* h, double* step) noexcept {
  double m[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) m[i][k] = h[kSix[i][k]];
  }
  const JacobiEigen<3> eigen(m);
  step[0] = step[1] = step[2] = 0;
  for (int i = 0; i < 3; ++i) {
    const double slope = dot3(eigen.vectors[i], g);
    const double length = slope / (std::fabs(eigen.values[i]) + 1e-300);
    const double limited = std::min(kLongestStep, std::max(-kLongestStep, length));
    for (int k = 0; k < 3; ++k) step[k] -= limited * eigen.vectors[i][k];
  }
}

void chooseStep(const double* g, const double* h, double* step) noexcept {
  if (!solvePositive(h, g, step)) {
    stepFromSaddle(g, h, step);
    return;
  }
  const double length = std::sqrt(dot3(step, step));
  const double factor = length > kLongestStep ? -kLongestStep / length : -1;
  for (int i = 0; i < 3; ++i) step[i] *= factor;
}

}  // namespace

double descend(const PoseForm& form, Quaternion& q) noexcept {
  double r[9], y[PoseForm::kStride];
  columnsOfQuaternion(q, r);
  halfGradient(form, r, y);
  double cost = costOf(form, r, y);
  for (int iteration = 0; iteration < 25; ++iteration) {
    double g[3], h[6], step[3];
    differentiate(form, r, y, g, h);
    chooseStep(g, h, step);
    bool is_lower = false;
    double square = dot3(step, step);
    for (int halving = 0; halving < 6 && !is_lower; ++halving) {
      double next[4], next_r[9], next_y[PoseForm::kStride];
      turnOnRight(q, step, next);
      columnsOfQuaternion(next, next_r);
      halfGradient(form, next_r, next_y);
      const double next_cost = costOf(form, next_r, next_y);
      is_lower = next_cost <= cost;
      if (is_lower || square < 1e-12) {  // rounding hides the rest of the way
        std::copy(next, next + 4, q);
        std::copy(next_r, next_r + 9, r);
        std::copy(next_y, next_y + PoseForm::kStride, y);
        cost = next_cost;
        break;
      }
      for (double& value : step) value *= 0.25;
      square = dot3(step, step);
    }
    if (!is_lower || square < kConvergedSquare) break;
  }
  return cost;
}

}  // namespace pnp
}  // namespace detail
}  // namespace v1
}  // namespace gslam
