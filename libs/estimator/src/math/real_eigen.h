// Real eigenvalues and their vectors of small matrices without symmetry.
#ifndef GSLAM_ESTIMATOR_MATH_REAL_EIGEN_H
#define GSLAM_ESTIMATOR_MATH_REAL_EIGEN_H

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

// Elimination to Hessenberg form, Francis' double QR steps for the eigenvalues only, and inverse
// iteration for the vectors of the real ones (G. Golub, C. Van Loan, "Matrix Computations", 4th
// edition, 2013, sections 7.4, 7.5 and 7.6.1). For one matrix in millions the steps do not end, and
// the eigenvalues found so far are given.
template <std::size_t N>
class RealEigen {
 public:
  // Of a matrix of finite elements.
  explicit RealEigen(const double (&a)[N][N]) noexcept {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) hessenberg_[i][j] = a[i][j];
    }
    for (std::size_t k = 1; k + 1 < N; ++k) eliminate(k);
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) {
        h_[i][j] = j + 1 >= i ? hessenberg_[i][j] : 0;
        norm_ += std::fabs(h_[i][j]);
      }
    }
    findValues();
  }

  std::size_t size() const noexcept { return size_; }
  double value(std::size_t i) const noexcept { return values_[i]; }

  // Of any length but zero. May not be finite where the matrix is defective.
  void vector(double value, double (&v)[N]) const noexcept {
    double u[N][N];
    for (std::size_t j = 0; j < N; ++j) u[0][j] = hessenberg_[0][j];
    u[0][0] -= value;
    const double least = DBL_EPSILON * norm_ / static_cast<double>(N);
    // Upper triangle by the choice of one of two rows.
    for (std::size_t k = 0; k + 1 < N; ++k) {
      double* const p = u[k];
      double* const q = u[k + 1];
      for (std::size_t j = k; j < N; ++j) q[j] = hessenberg_[k + 1][j];
      q[k + 1] -= value;
      if (std::fabs(q[k]) > std::fabs(p[k])) {
        for (std::size_t j = k; j < N; ++j) std::swap(p[j], q[j]);
      }
      if (!(std::fabs(p[k]) > least)) p[k] = least;
      const double factor = q[k] / p[k];
      for (std::size_t j = k + 1; j < N; ++j) q[j] -= factor * p[j];
    }
    if (!(std::fabs(u[N - 1][N - 1]) > least)) u[N - 1][N - 1] = least;
    for (std::size_t i = N; i-- > 0;) {
      double sum = 1e-8;  // the right side, any but zero
      for (std::size_t j = i + 1; j < N; ++j) sum -= u[i][j] * v[j];
      v[i] = sum / u[i][i];
    }
    for (std::size_t k = N - 2; k > 0; --k) {
      for (std::size_t i = k + 1; i < N; ++i) v[i] += hessenberg_[i][k - 1] * v[k];
      std::swap(v[k], v[exchanged_[k]]);
    }
  }

 private:
  // Column k - 1 below the subdiagonal. The factors take the place of the zeros.
  void eliminate(std::size_t k) noexcept {
    double(&h)[N][N] = hessenberg_;
    std::size_t best = k;
    for (std::size_t i = k + 1; i < N; ++i) {
      if (std::fabs(h[i][k - 1]) > std::fabs(h[best][k - 1])) best = i;
    }
    exchanged_[k] = best;
    if (best != k) {
      for (std::size_t j = k - 1; j < N; ++j) std::swap(h[best][j], h[k][j]);
      for (std::size_t i = 0; i < N; ++i) std::swap(h[i][best], h[i][k]);
    }
    if (h[k][k - 1] == 0) {
      for (std::size_t i = k + 1; i < N; ++i) h[i][k - 1] = 0;
      return;
    }
    const double inverse = 1 / h[k][k - 1];
    double factors[N];
    for (std::size_t i = k + 1; i < N; ++i) {
      const double factor = h[i][k - 1] * inverse;
      factors[i] = factor;
      h[i][k - 1] = factor;
      for (std::size_t j = k; j < N; ++j) h[i][j] -= factor * h[k][j];
    }
    for (std::size_t i = 0; i < N; ++i) {
      double sum = h[i][k];
      for (std::size_t j = k + 1; j < N; ++j) sum += factors[j] * h[i][j];
      h[i][k] = sum;
    }
  }

  void findValues() noexcept {
    if (!(norm_ <= DBL_MAX)) return;
    std::size_t end = N;  // h_ from `end` on is done
    int steps = 0;
    while (end > 0) {
      const std::size_t last = end - 1;
      std::size_t low = last;
      for (; low > 0; --low) {
        const double diagonal = std::fabs(h_[low - 1][low - 1]) + std::fabs(h_[low][low]);
        if (std::fabs(h_[low][low - 1]) <= DBL_EPSILON * (diagonal > 0 ? diagonal : norm_)) break;
      }
      if (low == last) {
        values_[size_++] = h_[last][last];
        end -= 1;
        steps = 0;
      } else if (low + 1 == last) {
        takePair(h_[low][low], h_[low][last], h_[last][low], h_[last][last]);
        end -= 2;
        steps = 0;
      } else {
        if (++steps > 40) return;
        step(low, last, steps % 10 == 0);
      }
    }
  }

  void takePair(double a, double b, double c, double d) noexcept {
    const double half = 0.5 * (a - d);
    const double discriminant = half * half + b * c;
    if (!(discriminant >= 0)) return;
    const double root = half + std::copysign(std::sqrt(discriminant), half);
    values_[size_++] = d + root;
    values_[size_++] = root != 0 ? d - b * c / root : d;
  }

  // A double step on rows and columns low to last; columns and rows beyond are not needed for
  // values.
  void step(std::size_t low, std::size_t last, bool unusual) noexcept {
    double trace = h_[last - 1][last - 1] + h_[last][last];
    double det = h_[last - 1][last - 1] * h_[last][last] - h_[last - 1][last] * h_[last][last - 1];
    if (unusual) {  // breaks a cycle
      const double size = std::fabs(h_[last][last - 1]) + std::fabs(h_[last - 1][last - 2]);
      trace = 1.5 * size;
      det = size * size;
    }
    const double a = h_[low][low], b = h_[low][low + 1];
    const double c = h_[low + 1][low], d = h_[low + 1][low + 1];
    double x = a * a + b * c - trace * a + det;
    double y = c * (a + d - trace);
    double z = c * h_[low + 2][low + 1];
    for (std::size_t k = low; k + 1 < last; ++k) {
      reflect3(low, last, k, x, y, z);
      x = h_[k + 1][k];
      y = h_[k + 2][k];
      z = k + 2 < last ? h_[k + 3][k] : 0;
    }
    reflect2(low, last, x, y);
  }

  // The reflection that takes (x, y, z) to the first axis, on both sides.
  void reflect3(std::size_t low, std::size_t last, std::size_t k, double x, double y,
                double z) noexcept {
    const double norm = std::copysign(std::sqrt(x * x + y * y + z * z), x);
    if (norm == 0) return;
    const double head = x + norm;
    const double u = y / head, v = z / head, beta = head / norm;  // I - beta (1 u v)^T (1 u v)
    const double bu = beta * u, bv = beta * v;
    double* const p = h_[k];
    double* const q = h_[k + 1];
    double* const r = h_[k + 2];
    for (std::size_t j = k > low ? k - 1 : low; j <= last; ++j) {
      const double sum = p[j] + u * q[j] + v * r[j];
      p[j] -= beta * sum;
      q[j] -= bu * sum;
      r[j] -= bv * sum;
    }
    const std::size_t bottom = k + 3 < last ? k + 3 : last;
    for (std::size_t i = low; i <= bottom; ++i) {
      double* const t = h_[i] + k;
      const double sum = t[0] + u * t[1] + v * t[2];
      t[0] -= beta * sum;
      t[1] -= bu * sum;
      t[2] -= bv * sum;
    }
  }

  void reflect2(std::size_t low, std::size_t last, double x, double y) noexcept {
    const double norm = std::copysign(std::sqrt(x * x + y * y), x);
    if (norm == 0) return;
    const double head = x + norm;
    const double u = y / head, beta = head / norm;
    double* const p = h_[last - 1];
    double* const q = h_[last];
    for (std::size_t j = last - 2; j <= last; ++j) {
      const double sum = beta * (p[j] + u * q[j]);
      p[j] -= sum;
      q[j] -= u * sum;
    }
    for (std::size_t i = low; i <= last; ++i) {
      double* const t = h_[i] + last - 1;
      const double sum = beta * (t[0] + u * t[1]);
      t[0] -= sum;
      t[1] -= u * sum;
    }
  }

  double hessenberg_[N][N];  // with the factors of the elimination below the subdiagonal
  double h_[N][N];           // becomes triangular but for blocks of two
  std::size_t exchanged_[N];
  double norm_ = 0;
  double values_[N];
  std::size_t size_ = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_REAL_EIGEN_H
