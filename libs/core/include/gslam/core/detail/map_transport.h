// The one place that knows how a map crosses from the child process to its parent.
#ifndef GSLAM_CORE_DETAIL_MAP_TRANSPORT_H
#define GSLAM_CORE_DETAIL_MAP_TRANSPORT_H

#include <gslam/base/span.h>
#include <gslam/core/map.h>
#include <gslam/core/map_file.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// The whole map as bytes: a map file.
inline std::vector<std::uint8_t> bytesOfMap(const Map& map) {
  return mapToBytes(map);
}

// The map of such bytes.
// @throws ParseError when they are damaged
inline std::shared_ptr<const Map> mapOfBytes(const std::uint8_t* bytes, std::size_t size) {
  return std::make_shared<const Map>(
      mapFromBytes(Span<const std::uint8_t>(bytes, size), "the map of the isolated SLAM system"));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_MAP_TRANSPORT_H
