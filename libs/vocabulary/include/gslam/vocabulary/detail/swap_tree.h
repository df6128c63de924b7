// Files of machines with another order of bytes.
#ifndef GSLAM_VOCABULARY_DETAIL_SWAP_TREE_H
#define GSLAM_VOCABULARY_DETAIL_SWAP_TREE_H

#include <gslam/vocabulary/detail/tree_layout.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

// Turns each of `count` numbers of `size` bytes round.
inline void swapNumbers(std::uint8_t* bytes, std::uint64_t count, std::size_t size) {
  for (; count != 0; --count, bytes += size) std::reverse(bytes, bytes + size);
}

template <class Number>
void swapNumber(Number& number) {
  swapNumbers(reinterpret_cast<std::uint8_t*>(&number), 1, sizeof number);
}

inline void swapHeader(TreeHeader& header) {
  for (std::uint32_t* const number :
       {&header.byte_order, &header.version, &header.descriptor_size, &header.branching,
        &header.depth, &header.node_count, &header.word_count, &header.weight_count}) {
    swapNumber(*number);
  }
  swapNumber(header.scale);
  swapNumber(header.offset);
  swapNumber(header.file_size);
  swapNumber(header.checksum);
  swapNumber(header.header_checksum);
}

// All lists, in place. The counts and the format are known.
inline void swapLists(const TreeView& tree, const TreeLayout& layout, bool has_weight_numbers,
                      bool has_node_ids, std::uint8_t* bytes) {
  swapNumbers(bytes + layout.links, tree.node_count, 4);
  if (has_weight_numbers) swapNumbers(bytes + layout.weight_numbers, tree.word_count, 2);
  swapNumbers(bytes + layout.weights, tree.weight_count, 8);
  if (has_node_ids) swapNumbers(bytes + layout.node_ids, tree.node_count, 4);
  const std::size_t size = tree.format.type == DescriptorType::float32   ? 4
                           : tree.format.type == DescriptorType::float16 ? 2
                                                                         : 1;
  swapNumbers(bytes + layout.descriptors, tree.node_count * (tree.stride / size), size);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_SWAP_TREE_H
