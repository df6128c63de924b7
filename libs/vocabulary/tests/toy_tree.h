// Trees of a few nodes, and plain writers of every foreign format, for tests of its reader.
#ifndef GSLAM_VOCABULARY_TESTS_TOY_TREE_H
#define GSLAM_VOCABULARY_TESTS_TOY_TREE_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/tree_view.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/vocabulary.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace toy {

struct Node {
  std::uint32_t id = 0;
  std::uint32_t parent = 0;
  bool is_leaf = false;
  std::uint32_t word = 0;  // of a leaf
  double weight = 0;
  std::vector<std::uint8_t> bytes;  // one of the two
  std::vector<float> floats;
};

/// Nodes by their ids, which are 1, 2, 3...
struct Tree {
  std::uint32_t branching = 0;
  std::uint32_t depth = 0;
  std::uint32_t scoring = 0;
  std::uint32_t weighting = 0;
  std::uint32_t size = 0;
  bool is_binary = true;
  std::vector<Node> nodes;

  std::vector<const Node*> childrenOf(std::uint32_t id) const {
    std::vector<const Node*> children;
    for (const Node& node : nodes) {
      if (node.parent == id) children.push_back(&node);
    }
    return children;
  }
};

/// Irregular: nodes have 1 to K children, some end early. Numbers of descriptors and weights are
/// short decimals, which streams print exactly.
inline Tree makeTree(unsigned seed, std::uint32_t branching, std::uint32_t depth,
                     std::uint32_t size, bool is_binary) {
  std::mt19937 random(seed);
  Tree tree;
  tree.branching = branching;
  tree.depth = depth;
  tree.scoring = seed % 6;
  tree.weighting = seed % 4;
  tree.size = size;
  tree.is_binary = is_binary;
  std::vector<std::uint32_t> level(1, 0);
  std::uint32_t words = 0;
  for (std::uint32_t at = 1; at <= depth; ++at) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t parent : level) {
      const std::size_t count = at == 1 ? branching : 1 + random() % branching;
      for (std::size_t i = 0; i < count; ++i) {
        Node node;
        node.id = static_cast<std::uint32_t>(tree.nodes.size() + 1);
        node.parent = parent;
        node.is_leaf = at == depth || (i != 0 && random() % 4 == 0);
        if (node.is_leaf) node.word = words++;
        if (node.is_leaf) node.weight = static_cast<double>(random() % 1000) / 16;
        for (std::uint32_t k = 0; k < size; ++k) {
          const auto number = static_cast<std::uint8_t>(random() >> 20);
          if (is_binary) node.bytes.push_back(number);
          if (!is_binary) node.floats.push_back(static_cast<float>(number) / 16 - 8);
        }
        if (!node.is_leaf) next.push_back(node.id);
        tree.nodes.push_back(node);
      }
    }
    level = next;
  }
  return tree;
}

/// The order in which DBoW2 and DBoW3 write nodes: children side by side, parents from a stack.
inline std::vector<const Node*> stackOrder(const Tree& tree) {
  std::vector<const Node*> order;
  std::vector<std::uint32_t> parents(1, 0);
  while (!parents.empty()) {
    const std::uint32_t parent = parents.back();
    parents.pop_back();
    for (const Node* const child : tree.childrenOf(parent)) {
      order.push_back(child);
      if (!child->is_leaf) parents.push_back(child->id);
    }
  }
  return order;
}

inline std::string numbers(const Node& node) {
  std::ostringstream text;
  for (const std::uint8_t byte : node.bytes) text << unsigned(byte) << " ";
  for (const float number : node.floats) text << number << " ";
  return text.str();
}

inline std::string orbText(const Tree& tree) {
  std::ostringstream text;
  text << tree.branching << " " << tree.depth << "  " << tree.scoring << " " << tree.weighting
       << "\n";
  for (const Node& node : tree.nodes) {
    text << node.parent << " " << (node.is_leaf ? 1 : 0) << " " << numbers(node) << " "
         << node.weight << "\n";
  }
  return text.str();
}

/// @param prefix  in front of the numbers of a descriptor
inline std::string yaml(const Tree& tree, const std::string& prefix) {
  std::ostringstream text;
  text << "%YAML:1.0\n---\nvocabulary:\n   k: " << tree.branching << "\n   L: " << tree.depth
       << "\n   scoringType: " << tree.scoring << "\n   weightingType: " << tree.weighting
       << "\n   nodes:\n";
  for (const Node* const node : stackOrder(tree)) {
    text << "      - { nodeId:" << node->id << ", parentId:" << node->parent
         << ", weight:" << node->weight << ",\n          descriptor:\"" << prefix << numbers(*node)
         << "\" }\n";
  }
  text << "   words:\n";
  for (const Node& node : tree.nodes) {
    if (node.is_leaf) text << "      - { wordId:" << node.word << ", nodeId:" << node.id << " }\n";
  }
  return text.str();
}

