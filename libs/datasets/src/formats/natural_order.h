// The order in which people number files.
#ifndef GSLAM_DATASETS_SRC_FORMATS_NATURAL_ORDER_H
#define GSLAM_DATASETS_SRC_FORMATS_NATURAL_ORDER_H

#include <cstddef>
#include <string>

namespace gslam {
inline namespace v1 {
namespace reading {

/// Whether a name comes before another where digits count as numbers: a2 before a10.
inline bool isBeforeNaturally(const std::string& a, const std::string& b) {
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  const auto skipZeros = [](const std::string& text, std::size_t& at) {
    while (at < text.size() && text[at] == '0') ++at;
  };
  const auto digitsEnd = [&](const std::string& text, std::size_t at) {
    while (at < text.size() && isDigit(text[at])) ++at;
    return at;
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
      continue;
    }
    skipZeros(a, i);
    skipZeros(b, j);
    const std::size_t i_end = digitsEnd(a, i), j_end = digitsEnd(b, j);
    if (i_end - i != j_end - j) return i_end - i < j_end - j;
    const int order = a.compare(i, i_end - i, b, j, j_end - j);
    if (order != 0) return order < 0;
    i = i_end;
    j = j_end;
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;  // 007 and 7
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_NATURAL_ORDER_H
