#ifndef GSLAM_OPTIMIZER_PBA_SRC_SMALL_DENSE_H
#define GSLAM_OPTIMIZER_PBA_SRC_SMALL_DENSE_H

#include <gslam/geometry/detail/symmetric_eigen.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

// Normal equations of a handful of variables. Nothing is allocated.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// A unit diagonal leaves pivots of about 1e-16 to what is not determined; those that are, are the
// squares of sines of angles between columns of the Jacobian.
constexpr double kLeastPivot = 1e-13;

template <std::size_t N>
struct SmallEquations {
  Mat<double, N, N> hessian{};  // the upper triangle
  Vec<double, N> gradient{};

  // Adds weight J^T J and J^T pull, for one row of the Jacobian.
  void addRow(const double* row, double weight, double pull) {
    for (std::size_t i = 0; i < N; ++i) {
      const double left = weight * row[i];
      for (std::size_t j = i; j < N; ++j) hessian(i, j) += left * row[j];
      gradient[i] += row[i] * pull;
    }
  }

  double gradientMax() const {
    double most = 0;
    for (const double value : gradient.values) {
      if (!(std::fabs(value) <= most)) most = std::fabs(value);  // NaN is handed on
    }
    return most;
  }

  // By how much the quadratic model falls.
  double decrease(const Vec<double, N>& step) const {
    double linear = 0, square = 0;
    for (std::size_t i = 0; i < N; ++i) {
      linear += gradient[i] * step[i];
      double beside = 0;
      for (std::size_t j = i + 1; j < N; ++j) beside += hessian(i, j) * step[j];
      square += step[i] * (0.5 * hessian(i, i) * step[i] + beside);
    }
    return -(linear + square);
  }
};

// L D L^T of the upper triangle of a matrix; below it stands L, on it 1 / D.
template <std::size_t N>
bool factorSmall(Mat<double, N, N>& a, double least_pivot) {
  double pivots[N];
  for (std::size_t j = 0; j < N; ++j) {
    double scaled[N];
    double pivot = a(j, j);
    for (std::size_t k = 0; k < j; ++k) {
      scaled[k] = a(j, k) * pivots[k];
      pivot -= a(j, k) * scaled[k];
    }
    if (!(pivot > least_pivot)) return false;
    const double inverse = 1 / pivot;
    pivots[j] = pivot;
    a(j, j) = inverse;
    for (std::size_t i = j + 1; i < N; ++i) {
      double value = a(j, i);
      for (std::size_t k = 0; k < j; ++k) value -= a(i, k) * scaled[k];
      a(i, j) = value * inverse;
    }
  }
  return true;
}

template <std::size_t N>
void solveFactored(const Mat<double, N, N>& a, Vec<double, N>& b) {
  for (std::size_t i = 1; i < N; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a(i, k) * b[k];
  }
  for (std::size_t i = 0; i < N; ++i) b[i] *= a(i, i);
  for (std::size_t i = N - 1; i-- > 0;) {
    for (std::size_t k = i + 1; k < N; ++k) b[i] -= a(k, i) * b[k];
  }
}

// (H + damping diag H) step = -gradient. The diagonal is bounded from below, so that variables
// that nothing depends on stay where they are.
template <std::size_t N>
bool solveDamped(const SmallEquations<N>& equations, double damping, Vec<double, N>& step) {
  Mat<double, N, N> a = equations.hessian;
  double largest = 0;
  for (std::size_t i = 0; i < N; ++i) largest = std::max(largest, a(i, i));
  if (!(largest > 0)) return false;
  for (std::size_t i = 0; i < N; ++i) a(i, i) += damping * std::max(a(i, i), 1e-12 * largest);
  if (!factorSmall(a, 0.0)) return false;
  step = -equations.gradient;
  solveFactored(a, step);
  for (const double value : step.values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

// The last variables are angles, and the log of a scale; those before are lengths. Only within
// these two groups can the diagonal elements of a matrix be compared.
template <std::size_t N>
void largestOfGroups(const Mat<double, N, N>& hessian, double (&largest)[N]) {
  constexpr std::size_t kLengths = N == 5 ? 2 : 3;
  double most[2] = {};
  for (std::size_t i = 0; i < N; ++i) {
    double& group = most[i >= kLengths];
    group = std::max(group, hessian(i, i));
  }
  for (std::size_t i = 0; i < N; ++i) largest[i] = most[i >= kLengths];
}

// S H S with the scales on the diagonal of S: the upper triangle.
template <std::size_t N>
Mat<double, N, N> scaledSmall(const Mat<double, N, N>& hessian, const Vec<double, N>& scale) {
  Mat<double, N, N> a{};
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = i; j < N; ++j) a(i, j) = hessian(i, j) * scale[i] * scale[j];
  }
  return a;
}

