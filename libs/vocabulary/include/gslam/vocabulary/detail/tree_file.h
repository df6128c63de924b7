// The bytes of a vocabulary file: what its header says, and whether the rest keeps to it.
#ifndef GSLAM_VOCABULARY_DETAIL_TREE_FILE_H
#define GSLAM_VOCABULARY_DETAIL_TREE_FILE_H

#include <gslam/base/detail/checksum.h>
#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/encode.h>
#include <gslam/vocabulary/detail/storage.h>
#include <gslam/vocabulary/detail/swap_tree.h>
#include <gslam/vocabulary/detail/tree_layout.h>
#include <gslam/vocabulary/vocabulary.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr char kTreeMagic[9] = "GSLAMVOC";
constexpr std::uint32_t kTreeByteOrder = 0x01020304;
constexpr std::uint32_t kOtherByteOrder = 0x04030201;
constexpr std::uint32_t kTreeVersion = 1;

inline std::uint64_t checksumOfHeader(const TreeHeader& header) {
  return Xxh64::of(reinterpret_cast<const std::uint8_t*>(&header),
                   offsetof(TreeHeader, header_checksum));
}

// All but the checksums.
inline TreeHeader headerOf(const TreeView& tree) {
  TreeHeader header = {};
  std::memcpy(header.magic, kTreeMagic, sizeof header.magic);
  header.byte_order = kTreeByteOrder;
  header.version = kTreeVersion;
  header.descriptor_type = static_cast<std::uint8_t>(tree.format.type);
  header.weighting = static_cast<std::uint8_t>(tree.weighting);
  header.scoring = static_cast<std::uint8_t>(tree.scoring);
  header.has_weight_numbers = tree.weight_numbers != nullptr ? 1 : 0;
  header.has_node_ids = tree.node_ids != nullptr ? 1 : 0;
  header.descriptor_size = tree.format.size;
  header.scale = tree.format.scale;
  header.offset = tree.format.offset;
  header.branching = tree.branching;
  header.depth = tree.depth;
  header.node_count = tree.node_count;
  header.word_count = tree.word_count;
  header.weight_count = tree.weight_count;
  header.file_size = layoutOf(tree, tree.weight_numbers != nullptr, tree.node_ids != nullptr).size;
  return header;
}

// Whether a tree is a file with its checksums, mapped or in memory. Before a tree that was made
// there are zeros.
inline bool isFile(const Storage& storage) {
  return storage.size() >= kTreeHeaderSize &&
         std::memcmp(storage.data(), kTreeMagic, sizeof kTreeMagic - 1) == 0;
}

inline void checkBody(const Storage& storage, std::uint64_t checksum, const std::string& name) {
  const std::uint64_t sum =
      Xxh64::of(storage.data() + kTreeHeaderSize, storage.size() - kTreeHeaderSize);
  if (sum == checksum) return;
  throw ParseError(name, 0, 0, "is damaged: bytes 256 to its end do not fit its checksum");
}
inline void checkBody(const Storage& storage, const std::string& name) {
  if (!isFile(storage)) return;
  TreeHeader header;
  std::memcpy(&header, storage.data(), sizeof header);
  checkBody(storage, header.checksum, name);
}

// Makes a tree of the bytes of a file, of which only the header is read.
class TreeOpener {
 public:
  TreeOpener(std::shared_ptr<const Storage> storage, const std::string& name)
      : storage_(std::move(storage)), name_(name) {}

  Vocabulary open() {
    readHeader();
    TreeView tree = treeOfHeader();
    const bool has_numbers = header_.has_weight_numbers != 0;
    const bool has_ids = header_.has_node_ids != 0;
    const TreeLayout layout = layoutOf(tree, has_numbers, has_ids);
    if (layout.size != header_.file_size || layout.size != storage_->size()) {
      fail("has " + std::to_string(storage_->size()) + " bytes, but its header asks for " +
           std::to_string(layout.size) + ": it is cut off, or something was added");
    }
    if (is_swapped_) swapAll(tree, layout, has_numbers, has_ids);
    placeTree(tree, layout, storage_->data(), has_numbers, has_ids);
    return Vocabulary(storage_, tree);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw ParseError(name_, 0, 0, problem);
  }

