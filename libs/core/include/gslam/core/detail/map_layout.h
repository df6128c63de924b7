// What a map is made of, as far as who writes it and who reads it must agree on it.
#ifndef GSLAM_CORE_DETAIL_MAP_LAYOUT_H
#define GSLAM_CORE_DETAIL_MAP_LAYOUT_H

#include <gslam/core/detail/cow.h>
#include <gslam/core/detail/list_table.h>
#include <gslam/core/detail/paged_table.h>
#include <gslam/core/detail/record_table.h>
#include <gslam/core/map.h>
#include <gslam/core/map_range.h>
#include <gslam/core/map_types.h>

#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Parts of a map that its functions, which are inline on both sides, reach by pointers: the size
// of Map does not show them.
struct MapLayout {
  template <class Record>
  using Chunk = RecordChunk<Record>;
  template <class T>
  using Page = typename PagedTable<T>::Page;
  template <class T>
  using Node = typename Cow<T>::Node;

  using Place = ListChunk<Observation>::Place;
  using KeyframePage = Page<Chunk<KeyframeRow>>;
  using KeyframeNode = Node<Chunk<KeyframeRow>>;
  using PointPage = Page<Chunk<MapPoint>>;
  using PointNode = Node<Chunk<MapPoint>>;
  using ObservationPage = Page<ListChunk<Observation>>;
  using ObservationNode = Node<ListChunk<Observation>>;
  using PointsSeenNode = Node<std::vector<PointId>>;

  // Their sizes are these numbers.
  using ChunkSize = std::uint8_t[kChunkSize];
  using PageSize = std::uint8_t[kPageSize];
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_MAP_LAYOUT_H
