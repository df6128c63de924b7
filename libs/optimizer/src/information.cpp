#include "information.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "finite.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Cholesky in place, without its result: the smallest pivot. A must be symmetric.
double leastPivot(double* a, std::size_t n) {
  double least = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = a[k * n + k];
    least = std::min(least, pivot);
    if (!(pivot > 0)) return least;
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / pivot;
      if (factor == 0) continue;
      for (std::size_t j = k + 1; j <= i; ++j) a[i * n + j] -= factor * a[j * n + k];
    }
  }
  return least;
}

InformationKind kindOf(const double* values, std::size_t n, std::size_t stride, double rounding,
                       double* scaled) {
  // With a diagonal of ones: metres and radians may differ by many orders.
  bool has_zero = false;
  for (std::size_t i = 0; i < n; ++i) {
    const double d = values[i * stride + i];
    if (d < 0) return InformationKind::Indefinite;
    has_zero = has_zero || d == 0;
    for (std::size_t j = 0; j < i; ++j) {
      const double bound = std::sqrt(d) * std::sqrt(values[j * stride + j]);
      const double lower = values[i * stride + j], upper = values[j * stride + i];
      if (!(std::abs(lower - upper) <= rounding * bound)) return InformationKind::NotSymmetric;
      if (!(std::abs(lower) <= bound * (1 + rounding))) return InformationKind::Indefinite;
      scaled[i * n + j] = bound == 0 ? 0 : 0.5 * (lower + upper) / bound;
    }
    scaled[i * n + i] = 1 + rounding;
  }
  const double least = leastPivot(scaled, n);
  if (!(least > 0)) return InformationKind::Indefinite;
  // Each pivot of a singular matrix may have gained `rounding` a few times.
  return has_zero || least < 4 * static_cast<double>(n) * rounding ? InformationKind::Singular
                                                                   : InformationKind::Definite;
}

}  // namespace

InformationKind informationKind(const double* values, std::size_t n, std::size_t stride,
                                double rounding) {
  for (std::size_t i = 0; i < n; ++i) {
    if (!allFinite(values + i * stride, n)) return InformationKind::NotFinite;
  }
  constexpr std::size_t kSmall = 7;
  if (n <= kSmall) {
    double scaled[kSmall * kSmall];
    return kindOf(values, n, stride, rounding, scaled);
  }
  std::vector<double> scaled(n * n);
  return kindOf(values, n, stride, rounding, scaled.data());
}

const char* complaintAbout(InformationKind kind) noexcept {
  switch (kind) {
    case InformationKind::NotFinite:
      return "holds a number that is not finite";
    case InformationKind::NotSymmetric:
      return "is not symmetric";
    case InformationKind::Indefinite:
      return "is not positive semi-definite";
    case InformationKind::Definite:
    case InformationKind::Singular:
      break;
  }
  return "";
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
