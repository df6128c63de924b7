#include "bundle/fast_pattern.h"

#include <gslam/base/parallel.h>

#include <algorithm>
#include <cstdint>

#include "bundle/fast_views.h"
#include "raw_vector.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

// Where the points of observations end.
RawVector<std::uint32_t> endOfObservations(const FastStructure& structure, unsigned threads) {
  RawVector<std::uint32_t> ends(structure.observationCount());
  parallelFor(
      0, structure.points.size(),
      [&](std::size_t p) {
        const std::uint32_t end = structure.point_begin[p + 1];
        std::fill(ends.begin() + structure.point_begin[p], ends.begin() + end, end);
      },
      fastParallel(8192, threads));
  return ends;
}

}  // namespace

FastPattern makeFastPattern(const FastStructure& structure, unsigned threads) {
  const std::size_t n = structure.blocks.size();
  const RawVector<std::uint32_t> ends = endOfObservations(structure, threads);
  std::vector<std::vector<std::uint32_t>> rows(n);
  parallelChunks(
      0, n,
      [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> seen_by(n, kNoBlock);
        for (std::size_t row = first; row < last; ++row) {
          for (std::size_t i = structure.row_begin[row]; i < structure.row_begin[row + 1]; ++i) {
            const std::size_t k = structure.row[i];
            const std::size_t end = ends[k];
            for (std::size_t other = k + 1; other < end; ++other) {
              const std::uint32_t column = structure.blockOf(other);
              if (column == kNoBlock) break;
              if (column == row || seen_by[column] == row) continue;
              seen_by[column] = static_cast<std::uint32_t>(row);
              rows[row].push_back(column);
            }
          }
          std::sort(rows[row].begin(), rows[row].end());
        }
      },
      fastParallel(std::max<std::size_t>(8, n / 64), threads));
  FastPattern pattern;
  pattern.row_begin.assign(1, 0);
  for (std::vector<std::uint32_t>& row : rows) {
    pattern.columns.insert(pattern.columns.end(), row.begin(), row.end());
    pattern.row_begin.push_back(pattern.columns.size());
  }
  return pattern;
}

template <class T>
FastSizes sizesOf(const FastStructure& structure, const FastPattern& pattern) {
  FastSizes sizes;
  sizes.observations = static_cast<double>(structure.observationCount());
  sizes.slots = static_cast<double>(structure.blocks.size() + pattern.columns.size());
  sizes.block_bytes = static_cast<double>(blockStride(structure.freedom) * sizeof(T));
  sizes.is_resident = isResident<T>(structure.observationCount());
  for (std::size_t p = 0; p < structure.points.size(); ++p) {
    const double n = structure.point_begin[p + 1] - structure.point_begin[p];
    sizes.pairs += n * (n - 1) / 2;
  }
  return sizes;
}

template FastSizes sizesOf<float>(const FastStructure&, const FastPattern&);
template FastSizes sizesOf<double>(const FastStructure&, const FastPattern&);

// The unit is a block in a product. As measured with matrices that a cache has and with some that
// it has not, which differ by a factor of 3.
FastPrices pricesOf(const FastSizes& sizes, bool is_explicit) {
  constexpr double kOfObservation = 8, kOfPair = 4, kKept = 2;
  FastPrices prices;
  prices.build = kOfObservation * sizes.observations;
  if (is_explicit) {
    prices.build += kOfPair * sizes.pairs;
    prices.product = sizes.slots;
  } else {
    prices.product = (sizes.is_resident ? kKept : kOfObservation) * sizes.observations;
  }
  return prices;
}

bool isWorthForming(const FastSizes& sizes) {
  constexpr double kProducts = 30;  // in a step
  constexpr double kMostBytes = 4294967296.0;
  if (sizes.slots * sizes.block_bytes > kMostBytes) return false;
  const FastPrices formed = pricesOf(sizes, true), other = pricesOf(sizes, false);
  return formed.build + kProducts * formed.product <= other.build + kProducts * other.product;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
