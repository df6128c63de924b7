// From a list of nodes to a tree that can be searched, and back.
#ifndef GSLAM_VOCABULARY_DETAIL_BUILD_TREE_H
#define GSLAM_VOCABULARY_DETAIL_BUILD_TREE_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/encode.h>
#include <gslam/vocabulary/detail/storage.h>
#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/detail/tree_layout.h>
#include <gslam/vocabulary/vocabulary.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// One use: checks a list of nodes and puts them in order. Nodes of the list are called by their
// index there, nodes of the tree by their number.
class TreeBuilder {
 public:
  TreeBuilder(const TreeData& data, const std::string& source) : data_(data), source_(source) {}

  Vocabulary build() {
    checkShape();
    checkIds();
    findChildren();
    orderNodes();
    numberWords();
    collectWeights();
    return write();
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw ParseError(source_, 0, 0, problem);
  }
  std::string name(std::size_t index) const { return "node " + std::to_string(idOf(index)); }
  std::uint32_t idOf(std::size_t index) const {
    return data_.ids.empty() ? static_cast<std::uint32_t>(index + 1) : data_.ids[index];
  }

  void checkShape() const {
    const std::size_t count = data_.parents.size();
    if (count == 0) fail("there are no nodes");
    if (count >= kNone)
      fail("there are " + std::to_string(count) + " nodes, more than 32 bits can number");
    if (data_.branching < 2 || data_.branching > kMostChildren) {
      fail("nodes have up to " + std::to_string(data_.branching) + " children, expected 2 to 64");
    }
    if (data_.depth < 1 || data_.depth > kMostDepth) {
      fail("the depth is " + std::to_string(data_.depth) + ", expected 1 to 64");
    }
    if (data_.format.size < 1 || data_.format.size > kMostDescriptorSize) {
      fail("descriptors have the size " + std::to_string(data_.format.size) +
           ", expected 1 to 4096");
    }
    if (!hasSoundSteps(data_.format)) {
      fail("the scale is " + std::to_string(data_.format.scale) + " and the offset " +
           std::to_string(data_.format.offset) + ", expected finite numbers, and no scale of 0");
    }
    checkLength("ids", data_.ids.size(), true);
    checkLength("weights", data_.weights.size(), false);
    checkLength("words", data_.words.size(), true);
    if (data_.descriptors.size() != count * bytesOf(data_.format)) {
      fail("the descriptors have " + std::to_string(data_.descriptors.size()) +
           " bytes, expected " + std::to_string(bytesOf(data_.format)) + " for each of " +
           std::to_string(count) + " nodes");
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (isFiniteRow(data_.format, &data_.descriptors[i * bytesOf(data_.format)])) continue;
      fail("the descriptor of " + name(i) + " is not finite");
    }
  }
  void checkLength(const char* what, std::size_t size, bool may_be_empty) const {
    if (size == data_.parents.size() || (may_be_empty && size == 0)) return;
    fail("there are " + std::to_string(size) + " " + what + " for " +
         std::to_string(data_.parents.size()) + " nodes");
  }

