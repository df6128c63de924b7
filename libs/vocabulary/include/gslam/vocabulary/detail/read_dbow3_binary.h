// The binary files of DBoW3.
//
// Source: toStream() and fromStream() of Vocabulary.cpp and DescManip.cpp of
// https://github.com/rmsalinas/DBow3.
#ifndef GSLAM_VOCABULARY_DETAIL_READ_DBOW3_BINARY_H
#define GSLAM_VOCABULARY_DETAIL_READ_DBOW3_BINARY_H

#include <gslam/vocabulary/detail/dbow3_header.h>
#include <gslam/vocabulary/detail/foreign_bytes.h>
#include <gslam/vocabulary/detail/node_list.h>
#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/detail/tree_view.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Behind the header the nodes but the root: u32 id, u32 parent, f64 weight, then of the descriptor
// i32 columns, i32 rows, i32 type and its numbers. Then u32 number of words, and of each u32 word
// and u32 node.
class Dbow3BinaryReader {
 public:
  explicit Dbow3BinaryReader(const ForeignBytes& bytes) : bytes_(bytes) {}

  TreeData read() {
    const std::uint32_t nodes = readDbow3Header(bytes_, data_) - 1;
    if (nodes == 0) bytes_.fail(9, "there is no node but the root");
    bytes_.need(kDbow3HeaderSize, 1, kBeforeShape, "a node");
    const std::size_t row = readMatShape(bytes_, kDbow3HeaderSize + kBeforeShape, data_.format);
    record_ = kBeforeShape + kShape + row;
    bytes_.need(kDbow3HeaderSize, nodes, record_, "nodes");
    allocate(nodes, row);
    for (std::size_t i = 0; i < nodes; ++i) readNode(i, row);
    index_of_ = indexOfIds(data_, [this](std::size_t i, const std::string& what) {
      bytes_.fail(offsetOf(i), "the node " + what);
    });
    readWords(offsetOf(nodes));
    dropInnerWeights(data_);
    return std::move(data_);
  }

 private:
  enum : std::size_t { kBeforeShape = 16, kShape = 12 };  // bytes

  std::size_t offsetOf(std::size_t i) const noexcept { return kDbow3HeaderSize + i * record_; }

  void allocate(std::size_t nodes, std::size_t row) {
    data_.ids.resize(nodes);
    data_.parents.resize(nodes);
    data_.weights.resize(nodes);
    data_.words.assign(nodes, kNone);
    data_.descriptors.resize(nodes * row);
  }

  void readNode(std::size_t i, std::size_t row) {
    const std::size_t offset = offsetOf(i);
    data_.ids[i] = bytes_.u32(offset);
    data_.parents[i] = bytes_.u32(offset + 4);
    data_.weights[i] = bytes_.float64(offset + 8);
    const std::size_t shape = offset + kBeforeShape;
    if (std::memcmp(bytes_.at(shape), bytes_.at(kDbow3HeaderSize + kBeforeShape), kShape) != 0) {
      bytes_.fail(shape, "the descriptor has another shape or type than the first");
    }
    const bool are_bytes = data_.format.type == DescriptorType::binary;
    bytes_.copyNumbers(shape + kShape, are_bytes, row, &data_.descriptors[i * row]);
  }

  void readWords(std::size_t offset) {
    bytes_.need(offset, 1, 4, "the number of words");
    const std::uint32_t count = bytes_.u32(offset);
    bytes_.need(offset + 4, count, 8, "words");
    const std::size_t end = offset + 4 + std::size_t(count) * 8;
    for (std::size_t at = offset + 4; at != end; at += 8) {
      setWord(at, bytes_.u32(at), bytes_.u32(at + 4));
    }
    if (end != bytes_.size()) {
      bytes_.fail(end, std::to_string(bytes_.size() - end) + " bytes follow the words");
    }
  }

  void setWord(std::size_t offset, std::uint32_t word, std::uint32_t id) {
    const std::string node = "the node " + std::to_string(id);
    if (id == 0 || id >= index_of_.size()) bytes_.fail(offset + 4, node + " is not there");
    std::uint32_t& known = data_.words[index_of_[id]];
    if (known != kNone) bytes_.fail(offset + 4, node + " has two words");
    if (word >= data_.ids.size()) {
      bytes_.fail(offset, "there are not as many nodes as the word " + std::to_string(word) +
                              " needs");
    }
    known = word;
  }

  const ForeignBytes& bytes_;
  std::size_t record_ = 0;               // bytes of a node
  std::vector<std::uint32_t> index_of_;  // in the list, of each id
  TreeData data_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_READ_DBOW3_BINARY_H