/// Bytes, the least of a number first.
class Bytes {
 public:
  template <class Number>
  void add(Number number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof(number));  // tests run on little-endian machines
    for (std::size_t i = 0; i < sizeof(number); ++i) {
      bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
    }
  }
  void add32(std::uint32_t number) { add(number); }
  void addDescriptor(const Node& node) {
    bytes.insert(bytes.end(), node.bytes.begin(), node.bytes.end());
    for (const float number : node.floats) add(number);
  }
  void padTo(std::size_t size) { bytes.resize(size); }

  std::vector<std::uint8_t> bytes;
};

inline void addDbow3Header(const Tree& tree, std::uint32_t nodes, bool is_compressed, Bytes& out) {
  out.add(std::uint64_t(88877711233));
  out.add(std::uint8_t(is_compressed ? 1 : 0));
  for (const std::uint32_t number :
       {nodes, tree.branching, tree.depth, tree.scoring, tree.weighting}) {
    out.add32(number);
  }
}
inline void addMatShape(const Tree& tree, Bytes& out) {
  for (const std::uint32_t number : {tree.size, 1U, tree.is_binary ? 0U : 5U}) out.add32(number);
}

inline std::vector<std::uint8_t> dbow3(const Tree& tree, bool is_compressed = false) {
  Bytes out;
  addDbow3Header(tree, static_cast<std::uint32_t>(tree.nodes.size() + 1), is_compressed, out);
  std::uint32_t words = 0;
  for (const Node* const node : stackOrder(tree)) {
    out.add32(node->id);
    out.add32(node->parent);
    out.add(node->weight);
    addMatShape(tree, out);
    out.addDescriptor(*node);
    words += node->is_leaf ? 1 : 0;
  }
  out.add32(words);
  for (const Node& node : tree.nodes) {
    if (!node.is_leaf) continue;
    out.add32(node.word);
    out.add32(node.id);
  }
  return out.bytes;
}

/// Places of the full tree, of which children of node n are n * K + 1 to n * K + K.
inline std::vector<std::uint8_t> gbow(const Tree& tree) {
  std::uint32_t places = 0;
  std::uint32_t level = 1;
  for (std::uint32_t i = 0; i <= tree.depth; ++i, level *= tree.branching) places += level;
  std::map<std::uint32_t, const Node*> node_at;
  std::map<std::uint32_t, std::uint32_t> place_of = {{0, 0}};
  std::vector<std::uint32_t> inner(1, 0);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    std::uint32_t place = place_of[inner[i]] * tree.branching + 1;
    for (const Node* const child : tree.childrenOf(inner[i])) {
      node_at[place] = child;
      place_of[child->id] = place++;
      if (!child->is_leaf) inner.push_back(child->id);
    }
  }
  Bytes out;
  addDbow3Header(tree, places, false, out);
  addMatShape(tree, out);
  for (std::uint32_t place = 0; place < places; ++place) {
    const bool is_there = place == 0 || node_at.count(place) != 0;
    const std::uint32_t id = place == 0 || !is_there ? 0 : node_at[place]->id;
    out.add32(is_there ? static_cast<std::uint32_t>(tree.childrenOf(id).size()) : 0);
    out.add(static_cast<float>(id == 0 ? 0 : node_at[place]->weight));
  }
  const std::size_t row = std::size_t(tree.size) * (tree.is_binary ? 1 : 4);
  for (std::uint32_t place = 0; place < places; ++place) {
    const std::size_t end = out.bytes.size() + row;
    if (node_at.count(place) != 0) out.addDescriptor(*node_at[place]);
    out.padTo(end);
  }
  return out.bytes;
}

inline std::uint64_t roundUp(std::uint64_t size, std::uint64_t unit) {
  return (size + unit - 1) / unit * unit;
}

