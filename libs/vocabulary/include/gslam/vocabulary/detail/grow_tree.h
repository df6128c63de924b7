// A whole tree, from descriptors that are in memory.
#ifndef GSLAM_VOCABULARY_DETAIL_GROW_TREE_H
#define GSLAM_VOCABULARY_DETAIL_GROW_TREE_H

#include <gslam/base/parallel.h>
#include <gslam/vocabulary/detail/split_node.h>
#include <gslam/vocabulary/detail/tree_data.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Nodes with their children; those of a node lie side by side. Node 0 is the root.
struct GrownTree {
  struct Node {
    std::uint32_t first_child = 0;
    std::uint32_t child_count = 0;
  };
  std::vector<Node> nodes = std::vector<Node>(1);
  std::vector<std::uint8_t> centres;  // of all but the root; rows of the splitter
};

// A node whose rows, of which there is at least one, are to be split.
struct GrowingNode {
  std::uint32_t node = 0;    // in its tree
  std::uint32_t levels = 0;  // how many there may be below
  std::uint64_t seed = 0;
  std::size_t first = 0;  // of its rows
  std::size_t count = 0;
};

// Splits a node, and appends its children to the tree and to `growing`.
inline void growChildren(NodeSplitter& splitter, std::uint8_t* rows, std::size_t stride,
                         GrownTree& tree, const GrowingNode& parent,
                         std::vector<GrowingNode>& growing) {
  const std::uint32_t count =
      splitter.split(rows + parent.first * stride, parent.count, parent.seed);
  const auto first_child = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes[parent.node].first_child = first_child;
  tree.nodes[parent.node].child_count = count;
  tree.nodes.resize(tree.nodes.size() + count);
  GrowingNode child;
  child.levels = parent.levels - 1;
  child.first = parent.first;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint8_t* const centre = splitter.childCentre(i);
    tree.centres.insert(tree.centres.end(), centre, centre + stride);
    child.node = first_child + i;
    child.seed = childSeed(parent.seed, i);
    child.count = splitter.childCount(i);
    growing.push_back(child);
    child.first += child.count;
  }
}

inline std::uint64_t workOfSplit(const GrownTree& tree, const GrowingNode& node) noexcept {
  const bool is_leaf = tree.nodes[node.node].child_count == 0;
  return std::uint64_t(node.count) * (is_leaf ? node.levels : 1);
}

// Splits those of `growing`, whose nodes are in the tree, that have at least so many rows and
// levels below, and so on with their children. Returns the others.
inline std::vector<GrowingNode> growBig(NodeSplitter& splitter, std::uint8_t* rows,
                                        std::size_t stride, std::vector<GrowingNode> growing,
                                        std::size_t least, GrownTree& tree,
                                        TrainingProgress& progress) {
  std::vector<GrowingNode> rest;
  for (std::size_t i = 0; i < growing.size() && !progress.isCancelled(); ++i) {
    const GrowingNode node = growing[i];
    if (node.levels == 0 || node.count < least) {
      rest.push_back(node);
      continue;
    }
    growChildren(splitter, rows, stride, tree, node, growing);
    progress.add(workOfSplit(tree, node));
  }
  return rest;
}

// Grows the tree below one node, in one thread: depth first, so that its rows stay in the cache.
inline GrownTree growSubtree(NodeSplitter& splitter, std::uint8_t* rows, std::size_t stride,
                             GrowingNode root, TrainingProgress& progress) {
  GrownTree tree;
  root.node = 0;
  std::vector<GrowingNode> growing(1, root);
  while (!growing.empty() && !progress.isCancelled()) {
    const GrowingNode node = growing.back();
    growing.pop_back();
    if (node.levels == 0) continue;
    growChildren(splitter, rows, stride, tree, node, growing);
    progress.add(workOfSplit(tree, node));
  }
  return tree;
}