  void checkIds() const {
    const std::size_t count = data_.parents.size();
    std::vector<bool> is_taken(count + 1, false);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t id = idOf(i);
      if (id < 1 || id > count) {
        fail(name(i) + " is none of the ids 1 to " + std::to_string(count) +
             " that so many nodes have");
      }
      if (is_taken[id]) fail(name(i) + " is there twice");
      is_taken[id] = true;
    }
  }

  // The children of each id side by side, in the order of the list.
  void findChildren() {
    const std::size_t count = data_.parents.size();
    begins_.assign(count + 2, 0);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t parent = data_.parents[i];
      if (parent > count)
        fail(name(i) + " has the parent " + std::to_string(parent) + ", which is not there");
      if (++begins_[parent + 1] > data_.branching) {
        fail("node " + std::to_string(parent) + " has more than " +
             std::to_string(data_.branching) + " children");
      }
    }
    for (std::size_t id = 0; id <= count; ++id) begins_[id + 1] += begins_[id];
    children_.resize(count);
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    for (std::size_t i = 0; i < count; ++i) {
      children_[next[data_.parents[i]]++] = static_cast<std::uint32_t>(i);
    }
  }
  std::uint32_t childCount(std::uint32_t id) const { return begins_[id + 1] - begins_[id]; }

  // Breadth first from the root. Who is not reached hangs on a circle.
  void orderNodes() {
    const std::size_t count = data_.parents.size();
    order_.reserve(count);
    std::size_t level_end = 0;
    std::uint32_t depth = 0;
    appendChildren(0);
    for (std::size_t at = 0; at < order_.size(); ++at) {
      if (at == level_end) {
        if (++depth > data_.depth) {
          fail(name(order_[at]) + " is deeper than the depth, which is " +
               std::to_string(data_.depth));
        }
        level_end = order_.size();
      }
      appendChildren(idOf(order_[at]));
    }
    if (order_.size() == count) return;
    std::vector<bool> is_reached(count, false);
    for (const std::uint32_t index : order_) is_reached[index] = true;
    const auto lost = std::find(is_reached.begin(), is_reached.end(), false);
    fail(name(static_cast<std::size_t>(lost - is_reached.begin())) +
         " does not hang on the root: its parents go round in a circle");
  }
  void appendChildren(std::uint32_t id) {
    order_.insert(order_.end(), children_.begin() + begins_[id],
                  children_.begin() + begins_[id + 1]);
  }

  void numberWords() {
    const std::size_t count = data_.parents.size();
    words_ = data_.words;
    words_.resize(count, kNone);
    for (std::size_t i = 0; i < count; ++i) {
      if (childCount(idOf(i)) != 0) {
        if (words_[i] != kNone) fail(name(i) + " is a word, but has children");
      } else {
        if (data_.words.empty()) words_[i] = word_count_;
        ++word_count_;
      }
    }
    std::vector<bool> is_taken(word_count_, false);
    for (std::size_t i = 0; i < count; ++i) {
      if (childCount(idOf(i)) != 0) continue;
      if (words_[i] == kNone) fail(name(i) + " is a leaf, but no word");
      if (words_[i] >= word_count_) {
        fail(name(i) + " is word " + std::to_string(words_[i]) + ", but there are " +
             std::to_string(word_count_) + " leaves");
      }
      if (is_taken[words_[i]]) fail("word " + std::to_string(words_[i]) + " is there twice");
      is_taken[words_[i]] = true;
    }
  }

  void collectWeights() {
    weight_of_word_.assign(word_count_, 0);
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (words_[i] == kNone) continue;
      const double weight = data_.weights[i];
      if (!(weight >= 0) || weight > std::numeric_limits<double>::max()) {
        fail(name(i) + " has the weight " + std::to_string(weight) + ", expected 0 or more");
      }
      weight_of_word_[words_[i]] = weight + 0.0;  // no -0
    }
    weights_ = weight_of_word_;
    std::sort(weights_.begin(), weights_.end());
    weights_.erase(std::unique(weights_.begin(), weights_.end()), weights_.end());
    are_numbered_ = weights_.size() <= 65536;
    if (!are_numbered_) weights_ = weight_of_word_;
  }

  bool hasOwnIds() const {
    for (std::size_t at = 0; at < order_.size(); ++at) {
      if (idOf(order_[at]) != at + 1) return true;
    }
    return false;
  }

  Vocabulary write() {
    TreeView tree;
    tree.format = data_.format;
    tree.stride = strideOf(data_.format);
    tree.branching = data_.branching;
    tree.depth = data_.depth;
    tree.weighting = data_.weighting;
    tree.scoring = data_.scoring;
    tree.node_count = static_cast<std::uint32_t>(order_.size() + 1);
    tree.word_count = word_count_;
    tree.weight_count = static_cast<std::uint32_t>(weights_.size());
    const bool has_ids = hasOwnIds();
    const TreeLayout layout = layoutOf(tree, are_numbered_, has_ids);
    if (layout.size > std::numeric_limits<std::size_t>::max() / 2)
      fail("is too large for this machine");
    const auto storage = Storage::ofSize(static_cast<std::size_t>(layout.size));
    placeTree(tree, layout, storage->data(), are_numbered_, has_ids);
    std::uint8_t* const bytes = storage->data();
    writeNodes(tree, bytes + layout.links, bytes + layout.child_counts, bytes + layout.descriptors);
    writeWeights(bytes + layout.weight_numbers, bytes + layout.weights);
    if (has_ids) writeIds(bytes + layout.node_ids);
    return Vocabulary(storage, tree);
  }

  void writeNodes(const TreeView& tree, std::uint8_t* links, std::uint8_t* counts,
                  std::uint8_t* descriptors) const {
    const std::size_t row = bytesOf(data_.format);
    std::uint32_t next_child = 1;
    for (std::uint32_t node = 0; node < tree.node_count; ++node) {
      const std::uint32_t id = node == 0 ? 0 : idOf(order_[node - 1]);
      const std::uint32_t count = childCount(id);
      const std::uint32_t link = count != 0 ? next_child : words_[order_[node - 1]];
      std::memcpy(links + std::size_t(node) * 4, &link, 4);
      counts[node] = static_cast<std::uint8_t>(count);
      next_child += count;
      if (node == 0) continue;
      std::memcpy(descriptors + node * tree.stride,
                  data_.descriptors.data() + order_[node - 1] * row, row);
    }
  }

  void writeWeights(std::uint8_t* numbers, std::uint8_t* weights) const {
    std::memcpy(weights, weights_.data(), weights_.size() * sizeof(double));
    if (!are_numbered_) return;
    for (std::size_t word = 0; word < weight_of_word_.size(); ++word) {
      const auto found = std::lower_bound(weights_.begin(), weights_.end(), weight_of_word_[word]);
      const auto number = static_cast<std::uint16_t>(found - weights_.begin());
      std::memcpy(numbers + word * 2, &number, 2);
    }
  }

  void writeIds(std::uint8_t* ids) const {  // the root's stays 0
    for (std::size_t at = 0; at < order_.size(); ++at) {
      const std::uint32_t id = idOf(order_[at]);
      std::memcpy(ids + (at + 1) * 4, &id, 4);
    }
  }

  const TreeData& data_;
  const std::string& source_;
  std::vector<std::uint32_t> begins_, children_;  // of each id
  std::vector<std::uint32_t> order_;              // indices, of nodes 1, 2, 3...
  std::vector<std::uint32_t> words_;              // of each index
  std::uint32_t word_count_ = 0;
  std::vector<double> weight_of_word_, weights_;
  bool are_numbered_ = false;  // whether `weights_` has each weight once
};

