#ifndef GSLAM_EVALUATION_STEADY_TIME_H
#define GSLAM_EVALUATION_STEADY_TIME_H

#include <chrono>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Nanoseconds of a clock that never jumps.
inline std::int64_t steadyTime() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_STEADY_TIME_H
