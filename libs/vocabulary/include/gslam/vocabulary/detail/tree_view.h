// The tree of a vocabulary as it lies in memory and in files.
#ifndef GSLAM_VOCABULARY_DETAIL_TREE_VIEW_H
#define GSLAM_VOCABULARY_DETAIL_TREE_VIEW_H

#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/weighting.h>

#include <cstddef>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;  // no node, no word

// Nodes are numbered breadth first, the root is 0: so the children of a node lie side by side, and
// behind it. What comes from a file that was not verified may break any of this; see childrenOf().
struct TreeView {
  DescriptorFormat format;
  std::size_t stride = 0;       // bytes from one descriptor to the next: bytesOf() and zeros
  std::uint32_t branching = 0;  // most children of a node, 2 to 64
  std::uint32_t depth = 0;      // levels below the root
  Weighting weighting = Weighting::tf_idf;
  Scoring scoring = Scoring::l1;
  std::uint32_t node_count = 0;  // with the root
  std::uint32_t word_count = 0;
  std::uint32_t weight_count = 0;  // of `weights`

  const std::uint8_t* descriptors = nullptr;   // of each node; that of the root is zeros
  const std::uint32_t* links = nullptr;        // of each node: its first child, or its word
  const std::uint8_t* child_counts = nullptr;  // of each node; 0: a leaf, which is a word
  // Weights repeat: there are no more of them than images in the training. Where they fit, words
  // have the number of theirs in two bytes; else (null) there is one weight for each word.
  const std::uint16_t* weight_numbers = nullptr;
  const double* weights = nullptr;
  const std::uint32_t* node_ids = nullptr;  // of each node, as the file it came from has them;
                                            // null: its number
};

struct Children {
  std::uint32_t first;
  std::uint32_t count;  // 0: a leaf
};

// Whatever the file says, they are behind the node and inside the tree, and no more than kernels
// have room for: so a way down ends, and never leaves the memory.
inline Children childrenOf(const TreeView& tree, std::uint32_t node) noexcept {
  const std::uint32_t count = tree.child_counts[node];
  const std::uint32_t first = tree.links[node];
  const bool is_sound = count <= tree.branching && first > node && first <= tree.node_count &&
                        count <= tree.node_count - first;
  return Children{first, is_sound ? count : 0};
}

// kNone where the node is no leaf, or the file is damaged.
inline std::uint32_t wordOf(const TreeView& tree, std::uint32_t node) noexcept {
  if (tree.child_counts[node] != 0) return kNone;
  const std::uint32_t word = tree.links[node];
  return word < tree.word_count ? word : kNone;
}

// The word must be there.
inline double weightOf(const TreeView& tree, std::uint32_t word) noexcept {
  if (tree.weight_numbers == nullptr) return tree.weights[word];
  const std::uint32_t number = tree.weight_numbers[word];
  return number < tree.weight_count ? tree.weights[number] : 0;
}

inline std::uint32_t nodeId(const TreeView& tree, std::uint32_t node) noexcept {
  return tree.node_ids == nullptr ? node : tree.node_ids[node];
}

inline const std::uint8_t* descriptorOf(const TreeView& tree, std::uint32_t node) noexcept {
  return tree.descriptors + node * tree.stride;
}

// Bytes of a row: kernels read whole words of 8 bytes of bits, and 4 numbers at once.
inline std::size_t strideOf(const DescriptorFormat& format) noexcept {
  const std::size_t unit = format.type == DescriptorType::binary    ? 8
                           : format.type == DescriptorType::float32 ? 16
                           : format.type == DescriptorType::float16 ? 8
                                                                    : 4;
  return (bytesOf(format) + unit - 1) / unit * unit;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_TREE_VIEW_H
