// The order in which people number files.
#ifndef GSLAM_APPS_NATURAL_ORDER_H
#define GSLAM_APPS_NATURAL_ORDER_H

#include <cstddef>
#include <string>

namespace app {

/// Whether a name comes before another, digits taken as numbers: 2.png before 10.png.
inline bool isBefore(const std::string& a, const std::string& b) {
  const auto isDigitAt = [](const std::string& text, std::size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
  };
  // Takes a number, without the zeros before it.
  const auto takeNumber = [&](const std::string& text, std::size_t& at) {
    while (isDigitAt(text, at) && text[at] == '0') ++at;
    const std::size_t begin = at;
    while (isDigitAt(text, at)) ++at;
    return text.substr(begin, at - begin);
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!isDigitAt(a, i) || !isDigitAt(b, j)) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
      continue;
    }
    const std::string x = takeNumber(a, i), y = takeNumber(b, j);
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;  // 007 and 7
}

}  // namespace app

#endif  // GSLAM_APPS_NATURAL_ORDER_H
