#ifndef GSLAM_SVAR_ORDERED_MAP_H
#define GSLAM_SVAR_ORDERED_MAP_H

#include <gslam/svar/text.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// @file
/// The members of an object: in the order of insertion, found by name.

namespace gslam {
inline namespace v1 {
namespace detail {

/// The first index below `count` for which `before` is false, or `count`; std::partition_point for
/// indices.
template <class Before>
std::size_t partitionPoint(std::size_t count, Before before) {
  std::size_t first = 0;
  while (count > 0) {
    const std::size_t half = count / 2;
    const bool right = before(first + half);
    if (right) first += half + 1;
    count = right ? count - half - 1 : half;
  }
  return first;
}

/// Named values in the order of insertion.
///
/// Finding compares log2(size) names and never allocates; inserting and erasing move indices.
/// Inserting invalidates references to values, as with std::vector.
template <class Value>
class OrderedMap {
 public:
  using Member = std::pair<std::string, Value>;

  std::vector<Member>& members() noexcept { return members_; }
  const std::vector<Member>& members() const noexcept { return members_; }

  /// The k-th member in the order of names.
  const Member& byName(std::size_t k) const { return members_[indexAt(k)]; }

  /// Null where there is no such name.
  Value* find(Text name) {
    const std::size_t k = place(name);
    return isAt(k, name) ? &members_[indexAt(k)].second : nullptr;
  }

  /// The name must be new.
  Value& insert(Text name, Value value) {
    const std::size_t k = place(name);
    members_.emplace_back(name.str(), std::move(value));
    try {
      insertIndex(k);
    } catch (...) {
      members_.pop_back();  // both or none
      throw;
    }
    return members_.back().second;
  }

  bool erase(Text name) {
    const std::size_t k = place(name);
    if (!isAt(k, name)) return false;
    const std::size_t gone = indexAt(k);
    eraseIndex(k);
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(gone));
    return true;
  }

  /// Takes over members, in O(size log size). Where a name stands there twice, firstRepeat() says
  /// so and keepLast() must follow.
  void assign(std::vector<Member> members) {
    members_ = std::move(members);
    byName_.clear();
    if (members_.size() <= kFew) return sortFew();
    byName_.resize(members_.size());
    for (std::size_t i = 0; i < byName_.size(); ++i) byName_[i] = i;
    std::sort(byName_.begin(), byName_.end(), [this](std::size_t i, std::size_t j) {
      const int order = compareMembers(i, j);
      return order != 0 ? order < 0 : i < j;
    });
  }

  /// The first index whose name stands there before, with that earlier index; size() twice where
  /// all names differ.
  std::pair<std::size_t, std::size_t> firstRepeat() const {
    std::pair<std::size_t, std::size_t> found(members_.size(), members_.size());
    for (std::size_t k = 1; k < members_.size(); ++k) {
      if (repeatsBefore(k) && indexAt(k) < found.second) found = {indexAt(k - 1), indexAt(k)};
    }
    return found;
  }

  /// Leaves one member of each name: at the place of the first, with the value of the last.
  void keepLast() {
    std::vector<char> gone(members_.size(), 0);
    for (std::size_t k = members_.size(); k-- > 1;) {
      if (!repeatsBefore(k)) continue;
      members_[indexAt(k - 1)].second = std::move(members_[indexAt(k)].second);
      gone[indexAt(k)] = 1;
    }
    std::vector<Member> left;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (gone[i] == 0) left.push_back(std::move(members_[i]));
    }
    assign(std::move(left));
  }

 private:
  static constexpr std::size_t kFew = 8;

  // As Text::compare(); names that differ do so mostly in their first byte.
  static int compareNames(Text a, Text b) noexcept {
    if (a.empty() || b.empty() || *a.data() == *b.data()) return a.compare(b);
    return static_cast<unsigned char>(*a.data()) < static_cast<unsigned char>(*b.data()) ? -1 : 1;
  }
  int compareMembers(std::size_t i, std::size_t j) const {
    return compareNames(members_[i].first, members_[j].first);
  }
  bool repeatsBefore(std::size_t k) const { return byName(k - 1).first == byName(k).first; }
  std::size_t place(Text name) const {
    return partitionPoint(indexCount(),
                          [&](std::size_t k) { return compareNames(byName(k).first, name) < 0; });
  }
  bool isAt(std::size_t k, Text name) const {
    return k < indexCount() && compareNames(byName(k).first, name) == 0;
  }

  // --- the indices of members_, sorted by their names

  std::size_t indexCount() const { return members_.size(); }
  std::size_t indexAt(std::size_t k) const { return byName_.empty() ? fewByName_[k] : byName_[k]; }

  // Puts the index of the last member at k.
  void insertIndex(std::size_t k) {
    const std::size_t index = members_.size() - 1;
    if (byName_.empty() && index < kFew) {
      for (std::size_t i = index; i > k; --i) fewByName_[i] = fewByName_[i - 1];
      fewByName_[k] = static_cast<unsigned char>(index);
      return;
    }
    if (byName_.empty()) byName_.assign(fewByName_, fewByName_ + index);
    byName_.insert(byName_.begin() + static_cast<std::ptrdiff_t>(k), index);
  }

  void eraseIndex(std::size_t k) {
    const std::size_t gone = indexAt(k);
    if (!byName_.empty()) {
      byName_.erase(byName_.begin() + static_cast<std::ptrdiff_t>(k));
      for (std::size_t& index : byName_) index -= index > gone ? 1 : 0;
      return;
    }
    for (std::size_t i = k + 1; i < members_.size(); ++i) fewByName_[i - 1] = fewByName_[i];
    for (unsigned char& index : fewByName_)
      index = static_cast<unsigned char>(index - (index > gone ? 1 : 0));
  }

  void sortFew() {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      std::size_t k = i;
      for (; k > 0 && compareMembers(i, fewByName_[k - 1]) < 0; --k)
        fewByName_[k] = fewByName_[k - 1];
      fewByName_[k] = static_cast<unsigned char>(i);
    }
  }

  std::vector<Member> members_;
  std::vector<std::size_t> byName_;      // empty as long as the members are kFew or less
  unsigned char fewByName_[kFew] = {0};  // saves small objects an allocation
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_ORDERED_MAP_H
