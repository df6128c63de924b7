#ifndef GSLAM_CORE_MAP_RANGE_H
#define GSLAM_CORE_MAP_RANGE_H

#include <gslam/core/detail/cow.h>
#include <gslam/core/detail/record_table.h>
#include <gslam/core/map_types.h>

#include <cstddef>
#include <utility>
#include <vector>

/// @file
/// Loops over the parts of a map.

namespace gslam {
inline namespace v1 {
namespace detail {

// A keyframe and the point that each of its features sees.
struct KeyframeRow {
  Keyframe keyframe;
  Cow<std::vector<PointId>> points;
};

inline const Keyframe& valueOf(const KeyframeRow& row) noexcept {
  return row.keyframe;
}
template <class Record>
const Record& valueOf(const Record& record) noexcept {
  return record;
}

}  // namespace detail

/// What a loop over a part of a map gives.
template <class Id, class Value>
struct MapItem {
  Id id;               ///< its name
  const Value& value;  ///< lives until the map changes, or it and the range are gone
};

/// All keyframes, points or edges of a map, in the order of their ids. Valid until the map changes;
/// the map may go, as that of `for (const auto& item : shared.latest()->points())` does before the
/// loop begins: ranges and their iterators keep alive what they go through.
///
///     for (const auto& item : map.points()) use(item.id, item.value.position);
template <class Id, class Value, class Row = Value>
class MapRange {
 public:
  /// Enough of one for loops.
  class Iterator {
   public:
    /// Used by MapRange.
    explicit Iterator(typename detail::RecordTable<Row>::Iterator place)
        : place_(std::move(place)) {}
    /// What it points to.
    MapItem<Id, Value> operator*() const noexcept {
      return MapItem<Id, Value>{Id(place_.id()), detail::valueOf(place_.record())};
    }
    /// To the next.
    Iterator& operator++() noexcept {
      place_.advance();
      return *this;
    }
    /// @{
    /// As for any iterator.
    friend bool operator==(const Iterator& a, const Iterator& b) noexcept {
      return a.place_ == b.place_;
    }
    friend bool operator!=(const Iterator& a, const Iterator& b) noexcept { return !(a == b); }
    /// @}

   private:
    typename detail::RecordTable<Row>::Iterator place_;
  };

  /// Used by Map.
  explicit MapRange(const detail::RecordTable<Row>& table) : table_(table) {}

  Iterator begin() const { return Iterator(table_.begin()); }  ///< the first
  Iterator end() const { return Iterator(table_.end()); }      ///< behind the last
  std::size_t size() const noexcept { return table_.size(); }  ///< how many there are
  bool empty() const noexcept { return table_.size() == 0; }   ///< whether there is none

 private:
  detail::RecordTable<Row> table_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MAP_RANGE_H