  void readHeader() {
    const std::size_t size = storage_->size();
    if (size < sizeof kTreeMagic - 1 ||
        std::memcmp(storage_->data(), kTreeMagic, sizeof kTreeMagic - 1) != 0) {
      fail("does not begin with GSLAMVOC: it is no vocabulary of GSLAM");
    }
    if (size < kTreeHeaderSize) {
      fail("ends at byte " + std::to_string(size) + ", inside its header of 256 bytes");
    }
    std::memcpy(&header_, storage_->data(), kTreeHeaderSize);
    const std::uint64_t checksum = checksumOfHeader(header_);
    is_swapped_ = header_.byte_order == kOtherByteOrder;
    if (is_swapped_) swapHeader(header_);
    if (header_.byte_order != kTreeByteOrder) {
      fail("has the order of bytes " + std::to_string(header_.byte_order) +
           " at byte 8, expected " + std::to_string(kTreeByteOrder) + ": it is damaged");
    }
    if (header_.version != kTreeVersion) {
      fail("has version " + std::to_string(header_.version) + " at byte 12, expected 1: it needs " +
           "another GSLAM");
    }
    if (header_.header_checksum != checksum) {
      fail("has a damaged header: bytes 0 to 247 do not fit the checksum at byte 248");
    }
  }

  // A checksum is easily made to fit: so all is checked.
  TreeView treeOfHeader() const {
    check("type of descriptors", 16, header_.descriptor_type, 0, 3);
    check("weighting", 17, header_.weighting, 0, 3);
    check("scoring", 18, header_.scoring, 0, 5);
    check("size of descriptors", 24, header_.descriptor_size, 1, kMostDescriptorSize);
    check("number of children", 36, header_.branching, 2, kMostChildren);
    check("depth", 40, header_.depth, 1, kMostDepth);
    check("number of nodes", 44, header_.node_count, 2, kNone);
    check("number of words", 48, header_.word_count, 1, header_.node_count - 1);
    const bool has_numbers = header_.has_weight_numbers != 0;
    check("number of weights", 52, header_.weight_count, has_numbers ? 1 : header_.word_count,
          has_numbers ? 65536 : header_.word_count);
    TreeView tree;
    tree.format.type = static_cast<DescriptorType>(header_.descriptor_type);
    tree.format.size = header_.descriptor_size;
    tree.format.scale = header_.scale;
    tree.format.offset = header_.offset;
    if (!hasSoundSteps(tree.format)) {
      fail("has the scale " + std::to_string(header_.scale) + " and the offset " +
           std::to_string(header_.offset) +
           " at byte 28, expected finite numbers, and no scale of 0");
    }
    tree.stride = strideOf(tree.format);
    tree.branching = header_.branching;
    tree.depth = header_.depth;
    tree.weighting = static_cast<Weighting>(header_.weighting);
    tree.scoring = static_cast<Scoring>(header_.scoring);
    tree.node_count = header_.node_count;
    tree.word_count = header_.word_count;
    tree.weight_count = header_.weight_count;
    return tree;
  }
  void check(const char* what, int offset, std::uint32_t value, std::uint32_t least,
             std::uint32_t most) const {
    if (value >= least && value <= most) return;
    fail("has the " + std::string(what) + " " + std::to_string(value) + " at byte " +
         std::to_string(offset) + ", expected " + std::to_string(least) + " to " +
         std::to_string(most));
  }

  // Of another machine: a copy of the lists in the order of this one. All of it is read, so it is
  // checked, too.
  void swapAll(const TreeView& tree, const TreeLayout& layout, bool has_numbers, bool has_ids) {
    checkBody(*storage_, header_.checksum, name_);
    const std::shared_ptr<Storage> copy = Storage::ofSize(storage_->size());
    std::memcpy(copy->data() + kTreeHeaderSize, storage_->data() + kTreeHeaderSize,
                storage_->size() - kTreeHeaderSize);
    swapLists(tree, layout, has_numbers, has_ids, copy->data());
    storage_ = copy;
  }

  std::shared_ptr<const Storage> storage_;
  const std::string& name_;
  TreeHeader header_ = {};
  bool is_swapped_ = false;
};

// Whether every number of a tree is what tree_view.h says.
class TreeChecker {
 public:
  TreeChecker(const TreeView& tree, const std::string& name) : tree_(tree), name_(name) {}

