#include "math/check_size.h"

namespace gslam {
inline namespace v1 {
namespace detail {

void refuseSize(const char* name, std::size_t size, const std::string& expected) {
  throw ArgumentError(name, "has " + std::to_string(size) + " elements, expected " + expected);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
