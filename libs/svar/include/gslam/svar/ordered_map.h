#ifndef GSLAM_SVAR_ORDERED_MAP_H
#define GSLAM_SVAR_ORDERED_MAP_H

#include <gslam/svar/text.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// @file
/// The members of an object: in the order of insertion, found by name.

namespace gslam {
inline namespace v1 {
namespace detail {

/// The first index below `count` for which `before` is false, or `count`; as std::lower_bound,
/// which would cost each user the reading of the header `algorithm`.
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
  const Member& byName(std::size_t k) const { return members_[byName_[k]]; }

  /// Null where there is no such name.
  Value* find(Text name) {
    const std::size_t k = place(name);
    return isAt(k, name) ? &members_[byName_[k]].second : nullptr;
  }

  /// The name must be new.
  Value& insert(Text name, Value value) {
    const std::size_t k = place(name);
    members_.emplace_back(name.str(), std::move(value));
    try {
      byName_.insert(at(k), members_.size() - 1);
    } catch (...) {
      members_.pop_back();  // both or none
      throw;
    }
    return members_.back().second;
  }

  bool erase(Text name) {
    const std::size_t k = place(name);
    if (!isAt(k, name)) return false;
    const std::size_t gone = byName_[k];
    byName_.erase(at(k));
    for (std::size_t& index : byName_) index -= index > gone ? 1 : 0;
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(gone));
    return true;
  }

 private:
  std::size_t place(Text name) const {
    return partitionPoint(byName_.size(),
                          [&](std::size_t k) { return Text(byName(k).first).compare(name) < 0; });
  }
  bool isAt(std::size_t k, Text name) const {
    return k < byName_.size() && Text(byName(k).first).compare(name) == 0;
  }
  std::vector<std::size_t>::iterator at(std::size_t k) {
    return byName_.begin() + static_cast<std::ptrdiff_t>(k);
  }

  std::vector<Member> members_;
  std::vector<std::size_t> byName_;  // indices of members_, sorted by their names
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_ORDERED_MAP_H
