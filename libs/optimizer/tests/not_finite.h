// Numbers that no problem may hold.
#ifndef GSLAM_OPTIMIZER_TESTS_NOT_FINITE_H
#define GSLAM_OPTIMIZER_TESTS_NOT_FINITE_H

#include <limits>

namespace not_finite {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace not_finite

#endif  // GSLAM_OPTIMIZER_TESTS_NOT_FINITE_H
