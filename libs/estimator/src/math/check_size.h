// Sizes of the spans that callers give.
#ifndef GSLAM_ESTIMATOR_MATH_CHECK_SIZE_H
#define GSLAM_ESTIMATOR_MATH_CHECK_SIZE_H

#include <gslam/base/error.h>

#include <cstddef>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// Out of line, so that a solver pays one comparison.
[[noreturn]] void refuseSize(const char* name, std::size_t size, const std::string& expected);

// A minimal solver takes exactly so many.
inline void checkSize(const char* name, std::size_t size, std::size_t expected) {
  if (size != expected) refuseSize(name, size, std::to_string(expected));
}

// Two spans that belong together, of at least so many.
inline void checkSizes(const char* name_a, std::size_t a, const char* name_b, std::size_t b,
                       std::size_t least) {
  if (a < least) refuseSize(name_a, a, "at least " + std::to_string(least));
  if (a != b) refuseSize(name_b, b, std::to_string(a) + ", as many as " + name_a);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_CHECK_SIZE_H
