// What the binary files of DBoW3 and of the original GSLAM begin with.
#ifndef GSLAM_VOCABULARY_DETAIL_DBOW3_HEADER_H
#define GSLAM_VOCABULARY_DETAIL_DBOW3_HEADER_H

#include <gslam/vocabulary/detail/foreign_bytes.h>
#include <gslam/vocabulary/detail/node_list.h>
#include <gslam/vocabulary/detail/tree_data.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::uint64_t kDbow3Signature = 88877711233u;
constexpr std::size_t kDbow3HeaderSize = 29;

// At 0 the signature, at 8 whether it is compressed, at 9 the number of nodes with the root, then
// four int: K, L, scoring and weighting.
// @return how many nodes there are, with the root; at least 1
inline std::uint32_t readDbow3Header(const ForeignBytes& bytes, TreeData& data) {
  bytes.need(0, 1, kDbow3HeaderSize, "a header");
  if (*bytes.at(8) > 1) {
    bytes.fail(8, "expected 0 or 1, for a file that is compressed, got " +
                      std::to_string(unsigned(*bytes.at(8))));
  }
  if (*bytes.at(8) == 1) {
    bytes.fail(8,
               "the file is compressed by quicklz, which is not read here: load it with DBoW3, and "
               "save it with binary_compressed = false, or as .yml");
  }
  const std::uint32_t nodes = bytes.u32(9);
  if (nodes == 0) bytes.fail(9, "the vocabulary is empty");
  data.branching = bytes.u32(13);
  if (data.branching < 2 || data.branching > kMostChildren) {
    bytes.fail(13, "K is " + std::to_string(data.branching) + ", expected 2 to 64");
  }
  data.depth = bytes.u32(17);
  if (data.depth < 1 || data.depth > kMostDepth) {
    bytes.fail(17, "L is " + std::to_string(data.depth) + ", expected 1 to 64");
  }
  if (bytes.u32(21) > 5) {
    bytes.fail(21, "the scoring is " + std::to_string(bytes.u32(21)) + ", expected 0 to 5");
  }
  if (bytes.u32(25) > 3) {
    bytes.fail(25, "the weighting is " + std::to_string(bytes.u32(25)) + ", expected 0 to 3");
  }
  data.scoring = static_cast<Scoring>(bytes.u32(21));
  data.weighting = static_cast<Weighting>(bytes.u32(25));
  return nodes;
}

// Columns, rows and type of the cv::Mat of one descriptor.
// @return bytes of one
inline std::size_t readMatShape(const ForeignBytes& bytes, std::size_t offset,
                                DescriptorFormat& format) {
  bytes.need(offset, 1, 12, "the shape of descriptors");
  const std::uint32_t columns = bytes.u32(offset);
  if (columns < 1 || columns > 4096) {
    bytes.fail(offset,
               "a descriptor has " + std::to_string(columns) + " columns, expected 1 to 4096");
  }
  if (bytes.u32(offset + 4) != 1) {
    bytes.fail(offset + 4,
               "a descriptor has " + std::to_string(bytes.u32(offset + 4)) + " rows, expected 1");
  }
  const std::uint32_t type = bytes.u32(offset + 8);
  if (!isOpenCvType(type)) bytes.fail(offset + 8, "a descriptor " + strangeType(type));
  format.type = type == kOpenCvBytes ? DescriptorType::binary : DescriptorType::float32;
  format.size = columns;
  return bytesOf(format);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_DBOW3_HEADER_H
