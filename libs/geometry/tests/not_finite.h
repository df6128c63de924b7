// Numbers that are not finite.
#ifndef GSLAM_GEOMETRY_TESTS_NOT_FINITE_H
#define GSLAM_GEOMETRY_TESTS_NOT_FINITE_H

#include <limits>

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

#endif  // GSLAM_GEOMETRY_TESTS_NOT_FINITE_H
