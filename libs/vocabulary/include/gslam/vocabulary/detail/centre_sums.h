// The centres of clusters of descriptors: majorities of bits, means of floats.
#ifndef GSLAM_VOCABULARY_DETAIL_CENTRE_SUMS_H
#define GSLAM_VOCABULARY_DETAIL_CENTRE_SUMS_H

#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/bit_counts.h>
#include <gslam/vocabulary/detail/tree_view.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Rows that one thread works on at a time, whatever the number of threads: so sums of floats are
// rounded in the same way.
constexpr std::size_t kChunkRows = 2048;
constexpr std::uint32_t kMostClusters = 64;

// Rows are binary or float32, strideOf(format) bytes apart. Chunks are summed on their own, by any
// thread, and then in their order.
class CentreSums {
 public:
  explicit CentreSums(const DescriptorFormat& format)
      : format_(format),
        stride_(strideOf(format)),
        words_(stride_ / 8),
        is_binary_(format.type == DescriptorType::binary) {}

  void begin(std::size_t chunks, std::size_t clusters) {
    chunks_ = chunks;
    clusters_ = clusters;
    counts_.resize(chunks * clusters);
    if (is_binary_) {
      planes_.resize(chunks * clusters * kChunkPlanes * words_);
    } else {
      sums_.resize(chunks * clusters * format_.size);
    }
  }

  // Of the rows of a chunk, of which each is in the cluster of its label.
  void sumChunk(std::size_t chunk, const std::uint8_t* rows, const std::uint8_t* labels,
                std::size_t count) {
    std::uint32_t* const counts = &counts_[chunk * clusters_];
    std::fill(counts, counts + clusters_, 0u);
    for (std::size_t i = 0; i < count; ++i) ++counts[labels[i]];
    if (is_binary_) {
      sumBits(chunk, rows, labels, count);
    } else {
      sumFloats(chunk, rows, labels, count);
    }
  }

  // Of one row of floats, which changes its cluster. Rounding leaves traces of where it has been.
  void moveRow(std::size_t chunk, const std::uint8_t* row, std::size_t from, std::size_t to) {
    const std::size_t size = format_.size;
    --counts_[chunk * clusters_ + from];
    ++counts_[chunk * clusters_ + to];
    const float* const numbers = reinterpret_cast<const float*>(row);
    double* const minus = &sums_[(chunk * clusters_ + from) * size];
    double* const plus = &sums_[(chunk * clusters_ + to) * size];
    for (std::size_t d = 0; d < size; ++d) {
      minus[d] -= static_cast<double>(numbers[d]);
      plus[d] += static_cast<double>(numbers[d]);
    }
  }

  std::size_t countOf(std::size_t cluster) const noexcept {
    std::size_t count = 0;
    for (std::size_t c = 0; c < chunks_; ++c) count += counts_[c * clusters_ + cluster];
    return count;
  }

  // Of a cluster with rows. A bit is set where it is in half of the rows or more, as in DBoW2.
  void writeCentre(std::size_t cluster, std::uint8_t* centre) {
    if (is_binary_) {
      writeMajority(cluster, centre);
    } else {
      writeMean(cluster, centre);
    }
  }

 private:
  static constexpr std::uint32_t kChunkPlanes = 12;  // of counts up to kChunkRows

  void sumBits(std::size_t chunk, const std::uint8_t* rows, const std::uint8_t* labels,
               std::size_t count) {
    const std::uint32_t* const counts = &counts_[chunk * clusters_];
    std::uint32_t ends[kMostClusters];
    for (std::size_t k = 0, end = 0; k < clusters_; ++k) {
      ends[k] = static_cast<std::uint32_t>(end);
      end += counts[k];
    }
    const std::uint8_t* ordered[kChunkRows];
    for (std::size_t i = 0; i < count; ++i) ordered[ends[labels[i]]++] = rows + i * stride_;
    for (std::size_t k = 0; k < clusters_; ++k) {
      sumBitRows(ordered + ends[k] - counts[k], counts[k], words_, planesOf(chunk, k));
    }
  }

  void sumFloats(std::size_t chunk, const std::uint8_t* rows, const std::uint8_t* labels,
                 std::size_t count) {
    const std::size_t size = format_.size;
    double* const sums = &sums_[chunk * clusters_ * size];
    std::fill(sums, sums + clusters_ * size, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const float* const row = reinterpret_cast<const float*>(rows + i * stride_);
      double* const sum = sums + labels[i] * size;
      for (std::size_t d = 0; d < size; ++d) sum[d] += static_cast<double>(row[d]);
    }
  }

  void writeMajority(std::size_t cluster, std::uint8_t* centre) {
    const std::size_t count = countOf(cluster);
    const std::uint32_t planes = planesFor(count);
    total_.assign(planes * words_ + words_, 0);
    for (std::size_t c = 0; c < chunks_; ++c) {
      addBitCounts(planesOf(c, cluster), planesFor(counts_[c * clusters_ + cluster]), &total_[0],
                   planes, words_);
    }
    std::uint64_t* const bits = &total_[planes * words_];
    bitsCountedAtLeast(&total_[0], planes, words_, count / 2 + count % 2, bits);
    std::memcpy(centre, bits, stride_);
  }

  void writeMean(std::size_t cluster, std::uint8_t* centre) {
    const std::size_t size = format_.size;
    const auto count = static_cast<double>(countOf(cluster));
    float* const mean = reinterpret_cast<float*>(centre);
    for (std::size_t d = 0; d < size; ++d) {
      double sum = 0;
      for (std::size_t c = 0; c < chunks_; ++c) sum += sums_[(c * clusters_ + cluster) * size + d];
      mean[d] = static_cast<float>(sum / count);
    }
  }

  std::uint64_t* planesOf(std::size_t chunk, std::size_t cluster) noexcept {
    return &planes_[(chunk * clusters_ + cluster) * kChunkPlanes * words_];
  }

  const DescriptorFormat format_;
  const std::size_t stride_;
  const std::size_t words_;
  const bool is_binary_;
  std::size_t chunks_ = 0;
  std::size_t clusters_ = 0;
  std::vector<std::uint32_t> counts_;  // of a chunk, of a cluster
  std::vector<std::uint64_t> planes_;  // the same, of a plane, of a word
  std::vector<double> sums_;           // the same, of a float
  std::vector<std::uint64_t> total_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_CENTRE_SUMS_H
