// How many random instances a test goes through.
#ifndef GSLAM_ESTIMATOR_TESTS_INSTANCES_H
#define GSLAM_ESTIMATOR_TESTS_INSTANCES_H

#include <cstddef>
#include <cstdlib>

namespace solver_test {

/// `daily`, or ten times as many where GSLAM_FULL_TESTS is set: 1e4 and 1e5 by default.
inline std::size_t instances(std::size_t daily = 10000) {
  return std::getenv("GSLAM_FULL_TESTS") != nullptr ? 10 * daily : daily;
}

}  // namespace solver_test

#endif  // GSLAM_ESTIMATOR_TESTS_INSTANCES_H