  void check() const {
    checkNodes();
    checkDescriptors();
    checkWeights();
    if (tree_.node_ids != nullptr) checkIds();
  }

 private:
  [[noreturn]] void fail(const char* what, std::size_t number, const std::string& problem) const {
    throw ParseError(name_, 0, 0, what + (" " + std::to_string(number)) + " " + problem);
  }

  // Children follow each other, behind their parents; each leaf is a word, and each word a leaf.
  void checkNodes() const {
    std::vector<bool> is_taken(tree_.word_count, false);
    std::uint64_t next_child = 1;
    std::uint64_t words = 0;
    for (std::uint32_t node = 0; node < tree_.node_count; ++node) {
      const std::uint32_t count = tree_.child_counts[node];
      const std::uint32_t link = tree_.links[node];
      if (node >= next_child) fail("node", node, "has no parent");
      if (count > tree_.branching) {
        fail("node", node,
             "has " + std::to_string(count) + " children, but no more than " +
                 std::to_string(tree_.branching) + " are allowed");
      }
      if (count != 0) {
        if (link != next_child || link + std::uint64_t(count) > tree_.node_count) {
          fail("node", node,
               "has children from " + std::to_string(link) + " on, expected " +
                   std::to_string(next_child));
        }
        next_child += count;
        continue;
      }
      if (link >= tree_.word_count) {
        fail("node", node,
             "is word " + std::to_string(link) + ", but there are " +
                 std::to_string(tree_.word_count));
      }
      if (is_taken[link]) fail("word", link, "is there twice");
      is_taken[link] = true;
      ++words;
    }
    if (next_child != tree_.node_count) {
      fail("node", static_cast<std::size_t>(next_child), "has no parent");
    }
    if (words != tree_.word_count) {
      fail("word", static_cast<std::size_t>(words), "has no leaf: there are fewer of these");
    }
    checkDepth();
  }

  void checkDepth() const {
    std::uint32_t level_end = 0;  // the last node of a level
    for (std::uint32_t level = 0; level <= tree_.depth; ++level) {
      std::uint32_t last_child = 0;
      // The last inner node at or before the end of the level has the last child.
      for (std::uint32_t node = level_end + 1; node-- > 0 && last_child == 0;) {
        const Children children = childrenOf(tree_, node);
        if (children.count != 0) last_child = children.first + children.count - 1;
      }
      if (last_child <= level_end) return;  // no deeper level
      level_end = last_child;
    }
    fail("node", level_end, "is deeper than " + std::to_string(tree_.depth));
  }

  // Kernels read what is behind a descriptor, too.
  void checkDescriptors() const {
    const std::size_t size = bytesOf(tree_.format);
    for (std::uint32_t node = 0; node < tree_.node_count; ++node) {
      const std::uint8_t* const row = descriptorOf(tree_, node);
      if (!isFiniteRow(tree_.format, row))
        fail("node", node, "has a descriptor that is not finite");
      for (std::size_t i = size; i < tree_.stride; ++i) {
        if (row[i] != 0) fail("node", node, "has bytes other than 0 behind its descriptor");
      }
    }
  }

  void checkWeights() const {
    for (std::size_t i = 0; i < tree_.weight_count; ++i) {
      const double weight = tree_.weights[i];
      if (!(weight >= 0) || weight > std::numeric_limits<double>::max()) {
        fail("weight", i, "is " + std::to_string(weight) + ", expected 0 or more");
      }
    }
    if (tree_.weight_numbers == nullptr) return;
    for (std::size_t word = 0; word < tree_.word_count; ++word) {
      if (tree_.weight_numbers[word] < tree_.weight_count) continue;
      fail("word", word,
           "has the weight number " + std::to_string(tree_.weight_numbers[word]) +
               ", but there are " + std::to_string(tree_.weight_count));
    }
  }

  void checkIds() const {
    std::vector<bool> is_taken(tree_.node_count, false);
    for (std::uint32_t node = 0; node < tree_.node_count; ++node) {
      const std::uint32_t id = tree_.node_ids[node];
      if (id >= tree_.node_count || is_taken[id] || (node == 0) != (id == 0)) {
        fail("node", node,
             "has the id " + std::to_string(id) + ", which is another's or too large");
      }
      is_taken[id] = true;
    }
  }

  const TreeView& tree_;
  const std::string& name_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_TREE_FILE_H
