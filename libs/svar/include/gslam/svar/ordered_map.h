#ifndef GSLAM_SVAR_ORDERED_MAP_H
#define GSLAM_SVAR_ORDERED_MAP_H

#include <gslam/svar/bytes.h>
#include <gslam/svar/text.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// @file
/// The members of an object: in the order of insertion, found by name.

namespace gslam {
inline namespace v1 {
namespace detail {

/// Named values in the order of insertion.
///
/// Finding never allocates and takes the same time in small and large maps: few names are compared
/// one by one, more are found by a hash table of their indices (open addressing, at most half
/// full). Inserting invalidates references to values, as with std::vector; erasing takes time in
/// proportion to the size.
template <class Value>
class OrderedMap {
 public:
  using Member = std::pair<std::string, Value>;

  std::vector<Member>& members() noexcept { return members_; }
  const std::vector<Member>& members() const noexcept { return members_; }

  /// Null where there is no such name.
  const Value* find(Text name) const noexcept {
    const std::size_t index = indexOf(name);
    return index != members_.size() ? &members_[index].second : nullptr;
  }
  Value* find(Text name) noexcept {
    const std::size_t index = indexOf(name);
    return index != members_.size() ? &members_[index].second : nullptr;
  }

  /// The name must be new; it may be part of a name in this map.
  Value& insert(Text name, Value value) {
    reserveSlot();
    members_.emplace_back(name.str(), std::move(value));  // what `name` views may move now
    if (!slots_.empty()) addSlot(members_.size() - 1, hashOf(members_.back().first));
    return members_.back().second;
  }

  bool erase(Text name) {
    const std::size_t index = indexOf(name);
    if (index == members_.size()) return false;
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(index));
    if (members_.size() <= kFew) slots_.clear();
    if (!slots_.empty()) fillSlots();
    return true;
  }

  /// Two indices of one name, the earlier one first.
  using Repeat = std::pair<std::size_t, std::size_t>;

  /// Takes over members, in linear time. Gives the first whose name stands there before, with that
  /// earlier one, after which keepLast() must follow; size() twice where all names differ.
  Repeat assign(std::vector<Member> members) {
    members_ = std::move(members);
    slots_.clear();
    if (members_.size() > kFew) {
      makeSlots(members_.size());
      return fillSlots();
    }
    for (std::size_t i = 1; i < members_.size(); ++i) {
      const std::size_t earlier = indexAmong(i, members_[i].first);
      if (earlier != i) return Repeat(earlier, i);
    }
    return Repeat(members_.size(), members_.size());
  }

  /// Leaves one member of each name: at the place of the first, with the value of the last.
  void keepLast() {
    std::vector<Member> all;
    all.swap(members_);
    slots_.clear();
    for (Member& member : all) {
      Value* const earlier = find(member.first);
      if (earlier != nullptr) {
        *earlier = std::move(member.second);
      } else {
        insert(member.first, std::move(member.second));
      }
    }
  }

 private:
  static constexpr std::size_t kFew = 8;

  // Where a member stands, and the half of its name's hash that tells most other names from it.
  struct Slot {
    std::uint32_t index_plus_one;  // 0: empty
    std::uint32_t hash;
  };

  std::uint64_t hashOf(Text name) const noexcept {
    return hashBytes(name.data(), name.size(), seed_);
  }

  // Names come from files. Who writes a file cannot know where this program lies in memory, so he
  // cannot choose names that all fall on one slot. A map keeps the seed of who made it: a shared
  // library may have the place elsewhere.
  static std::uint64_t newSeed() noexcept {
    static const char place = 0;
    return reinterpret_cast<std::uintptr_t>(&place);
  }

  // The index of the name, or size().
  std::size_t indexOf(Text name) const noexcept {
    return slots_.empty() ? indexAmong(members_.size(), name) : findSlot(name, hashOf(name));
  }

  // The index of the name among the first `count`, or `count`.
  std::size_t indexAmong(std::size_t count, Text name) const noexcept {
    std::size_t i = 0;
    while (i < count && !(name == Text(members_[i].first))) ++i;
    return i;
  }

  std::size_t findSlot(Text name, std::uint64_t hash) const noexcept {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = static_cast<std::size_t>(hash >> 32) & mask;; at = (at + 1) & mask) {
      const Slot& slot = slots_[at];
      if (slot.index_plus_one == 0) return members_.size();
      const std::size_t index = slot.index_plus_one - 1;
      if (slot.hash == static_cast<std::uint32_t>(hash) && name == Text(members_[index].first)) {
        return index;
      }
    }
  }

  void addSlot(std::size_t index, std::uint64_t hash) noexcept {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = static_cast<std::size_t>(hash >> 32) & mask;
    while (slots_[at].index_plus_one != 0) at = (at + 1) & mask;
    slots_[at].index_plus_one = static_cast<std::uint32_t>(index + 1);
    slots_[at].hash = static_cast<std::uint32_t>(hash);
  }

  // Before one more member comes: what may fail does so while nothing has changed.
  void reserveSlot() {
    const std::size_t count = members_.size() + 1;
    if (count <= kFew || 2 * count <= slots_.size()) return;
    makeSlots(2 * count);
    fillSlots();
  }

  void makeSlots(std::size_t count) {
    if (count > std::numeric_limits<std::uint32_t>::max() / 4) {
      throw std::length_error("a Svar object cannot have so many members");
    }
    std::size_t size = 4 * kFew;
    while (size < 2 * count) size *= 2;
    slots_.assign(size, Slot());
  }

  // Enters all members anew; of a name that stands there twice, only the first.
  Repeat fillSlots() noexcept {
    slots_.assign(slots_.size(), Slot());
    Repeat first(members_.size(), members_.size());
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const std::uint64_t hash = hashOf(members_[i].first);
      const std::size_t earlier = findSlot(members_[i].first, hash);
      if (earlier == members_.size()) {
        addSlot(i, hash);
      } else if (first.second == members_.size()) {
        first = Repeat(earlier, i);
      }
    }
    return first;
  }

  std::vector<Member> members_;
  std::vector<Slot> slots_;  // empty, or at least twice as many as members
  std::uint64_t seed_ = newSeed();
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_ORDERED_MAP_H
