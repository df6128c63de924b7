// The least and the greatest integer of a Svar.
#ifndef GSLAM_SVAR_TESTS_INT64_LIMITS_H
#define GSLAM_SVAR_TESTS_INT64_LIMITS_H

#include <cstdint>
#include <limits>

constexpr std::int64_t kMin64 = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax64 = std::numeric_limits<std::int64_t>::max();

#endif  // GSLAM_SVAR_TESTS_INT64_LIMITS_H
