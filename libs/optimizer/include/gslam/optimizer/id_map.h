#ifndef GSLAM_OPTIMIZER_ID_MAP_H
#define GSLAM_OPTIMIZER_ID_MAP_H

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

/// @file
/// From the names that a file or a map has for things to places in arrays, and back.

namespace gslam {
inline namespace v1 {

/// Ids and indices, both ways.
///
/// Thread-safety: as a vector.
class IdMap {
 public:
  /// What indexOf() gives for an id that is not there.
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// Gives the next index to an id, or the one it has.
  /// @return the index
  std::uint32_t add(std::int64_t id) {
    const auto place = indices_.emplace(id, static_cast<std::uint32_t>(ids_.size()));
    if (place.second) ids_.push_back(id);
    return place.first->second;
  }
  /// The index of an id, or kNone.
  std::uint32_t indexOf(std::int64_t id) const noexcept {
    const auto place = indices_.find(id);
    return place == indices_.end() ? kNone : place->second;
  }
  /// The id of an index, which must be below size().
  std::int64_t idOf(std::uint32_t index) const noexcept { return ids_[index]; }
  /// Number of ids.
  std::size_t size() const noexcept { return ids_.size(); }
  /// Whether there is none.
  bool empty() const noexcept { return ids_.empty(); }

 private:
  std::unordered_map<std::int64_t, std::uint32_t> indices_;
  std::vector<std::int64_t> ids_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_ID_MAP_H
