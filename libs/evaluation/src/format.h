#ifndef GSLAM_EVALUATION_SRC_FORMAT_H
#define GSLAM_EVALUATION_SRC_FORMAT_H

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>

namespace gslam {
inline namespace v1 {
namespace evaluation {

/// What printf() would print.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  const int size = std::snprintf(nullptr, 0, pattern, values...);
  std::string text(std::size_t(std::max(size, 0)) + 1, '\0');
  std::snprintf(&text[0], text.size(), pattern, values...);
  text.pop_back();
  return text;
}

}  // namespace evaluation
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_SRC_FORMAT_H
