// Puts lists into order.
#ifndef GSLAM_DATASETS_SRC_READING_SORT_UNIQUE_H
#define GSLAM_DATASETS_SRC_READING_SORT_UNIQUE_H

#include <algorithm>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace reading {

/// Sorts by a key and takes out what has the key of another before it. Of these the first stays.
/// @param key      of an element
/// @param on_twin  is called with each one that goes
/// @return whether it was in order already
template <class T, class Key, class OnTwin>
bool sortUnique(std::vector<T>& list, Key key, OnTwin on_twin) {
  const auto isBefore = [&](const T& a, const T& b) { return key(a) < key(b); };
  const bool was_sorted = std::is_sorted(list.begin(), list.end(), isBefore);
  if (!was_sorted) std::stable_sort(list.begin(), list.end(), isBefore);
  const auto isTwin = [&](const T& a, const T& b) {
    if (key(a) != key(b)) return false;
    on_twin(b);
    return true;
  };
  list.erase(std::unique(list.begin(), list.end(), isTwin), list.end());
  return was_sorted;
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_SORT_UNIQUE_H