// Puts the tree `branch` in the place of a leaf.
inline void graft(GrownTree& tree, std::uint32_t leaf, const GrownTree& branch) {
  const auto offset = static_cast<std::uint32_t>(tree.nodes.size() - 1);  // its root is the leaf
  const auto moved = [&](GrownTree::Node node) {
    node.first_child += offset;
    return node;
  };
  tree.nodes[leaf] = moved(branch.nodes[0]);
  for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
    tree.nodes.push_back(moved(branch.nodes[i]));
  }
  tree.centres.insert(tree.centres.end(), branch.centres.begin(), branch.centres.end());
}

// Below this many rows a subtree is the work of one thread; above, the threads share each node.
constexpr std::size_t kSubtreeRows = 32768;

// Grows what is below nodes of the tree, with all threads.
inline void growTree(const SplitSettings& settings, std::uint8_t* rows,
                     const std::vector<GrowingNode>& growing, const ParallelOptions& parallel,
                     TrainingProgress& progress, GrownTree& tree, SplitCounts& counts) {
  const std::size_t stride = strideOf(settings.format);
  NodeSplitter splitter(settings, parallel, progress);
  const std::vector<GrowingNode> rest =
      growBig(splitter, rows, stride, growing, kSubtreeRows, tree, progress);
  counts += splitter.counts();

  std::vector<GrownTree> branches(rest.size());
  std::vector<SplitCounts> branch_counts(rest.size());
  ParallelOptions one_by_one = parallel;
  one_by_one.grain = 1;
  ParallelOptions alone;
  alone.threads = 1;
  parallelFor(
      0, rest.size(),
      [&](std::size_t i) {
        if (rest[i].levels == 0 || rest[i].count == 0) return;
        NodeSplitter own(settings, alone, progress);
        branches[i] = growSubtree(own, rows, stride, rest[i], progress);
        branch_counts[i] = own.counts();
      },
      one_by_one);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    graft(tree, rest[i].node, branches[i]);
    branches[i] = GrownTree();
    counts += branch_counts[i];
  }
}

// A root alone is no tree: when all rows are equal, it gets one child, which is that row.
inline void growOnlyChild(const SplitSettings& settings, const std::uint8_t* row, GrownTree& tree) {
  if (tree.nodes.size() > 1) return;
  tree.nodes[0].first_child = 1;
  tree.nodes[0].child_count = 1;
  tree.nodes.resize(2);
  tree.centres.assign(row, row + strideOf(settings.format));
}

inline std::vector<std::uint32_t> breadthFirst(const GrownTree& tree) {
  std::vector<std::uint32_t> order(1, 0u);
  order.reserve(tree.nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const GrownTree::Node node = tree.nodes[order[i]];
    for (std::uint32_t c = 0; c < node.child_count; ++c) order.push_back(node.first_child + c);
  }
  return order;
}

// Nodes in the order of breadthFirst(), so that their ids are their numbers; leaves weigh 1.
inline TreeData treeDataOf(const GrownTree& tree, const std::vector<std::uint32_t>& order,
                           const SplitSettings& settings, std::uint32_t depth) {
  TreeData data;
  data.format = settings.storage;
  data.branching = settings.clusters;
  data.depth = depth;
  const std::size_t count = order.size() - 1;
  const std::size_t bytes = bytesOf(data.format);
  const std::size_t stride = strideOf(settings.format);
  data.weights.assign(count, 1.0);
  data.descriptors.resize(count * bytes);
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const GrownTree::Node node = tree.nodes[order[i]];
    data.parents.insert(data.parents.end(), node.child_count, static_cast<std::uint32_t>(i));
    if (i == 0) continue;
    data.words.push_back(node.child_count == 0 ? word++ : kNone);
    const std::uint8_t* const centre = &tree.centres[(order[i] - 1) * stride];
    std::uint8_t* const descriptor = &data.descriptors[(i - 1) * bytes];
    if (data.format.type == DescriptorType::binary) {
      std::memcpy(descriptor, centre, bytes);
    } else {
      encodeFloats(data.format, reinterpret_cast<const float*>(centre), descriptor);
    }
  }
  return data;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_GROW_TREE_H
