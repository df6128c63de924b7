// The files of FBoW: .fbow.
//
// Source: toStream(), setParams() and the struct Block of src/fbow.h and src/fbow.cpp, and
// tests/dbow2fbow.cpp, of https://github.com/rmsalinas/fbow.
#ifndef GSLAM_VOCABULARY_DETAIL_READ_FBOW_H
#define GSLAM_VOCABULARY_DETAIL_READ_FBOW_H

#include <gslam/vocabulary/detail/foreign_bytes.h>
#include <gslam/vocabulary/detail/node_list.h>
#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/detail/tree_view.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::uint64_t kFbowSignature = 55824124;

// A block for each inner node, with its children side by side. Nodes are numbered breadth first
// here; there, they have no numbers. The depth is that of the tree: the file does not say it.
//
// FBoW's own training numbers some words twice, and ends with 1 for all weights. So words keep
// their numbers where these are 0, 1, 2... each once, as files have it that were made of DBoW2's;
// else all are numbered anew, breadth first. What FBoW calls two different words by one number are
// two words here. Bags of FBoW are sums of weights, of norm L2, which is tf-idf and L2 in DBoW2.
class FbowReader {
 public:
  explicit FbowReader(const ForeignBytes& bytes) : bytes_(bytes) {}

  TreeData read() {
    readHeader();
    data_.weighting = Weighting::tf_idf;
    data_.scoring = Scoring::l2;
    data_.branching = branching_;
    is_reached_.assign(block_count_, false);
    std::vector<Inner> inner(1, Inner{0, 0});  // breadth first
    is_reached_[0] = true;
    std::size_t level_end = 0;
    for (std::size_t i = 0; i < inner.size(); ++i) {
      if (i == level_end) {
        ++data_.depth;
        level_end = inner.size();
      }
      readBlock(inner[i], inner);
    }
    if (inner.size() != block_count_) {
      bytes_.fail(kData, std::to_string(block_count_ - inner.size()) + " of " +
                             std::to_string(block_count_) + " blocks have no parent");
    }
    if (!areNumbered()) data_.words.clear();
    return std::move(data_);
  }

 private:
  // Places of the struct params behind the signature, as it is laid out on 64-bit machines: 50
  // characters of a name, u32 alignment at 52 and blocks at 56, u64 at 64 to 96, and 4 bytes of
  // padding at the end.
  enum : std::size_t {
    kBlocks = 64,
    kRowStride = 72,
    kBlockSize = 80,
    kRows = 88,
    kInfos = 96,
    kTotal = 104,
    kType = 112,
    kRowBytes = 116,
    kBranching = 120,
    kData = 128
  };

  struct Inner {
    std::uint32_t block;
    std::uint32_t id;
  };

  void readHeader() {
    bytes_.need(0, 1, kData, "a header");
    block_count_ = bytes_.u32(kBlocks);
    row_stride_ = bytes_.u64(kRowStride);
    block_size_ = bytes_.u64(kBlockSize);
    rows_ = bytes_.u64(kRows);
    infos_ = bytes_.u64(kInfos);
    branching_ = bytes_.u32(kBranching);
    readFormat();
    checkBlock();
    if (block_count_ == 0) bytes_.fail(kBlocks, "the vocabulary is empty");
    bytes_.need(kData, block_count_, static_cast<std::size_t>(block_size_), "blocks");
    const std::uint64_t size = block_size_ * block_count_;
    if (bytes_.u64(kTotal) != size) {
      bytes_.fail(kTotal, "all blocks have " + std::to_string(bytes_.u64(kTotal)) +
                              " bytes, expected " + std::to_string(size));
    }
    if (bytes_.size() - kData != size) {
      bytes_.fail(kData + static_cast<std::size_t>(size),
                  std::to_string(bytes_.size() - kData - size) + " bytes follow the blocks");
    }
  }

  void readFormat() {
    const std::uint32_t type = bytes_.u32(kType);
    if (!isOpenCvType(type)) bytes_.fail(kType, "a descriptor " + strangeType(type));
    row_ = bytes_.u32(kRowBytes);
    const bool is_binary = type == kOpenCvBytes;
    const std::uint32_t unit = is_binary ? 1 : 4;
    if (row_ < 1 || row_ % unit != 0 || row_ / unit > 4096) {
      bytes_.fail(kRowBytes, "a descriptor has " + std::to_string(row_) +
                                 " bytes, expected 1 to 4096 numbers of " + std::to_string(unit));
    }
    data_.format.type = is_binary ? DescriptorType::binary : DescriptorType::float32;
    data_.format.size = row_ / unit;
  }