// The inverse, where all variables are determined.
template <std::size_t N>
bool invertSmall(const Mat<double, N, N>& hessian, Mat<double, N, N>& inverse) {
  double largest[N];
  largestOfGroups(hessian, largest);
  Vec<double, N> scale;
  for (std::size_t i = 0; i < N; ++i) {
    if (!(hessian(i, i) > kLeastPivot * largest[i] && std::isfinite(hessian(i, i)))) return false;
    scale[i] = 1 / std::sqrt(hessian(i, i));
  }
  Mat<double, N, N> a = scaledSmall(hessian, scale);
  if (!factorSmall(a, kLeastPivot)) return false;
  // L^-T D^-1 L^-1, of which L^-1 takes the place of L.
  for (std::size_t j = 0; j < N; ++j) {
    for (std::size_t i = j + 1; i < N; ++i) {
      double sum = -a(i, j);
      for (std::size_t k = j + 1; k < i; ++k) sum -= a(i, k) * a(k, j);
      a(i, j) = sum;
    }
  }
  for (std::size_t c = 0; c < N; ++c) {
    for (std::size_t r = 0; r <= c; ++r) {
      double sum = (r == c ? 1.0 : a(c, r)) * a(c, c);
      for (std::size_t k = c + 1; k < N; ++k) sum += a(k, r) * a(k, k) * a(k, c);
      inverse(r, c) = inverse(c, r) = sum * scale[r] * scale[c];
    }
  }
  return true;
}

// As solveDamped(), but what nothing determines stays where it is, in all directions: of the steps
// that solve the equations it is the shortest. So lengths are damped alike, and so are angles;
// damped by their own diagonal elements, variables on which little depends would move most.
template <std::size_t N>
bool solveDetermined(const SmallEquations<N>& equations, double damping, Vec<double, N>& step) {
  constexpr double kSafePivot = 1e-9;
  double largest[N];
  largestOfGroups(equations.hessian, largest);
  Vec<double, N> scale;
  for (std::size_t i = 0; i < N; ++i) scale[i] = largest[i] > 0 ? 1 / std::sqrt(largest[i]) : 0;
  const Mat<double, N, N> scaled = scaledSmall(equations.hessian, scale);
  for (std::size_t i = 0; i < N; ++i) step[i] = -scale[i] * equations.gradient[i];
  for (const double value : scaled.values) {
    if (!std::isfinite(value)) return false;
  }
  Mat<double, N, N> a = scaled;
  for (std::size_t i = 0; i < N; ++i) a(i, i) += damping;
  if (factorSmall(a, kSafePivot)) {
    solveFactored(a, step);
  } else {
    const SymmetricEigen<double, N> eigen(scaled);
    Vec<double, N> along = eigen.vectors.transpose() * step;
    for (std::size_t i = 0; i < N; ++i) {
      const double value = eigen.values[i];
      along[i] = value > kLeastPivot ? along[i] / (value + damping) : 0.0;
    }
    step = eigen.vectors * along;
  }
  bool is_finite = true;
  for (std::size_t i = 0; i < N; ++i) {
    step[i] *= scale[i];
    is_finite = is_finite && std::isfinite(step[i]);
  }
  return is_finite;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_SMALL_DENSE_H
