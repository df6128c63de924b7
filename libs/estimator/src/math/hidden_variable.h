// Nister's way from the ten reduced equations to a polynomial in one unknown.
#ifndef GSLAM_ESTIMATOR_MATH_HIDDEN_VARIABLE_H
#define GSLAM_ESTIMATOR_MATH_HIDDEN_VARIABLE_H

#include <gslam/base/platform.h>

#include <cmath>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// B(z) (x, y, 1)^T = 0, where B has the elements b[i][0], b[i][1] of degree 3 and b[i][2] of degree
// 4, constants first (Nister 2004, equations 22 to 27).
struct HiddenVariable {
  double b[3][3][5];
  double minors[3][7];  // of the first two columns, without row 0, 1, 2; signed

  // From the rows of x2z, x2, y2z, y2, xyz, xy of the reduced system, elements 10 to 19.
  explicit HiddenVariable(double* const (&row)[10]) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      const double* const p = row[4 + 2 * i] + 10;  // the multiple by z
      const double* const q = row[5 + 2 * i] + 10;
      const double x[5] = {p[2], p[1] - q[2], p[0] - q[1], -q[0], 0};
      const double y[5] = {p[5], p[4] - q[5], p[3] - q[4], -q[3], 0};
      const double one[5] = {p[9], p[8] - q[9], p[7] - q[8], p[6] - q[7], -q[6]};
      for (std::size_t k = 0; k < 5; ++k) {
        b[i][0][k] = x[k];
        b[i][1][k] = y[k];
        b[i][2][k] = one[k];
      }
    }
    setMinor(1, 2, minors[0]);
    setMinor(2, 0, minors[1]);
    setMinor(0, 1, minors[2]);
  }

  // det B, constant first.
  void determinant(double (&c)[11]) const noexcept {
    for (double& value : c) value = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 7; ++k) {
        for (std::size_t l = 0; l < 5; ++l) c[k + l] += minors[i][k] * b[i][2][l];
      }
    }
  }

  // (x y z w) at the root z : w = t : u, up to scale; not finite or zero where there is none.
  void solution(double t, double u, double (&v)[4]) const noexcept {
    const double t2 = t * t, u2 = u * u;
    const double cubic[4] = {u2 * u, t * u2, t2 * u, t2 * t};
    const double quartic[5] = {u2 * u2, t * u2 * u, t2 * u2, t2 * t * u, t2 * t2};
    double m[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        const double(&p)[5] = b[i][j];
        m[i][j] = (p[0] * cubic[0] + p[1] * cubic[1]) + (p[2] * cubic[2] + p[3] * cubic[3]);
      }
      const double(&p)[5] = b[i][2];
      m[i][2] = (p[0] * quartic[0] + p[1] * quartic[1]) + (p[2] * quartic[2] + p[3] * quartic[3]) +
                p[4] * quartic[4];
    }
    // The longest cross product of two rows.
    double best = -1;
    v[0] = v[1] = v[2] = v[3] = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double* const a = m[i];
      const double* const c = m[i == 2 ? 0 : i + 1];
      const double x = a[1] * c[2] - a[2] * c[1];
      const double y = a[2] * c[0] - a[0] * c[2];
      const double one = a[0] * c[1] - a[1] * c[0];
      const double squared = x * x + y * y + one * one;
      if (!(squared > best)) continue;
      best = squared;
      v[0] = x;
      v[1] = y;
      v[2] = t * one;
      v[3] = u * one;
    }
  }

 private:
  void setMinor(std::size_t i, std::size_t j, double (&minor)[7]) const noexcept {
    for (double& value : minor) value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t l = 0; l < 4; ++l) {
        minor[k + l] += b[i][0][k] * b[j][1][l] - b[i][1][k] * b[j][0][l];
      }
    }
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_HIDDEN_VARIABLE_H
