// What kernels do: for each descriptor, the nearest of a few.
#ifndef GSLAM_VOCABULARY_DETAIL_VISIT_H
#define GSLAM_VOCABULARY_DETAIL_VISIT_H

#include <gslam/vocabulary/descriptors.h>

#include <cstddef>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

// A descriptor, and those to choose from. Kernels read strideOf() bytes of each row.
struct Visit {
  const std::uint8_t* query;  // bits, or floats
  const std::uint8_t* rows;   // side by side
  std::uint32_t count;        // 1 to 64
  std::uint32_t first;        // number of the first, for the caller
};

// Which is the nearest, and how far it is: bits that differ, or the square of the L2 distance. Of
// two that are equally near it is the one before.
struct Choice {
  std::uint32_t index;
  float distance;
};

// The format and the stride are those of the rows.
using ChooseFunction = void (*)(const DescriptorFormat& format, std::size_t stride,
                                const Visit* visits, std::size_t count, Choice* choices);

// How many visits ahead rows are fetched into the cache.
constexpr std::size_t kFetchAhead = 8;

// Into the first cache.
inline void fetchRows(const Visit& visit, std::size_t stride) noexcept {
#if defined(__GNUC__) || defined(__clang__)
  const std::uint8_t* const end = visit.rows + visit.count * stride;
  for (const std::uint8_t* line = visit.rows; line < end; line += 64) __builtin_prefetch(line);
#else
  (void)visit;
  (void)stride;
#endif
}

// Into the second cache, where all rows of a level have room.
inline void fetchFar(const Visit& visit, std::size_t stride) noexcept {
#if defined(__GNUC__) || defined(__clang__)
  const std::uint8_t* const end = visit.rows + visit.count * stride;
  for (const std::uint8_t* line = visit.rows; line < end; line += 64) {
    __builtin_prefetch(line, 0, 2);
  }
#else
  (void)visit;
  (void)stride;
#endif
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_VISIT_H