  // Inside a block: u16 children, u16 whether all are leaves, u32 parent; K rows; K times u32 and
  // f32. Nothing may overlap; what the padding is, is the file's business.
  void checkBlock() const {
    if (branching_ < 2 || branching_ > kMostChildren) {
      bytes_.fail(kBranching, "K is " + std::to_string(branching_) + ", expected 2 to 64");
    }
    const std::uint64_t most = std::uint64_t(1) << 30;  // so that nothing overflows
    if (row_stride_ < row_ || row_stride_ > most) failPlace(kRowStride, "rows", row_stride_);
    if (rows_ < 8 || rows_ > most) failPlace(kRows, "the first row", rows_);
    if (infos_ < rows_ + branching_ * row_stride_ || infos_ > most) {
      failPlace(kInfos, "the children", infos_);
    }
    if (block_size_ < infos_ + std::uint64_t(branching_) * 8 || block_size_ > most) {
      failPlace(kBlockSize, "the end", block_size_);
    }
  }
  [[noreturn]] void failPlace(std::size_t offset, const char* what, std::uint64_t place) const {
    bytes_.fail(offset, std::to_string(place) + " as the place of " + what +
                            " in a block does not fit the other sizes");
  }

  std::size_t offsetOf(std::uint32_t block) const noexcept {
    return kData + static_cast<std::size_t>(block_size_) * block;
  }

  void readBlock(Inner parent, std::vector<Inner>& inner) {
    const std::size_t offset = offsetOf(parent.block);
    const std::uint32_t count = bytes_.u32(offset) & 0xFFFF;
    if (count < 1 || count > branching_) {
      bytes_.fail(offset, "a block has " + std::to_string(count) + " nodes, expected 1 to " +
                              std::to_string(branching_));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      data_.parents.push_back(parent.id);
      const std::size_t size = data_.descriptors.size();
      data_.descriptors.resize(size + row_);
      bytes_.copyNumbers(offset + static_cast<std::size_t>(rows_ + i * row_stride_),
                         data_.format.type == DescriptorType::binary, row_,
                         &data_.descriptors[size]);
      readChild(offset + static_cast<std::size_t>(infos_) + i * std::size_t(8), inner);
    }
  }

  void readChild(std::size_t offset, std::vector<Inner>& inner) {
    const std::uint32_t leaf_mark = 0x80000000u;
    const std::uint32_t child = bytes_.u32(offset);
    const bool is_leaf = (child & leaf_mark) != 0;
    data_.words.push_back(is_leaf ? child & ~leaf_mark : kNone);
    data_.weights.push_back(is_leaf ? bytes_.float32(offset + 4) : 0);
    if (is_leaf) return;
    if (child >= block_count_) {
      bytes_.fail(offset, "the block " + std::to_string(child) + " is not there");
    }
    if (is_reached_[child]) {
      bytes_.fail(offset, "the block " + std::to_string(child) + " has two parents");
    }
    is_reached_[child] = true;
    inner.push_back(Inner{child, static_cast<std::uint32_t>(data_.parents.size())});
  }

  // Whether words have the numbers 0, 1, 2... each once.
  bool areNumbered() const {
    std::size_t count = 0;
    for (const std::uint32_t word : data_.words) count += word != kNone ? 1 : 0;
    std::vector<bool> is_taken(count, false);
    for (const std::uint32_t word : data_.words) {
      if (word == kNone) continue;
      if (word >= count || is_taken[word]) return false;
      is_taken[word] = true;
    }
    return true;
  }

  const ForeignBytes& bytes_;
  std::uint32_t block_count_ = 0, branching_ = 0, row_ = 0;
  std::uint64_t row_stride_ = 0, block_size_ = 0, rows_ = 0, infos_ = 0;  // bytes
  std::vector<bool> is_reached_;                                          // blocks
  TreeData data_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_READ_FBOW_H
