// How far a descriptor is from its word.
#ifndef GSLAM_VOCABULARY_DETAIL_LEAF_DISTANCE_H
#define GSLAM_VOCABULARY_DETAIL_LEAF_DISTANCE_H

#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/hamming.h>
#include <gslam/vocabulary/detail/l2.h>
#include <gslam/vocabulary/detail/tree_view.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {

// Bits that differ in `size` bytes, of which nothing behind is read.
inline std::uint32_t hammingDistance(const std::uint8_t* a, const std::uint8_t* b,
                                     std::size_t size) noexcept {
  std::uint32_t distance = 0;
  std::size_t i = 0;
  for (; i + 8 <= size; i += 8) distance += countBits(loadWord(a + i) ^ loadWord(b + i));
  for (; i < size; ++i) distance += countBits(static_cast<std::uint64_t>(a[i] ^ b[i]));
  return distance;
}

// Bits, or L2; the descriptor is bits or floats.
inline double leafDistance(const TreeView& tree, std::uint32_t node,
                           const std::uint8_t* descriptor) {
  const std::uint8_t* const word = descriptorOf(tree, node);
  if (tree.format.type == DescriptorType::binary) {
    return hammingDistance(descriptor, word, tree.format.size);
  }
  return std::sqrt(exactDistance(tree.format, descriptor, word));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_LEAF_DISTANCE_H
