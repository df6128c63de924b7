// The name that somebody most likely meant.
#ifndef GSLAM_SVAR_DETAIL_NEAREST_NAME_H
#define GSLAM_SVAR_DETAIL_NEAREST_NAME_H

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

/// How many letters must be changed, added, left out or swapped with their neighbour (optimal
/// string alignment; Damerau, "A technique for computer detection and correction of spelling
/// errors", 1964).
inline std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      const std::size_t skip = 1 + (last[j] < row[j - 1] ? last[j] : row[j - 1]);
      row[j] = change < skip ? change : skip;
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped && before_last[j - 2] + 1 < row[j]) row[j] = before_last[j - 2] + 1;
    }
  }
  return row[b.size()];
}

/// The nearest of the names, or nothing where none is near.
inline std::string nearestName(const std::string& name, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = name.size() / 3 + 2;  // from here on it is another name
  for (const std::string& one : names) {
    const std::size_t size = one.size();
    if (size + least <= name.size() || name.size() + least <= size || size > 200) continue;
    const std::size_t distance = editDistance(name, one);
    if (distance >= least || distance >= size) continue;
    least = distance;
    nearest = one;
  }
  return nearest;
}

/// ", did you mean X?" or nothing.
inline std::string suggestion(const std::string& nearest) {
  return nearest.empty() ? "" : ", did you mean " + nearest + "?";
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_NEAREST_NAME_H