/// As FBoW writes it, with the words of the leaves or others.
inline std::vector<std::uint8_t> fbow(const Tree& tree,
                                      const std::map<std::uint32_t, std::uint32_t>& words = {}) {
  const std::uint64_t alignment = tree.is_binary ? 8 : 32;
  const std::uint64_t row = std::uint64_t(tree.size) * (tree.is_binary ? 1 : 4);
  const std::uint64_t stride = roundUp(row, alignment);
  const std::uint64_t rows = roundUp(8, alignment);
  const std::uint64_t infos = rows + tree.branching * stride;
  const std::uint64_t block = roundUp(infos + tree.branching * std::uint64_t(8), alignment);
  std::map<std::uint32_t, std::uint32_t> block_of = {{0, 0}};
  for (const Node& node : tree.nodes) {
    if (!node.is_leaf) block_of.insert({node.id, static_cast<std::uint32_t>(block_of.size())});
  }
  Bytes out;
  out.add(std::uint64_t(55824124));
  for (const char c : {'o', 'r', 'b'}) out.add(c);
  out.padTo(8 + 52);
  out.add32(static_cast<std::uint32_t>(alignment));
  out.add32(static_cast<std::uint32_t>(block_of.size()));
  out.padTo(8 + 64);
  for (const std::uint64_t n : {stride, block, rows, infos, block * block_of.size()}) out.add(n);
  out.add32(tree.is_binary ? 0 : 5);
  out.add32(static_cast<std::uint32_t>(row));
  out.add32(tree.branching);
  out.padTo(8 + 120);
  for (const auto& inner : block_of) {  // ids ascend, and so do blocks
    const std::size_t begin = out.bytes.size();
    const std::vector<const Node*> children = tree.childrenOf(inner.first);
    out.add(static_cast<std::uint16_t>(children.size()));
    out.add(std::uint16_t(0));
    out.add32(inner.first);
    for (std::size_t i = 0; i < children.size(); ++i) {
      out.padTo(begin + rows + i * stride);
      out.addDescriptor(*children[i]);
    }
    out.padTo(begin + infos);
    for (const Node* const child : children) {
      const std::uint32_t word = words.count(child->id) != 0 ? words.at(child->id) : child->word;
      out.add32(child->is_leaf ? word | 0x80000000U : block_of.at(child->id));
      out.add(static_cast<float>(child->weight));
    }
    out.padTo(begin + block);
  }
  return out.bytes;
}

inline std::vector<std::uint8_t> bytesOfText(const std::string& text) {
  return std::vector<std::uint8_t>(text.begin(), text.end());
}

inline gslam::Vocabulary load(const std::vector<std::uint8_t>& bytes) {
  return gslam::loadVocabulary(gslam::Span<const std::uint8_t>(bytes), "toy");
}
inline gslam::Vocabulary load(const std::string& text) {
  return load(bytesOfText(text));
}

/// "" where there is no error.
template <class Content>
std::string errorOf(const Content& content) {
  try {
    load(content);
  } catch (const gslam::ParseError& error) {
    return error.what();
  }
  return "";
}

/// Everything but scoring and weighting, which not all formats have.
inline void expectSame(const gslam::Vocabulary& vocabulary, const Tree& tree) {
  const gslam::detail::TreeView& view = vocabulary.tree();
  ASSERT_EQ(vocabulary.nodeCount(), tree.nodes.size() + 1);
  EXPECT_EQ(vocabulary.branching(), tree.branching);
  EXPECT_EQ(vocabulary.depth(), tree.depth);
  EXPECT_EQ(vocabulary.format().size, tree.size);
  EXPECT_EQ(vocabulary.format().type == gslam::DescriptorType::binary, tree.is_binary);
  std::size_t words = 0;
  for (std::uint32_t number = 0; number < view.node_count; ++number) {
    const std::uint32_t id = gslam::detail::nodeId(view, number);
    const std::vector<const Node*> expected = tree.childrenOf(id);
    const gslam::detail::Children children = gslam::detail::childrenOf(view, number);
    ASSERT_EQ(children.count, expected.size()) << "node " << id;
    for (std::uint32_t i = 0; i < children.count; ++i) {
      EXPECT_EQ(gslam::detail::nodeId(view, children.first + i), expected[i]->id);
    }
    if (id == 0) continue;
    const Node& node = tree.nodes[id - 1];
    const std::uint8_t* const row = gslam::detail::descriptorOf(view, number);
    const void* const data = tree.is_binary ? static_cast<const void*>(node.bytes.data())
                                            : static_cast<const void*>(node.floats.data());
    EXPECT_EQ(std::memcmp(row, data, gslam::bytesOf(view.format)), 0) << "node " << id;
    if (!node.is_leaf) continue;
    ++words;
    ASSERT_EQ(gslam::detail::wordOf(view, number), node.word);
    ASSERT_EQ(vocabulary.weight(node.word), node.weight);
  }
  EXPECT_EQ(vocabulary.wordCount(), words);
}

}  // namespace toy

#endif  // GSLAM_VOCABULARY_TESTS_TOY_TREE_H
