#ifndef GSLAM_CORE_DETAIL_EXCEPTION_TEXT_H
#define GSLAM_CORE_DETAIL_EXCEPTION_TEXT_H

#include <exception>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// What a plugin threw, which may be anything; to be called in a catch block.
inline std::string exceptionText() {
  try {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an exception that is no std::exception";
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_EXCEPTION_TEXT_H
