// How a tree lies in a file and in memory, which are the same.
#ifndef GSLAM_VOCABULARY_DETAIL_TREE_LAYOUT_H
#define GSLAM_VOCABULARY_DETAIL_TREE_LAYOUT_H

#include <gslam/vocabulary/detail/tree_view.h>

#include <cstddef>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

// The first bytes of a file, in the order of the machine that wrote it; `byte_order` says which:
// docs/formats/vocabulary.md.
struct TreeHeader {
  char magic[8];  // "GSLAMVOC"
  std::uint32_t byte_order;
  std::uint32_t version;
  std::uint8_t descriptor_type;
  std::uint8_t weighting;
  std::uint8_t scoring;
  std::uint8_t has_weight_numbers;
  std::uint8_t has_node_ids;
  std::uint8_t unused_bytes[3];
  std::uint32_t descriptor_size;
  float scale;
  float offset;
  std::uint32_t branching;
  std::uint32_t depth;
  std::uint32_t node_count;
  std::uint32_t word_count;
  std::uint32_t weight_count;
  std::uint32_t unused[2];
  std::uint64_t file_size;
  std::uint64_t unused_words[21];
  std::uint64_t checksum;         // of all behind the header
  std::uint64_t header_checksum;  // of all above, taken as it lies
};

constexpr std::size_t kTreeHeaderSize = 256;
static_assert(sizeof(TreeHeader) == kTreeHeaderSize, "the header is part of the file format");

// Where the lists are, in bytes from the begin. Each begins at a multiple of 64.
struct TreeLayout {
  std::uint64_t links, child_counts, weight_numbers, weights, node_ids, descriptors;
  std::uint64_t size;  // of all
};

inline TreeLayout layoutOf(const TreeView& tree, bool has_weight_numbers, bool has_node_ids) {
  const std::uint64_t nodes = tree.node_count;
  std::uint64_t end = kTreeHeaderSize;
  const auto place = [&end](std::uint64_t bytes) {
    const std::uint64_t begin = (end + 63) / 64 * 64;
    end = begin + bytes;
    return begin;
  };
  TreeLayout layout = {};
  layout.links = place(nodes * 4);
  layout.child_counts = place(nodes);
  layout.weight_numbers = place(has_weight_numbers ? std::uint64_t(tree.word_count) * 2 : 0);
  layout.weights = place(std::uint64_t(tree.weight_count) * 8);
  layout.node_ids = place(has_node_ids ? nodes * 4 : 0);
  layout.descriptors = place(nodes * tree.stride);
  layout.size = end;
  return layout;
}

// Points the lists of a tree into its bytes, of which the counts and the format are known.
inline void placeTree(TreeView& tree, const TreeLayout& layout, const std::uint8_t* bytes,
                      bool has_weight_numbers, bool has_node_ids) {
  const auto at = [bytes](std::uint64_t offset) -> const void* { return bytes + offset; };
  tree.links = static_cast<const std::uint32_t*>(at(layout.links));
  tree.child_counts = static_cast<const std::uint8_t*>(at(layout.child_counts));
  tree.weight_numbers =
      has_weight_numbers ? static_cast<const std::uint16_t*>(at(layout.weight_numbers)) : nullptr;
  tree.weights = static_cast<const double*>(at(layout.weights));
  tree.node_ids = has_node_ids ? static_cast<const std::uint32_t*>(at(layout.node_ids)) : nullptr;
  tree.descriptors = static_cast<const std::uint8_t*>(at(layout.descriptors));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_TREE_LAYOUT_H
