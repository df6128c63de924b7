// The files of the original GSLAM: .gbow.
//
// Source: save() and load() of GSLAM/core/Vocabulary.h of https://github.com/zdzhaoyong/GSLAM.
#ifndef GSLAM_VOCABULARY_DETAIL_READ_GBOW_H
#define GSLAM_VOCABULARY_DETAIL_READ_GBOW_H

#include <gslam/vocabulary/detail/dbow3_header.h>
#include <gslam/vocabulary/detail/foreign_bytes.h>
#include <gslam/vocabulary/detail/tree_data.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::size_t kGbowHeaderSize = kDbow3HeaderSize + 12;

// Has the signature and the header of DBoW3. There, the parent of the first node is next but one,
// which is the root 0; here it is the rows of a descriptor, which are 1.
inline bool looksLikeGbow(const ForeignBytes& bytes) noexcept {
  return bytes.size() >= kDbow3HeaderSize + 8 && bytes.u32(kDbow3HeaderSize + 4) == 1;
}

// Behind the header the shape of all descriptors: i32 columns, i32 rows, i32 type. Then all nodes
// with the root, u32 number of children and f32 weight, and all descriptors. Child i of node n is
// node n * K + 1 + i, whether it is there or not: places that no node leads to are left out here,
// and the others numbered anew, breadth first as they were; so are words, which had no numbers of
// their own.
class GbowReader {
 public:
  explicit GbowReader(const ForeignBytes& bytes) : bytes_(bytes) {}

  TreeData read() {
    const std::uint32_t places = readDbow3Header(bytes_, data_);
    row_ = readMatShape(bytes_, kDbow3HeaderSize, data_.format);
    bytes_.need(kGbowHeaderSize, places, kNode + row_, "nodes and descriptors");
    descriptors_ = kGbowHeaderSize + std::size_t(places) * kNode;
    const std::size_t end = descriptors_ + places * row_;
    if (end != bytes_.size()) {
      bytes_.fail(end, std::to_string(bytes_.size() - end) + " bytes follow the descriptors");
    }
    std::vector<std::uint32_t> reached(1, 0);  // places, breadth first
    for (std::size_t i = 0; i < reached.size(); ++i) {
      appendChildren(static_cast<std::uint32_t>(i), reached[i], places, reached);
    }
    return std::move(data_);
  }

 private:
  enum : std::size_t { kNode = 8 };  // bytes

  // Each place has one parent at most, so there is no end to the tree but that of the places.
  void appendChildren(std::uint32_t id, std::uint32_t place, std::uint32_t places,
                      std::vector<std::uint32_t>& reached) {
    const std::size_t offset = kGbowHeaderSize + std::size_t(place) * kNode;
    const std::uint64_t count = bytes_.u32(offset);
    const std::uint64_t first = std::uint64_t(place) * data_.branching + 1;
    if (count > data_.branching) {
      bytes_.fail(offset, "a node has " + std::to_string(count) + " children, but K is " +
                              std::to_string(data_.branching));
    }
    if (count != 0 && (first > places || count > places - first)) {
      bytes_.fail(offset, "the children of a node would be behind the last, which is " +
                              std::to_string(places - 1));
    }
    for (std::uint64_t child = first; child < first + count; ++child) {
      reached.push_back(static_cast<std::uint32_t>(child));
      data_.parents.push_back(id);
      data_.weights.push_back(bytes_.float32(kGbowHeaderSize + std::size_t(child) * kNode + 4));
      appendDescriptor(descriptors_ + std::size_t(child) * row_);
    }
  }

  void appendDescriptor(std::size_t offset) {
    const std::size_t size = data_.descriptors.size();
    data_.descriptors.resize(size + row_);
    bytes_.copyNumbers(offset, data_.format.type == DescriptorType::binary, row_,
                       &data_.descriptors[size]);
  }

  const ForeignBytes& bytes_;
  std::size_t row_ = 0;          // bytes of a descriptor
  std::size_t descriptors_ = 0;  // where they begin
  TreeData data_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_READ_GBOW_H
