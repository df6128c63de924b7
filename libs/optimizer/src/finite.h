#ifndef GSLAM_OPTIMIZER_SRC_FINITE_H
#define GSLAM_OPTIMIZER_SRC_FINITE_H

#include <cmath>
#include <cstddef>

// Whether many numbers are finite, in one pass without branches.

namespace gslam {
inline namespace v1 {
namespace detail {

inline bool allFinite(const double* values, std::size_t count) noexcept {
  // x - x is 0 where x is finite, else NaN. Four sums, so that they do not wait for each other.
  double sums[4] = {0, 0, 0, 0};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sums[k] += values[i + k] - values[i + k];
  }
  for (; i < count; ++i) sums[0] += values[i] - values[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]) == 0;
}

// Of a type that is nothing but double: Vec, Mat, SE2, SE3, SIM3.
template <class T>
bool isFinite(const T& value) noexcept {
  return allFinite(value.data(), sizeof(T) / sizeof(double));
}
inline bool isFinite(double value) noexcept {
  return std::isfinite(value);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FINITE_H
