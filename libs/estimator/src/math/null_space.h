// The matrices on which epipolar constraints leave no condition.
#ifndef GSLAM_ESTIMATOR_MATH_NULL_SPACE_H
#define GSLAM_ESTIMATOR_MATH_NULL_SPACE_H

#include <gslam/geometry/detail/pair.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// A vector of nine numbers, the elements of a 3 x 3 matrix row by row, and a zero that makes pairs.
struct alignas(16) Row9 {
  double values[10];

  Pair<double> pair(std::size_t i) const noexcept { return Pair<double>::load(values + 2 * i); }
  void setPair(std::size_t i, Pair<double> pair) noexcept { pair.store(values + 2 * i); }
};

inline double dot(const Row9& a, const Row9& b) noexcept {
  const Pair<double> even = a.pair(0) * b.pair(0) + a.pair(2) * b.pair(2);
  const Pair<double> odd = a.pair(1) * b.pair(1) + a.pair(3) * b.pair(3);
  const Pair<double> sum = even + (odd + a.pair(4) * b.pair(4));
  return sum.first() + sum.second();
}

// a += factor b
inline void add(double factor, const Row9& b, Row9& a) noexcept {
  const Pair<double> both = Pair<double>::both(factor);
  for (std::size_t i = 0; i < 5; ++i) a.setPair(i, a.pair(i) + both * b.pair(i));
}

// The constraint second^T M first = 0 on the elements of M.
inline void setEpipolarRow(const double* first, const double* second, Row9& row) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) row.values[3 * i + j] = second[i] * first[j];
  }
  row.values[9] = 0;
}

// 9 - M orthonormal vectors at right angles to M rows, which are overwritten. Householder
// reflections without exchanges: the vectors are right angled to rows that differ from the given
// ones by rounding, whatever their rank. Of rows of lower rank, not all of the null space.
template <std::size_t M>
inline void nullSpace(Row9 (&rows)[M], Row9 (&basis)[9 - M]) noexcept {
  double factors[M];
  for (std::size_t k = 0; k < M; ++k) {
    Row9& v = rows[k];
    for (std::size_t i = 0; i < k; ++i) v.values[i] = 0;
    const double squared = dot(v, v);
    const double pivot = v.values[k];
    const double length = std::copysign(std::sqrt(squared), pivot);
    // I - factor v v^T takes the row to a multiple of unit vector k.
    v.values[k] = pivot + length;
    const double half = squared + pivot * length;  // |v|^2 / 2
    factors[k] = half > 1e-290 ? 1 / half : 0;
    for (std::size_t j = k + 1; j < M; ++j) add(-factors[k] * dot(v, rows[j]), v, rows[j]);
  }
  for (std::size_t n = 0; n < 9 - M; ++n) {
    Row9& b = basis[n];
    const double factor = -factors[M - 1] * rows[M - 1].values[M + n];
    const Pair<double> both = Pair<double>::both(factor);
    for (std::size_t i = 0; i < 5; ++i) b.setPair(i, both * rows[M - 1].pair(i));
    b.values[M + n] += 1;
    for (std::size_t k = M - 1; k-- > 0;) add(-factors[k] * dot(rows[k], b), rows[k], b);
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_NULL_SPACE_H