// Checks everything: circles, nodes without a parent, ids or words twice or missing, too many
// children, too deep, descriptors that are not finite, weights that are not or negative, lists of
// other lengths. Throws ParseError(source, 0, 0, problem) that names the node.
inline Vocabulary buildVocabulary(const TreeData& data, const std::string& source) {
  return TreeBuilder(data, source).build();
}

// The other way: nodes breadth first, with their ids and words. Of a tree that was not verified
// these may be any numbers.
inline TreeData treeDataOf(const Vocabulary& vocabulary) {
  const TreeView& tree = vocabulary.tree();
  TreeData data;
  data.format = tree.format;
  data.branching = tree.branching;
  data.depth = tree.depth;
  data.weighting = tree.weighting;
  data.scoring = tree.scoring;
  if (tree.node_count < 2) return data;
  const std::size_t count = tree.node_count - 1;
  const std::size_t row = bytesOf(tree.format);
  data.parents.assign(count, 0);
  data.descriptors.resize(count * row);
  for (std::uint32_t node = 0; node < tree.node_count; ++node) {
    const Children children = childrenOf(tree, node);
    for (std::uint32_t i = 0; i < children.count; ++i) {
      data.parents[children.first + i - 1] = nodeId(tree, node);
    }
    if (node == 0) continue;
    const std::uint32_t word = wordOf(tree, node);
    data.ids.push_back(nodeId(tree, node));
    data.words.push_back(word);
    data.weights.push_back(word == kNone ? 0 : weightOf(tree, word));
    std::memcpy(&data.descriptors[(node - 1) * row], descriptorOf(tree, node), row);
  }
  return data;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_BUILD_TREE_H
