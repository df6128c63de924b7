#include <gslam/estimator/solvers/triangulate_linear.h>

#include <cmath>
#include <limits>

#include "math/two_rays.h"

namespace gslam {
inline namespace v1 {
namespace {

// The least eigenvalue x of the 4 x 4 matrix is the least root of
//   rest - x (1 + sum of a_i / (q_i (q_i - x))),
// which falls and is concave up to the least q. q_i are the eigenvalues of the 3 x 3 part, rest is
// what is left at x = 0.
struct Secular {
  double a[3], q[3];
  double rest;

  double leastRoot() const noexcept {
    double low = 0;
    double high = std::fmin(q[0], q[1]);
    double x = rest / (1 + sum(0));
    for (int i = 0; i < 60; ++i) {
      if (!(x > low && x < high)) x = 0.5 * (low + high);
      double value = 1;
      double slope = 1;
      for (int k = 0; k < 3; ++k) {
        const double term = a[k] / (q[k] * (q[k] - x));
        value += term;
        slope += term * q[k] / (q[k] - x);
      }
      value = rest - x * value;
      (value > 0 ? low : high) = x;
      const double step = value / slope;
      x += step;
      if (!(std::fabs(step) > 1e-14 * x)) break;
    }
    return x;
  }

 private:
  double sum(double x) const noexcept {
    double result = 0;
    for (int k = 0; k < 3; ++k) result += a[k] / (q[k] * (q[k] - x));
    return result;
  }
};

}  // namespace

std::size_t triangulateLinear(const SE3d& T_second_first, const Vec3d& bearing_first,
                              const Vec3d& bearing_second, Vec3d& point_first) noexcept {
  const detail::TwoRays rays(T_second_first, bearing_first, bearing_second);
  const Vec3d& f = rays.f;
  const Vec3d& g = rays.g;
  const Vec3d n = f.cross(g);
  const Vec3d sum = f + g;
  const Vec3d difference = f - g;
  const double q0 = 0.5 * difference.squaredNorm();  // 1 - cosine, without cancellation
  const double q1 = 0.5 * sum.squaredNorm();         // 1 + cosine
  const double sine2 = n.squaredNorm();
  if (!(sine2 > detail::kLeastParallax)) return 0;
  const double along = g.cross(rays.c).dot(g.cross(f));
  const double beside = rays.c.dot(n);
  const double skew = beside * beside / sine2;
  const double along2 = 0.5 * along * along;
  const Secular secular = {{along2 / q1, along2 / q0, skew}, {q0, q1, 2}, 0.5 * skew};
  const double x = skew > 0 ? secular.leastRoot() : 0;
  const double half = 0.5 * along;
  const Vec3d point = (half / (q1 * (q0 - x))) * sum + (half / (q0 * (q1 - x))) * difference +
                      (beside / (sine2 * (2 - x))) * n;
  if (!(point.squaredNorm() <= std::numeric_limits<double>::max())) return 0;
  if (!(point.dot(f) > 0 && (point - rays.c).dot(g) > 0)) return 0;
  point_first = point;
  return 1;
}

}  // namespace v1
}  // namespace gslam
