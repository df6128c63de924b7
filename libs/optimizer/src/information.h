#ifndef GSLAM_OPTIMIZER_SRC_INFORMATION_H
#define GSLAM_OPTIMIZER_SRC_INFORMATION_H

#include <cmath>
#include <cstddef>

// What kind of matrix an information is.

namespace gslam {
inline namespace v1 {
namespace detail {

enum class InformationKind {
  Definite,      // has an inverse
  Singular,      // positive semi-definite, without an inverse
  NotFinite,     // holds a NaN or an infinity
  NotSymmetric,  // beyond rounding
  Indefinite     // some residual would have a negative cost
};

// @param values  (n x n), row by row, rows `stride` apart
// @param rounding  how far from symmetric and semi-definite it may be, as part of its diagonal
InformationKind informationKind(const double* values, std::size_t n, std::size_t stride,
                                double rounding = 1e-9);

// For messages: "is not symmetric, expected ..."; empty for what is semi-definite.
const char* complaintAbout(InformationKind kind) noexcept;

// xx, xy, yy of a 2 x 2 matrix that is finite.
inline bool isSemiDefinite2(double xx, double xy, double yy) noexcept {
  // Roots, since products may overflow and vanish.
  return xx >= 0 && yy >= 0 && std::fabs(xy) <= std::sqrt(xx) * std::sqrt(yy) * (1 + 5e-10);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_INFORMATION_H
