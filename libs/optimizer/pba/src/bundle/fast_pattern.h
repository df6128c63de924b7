#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_PATTERN_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_PATTERN_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bundle/fast_kernels.h"
#include "bundle/fast_structure.h"

// Which blocks of the reduced matrix are not zero, and what it costs to form them.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// The blocks right of the diagonal. They stay the same in all iterations.
struct FastPattern {
  std::vector<std::size_t> row_begin;  // one more as the end
  std::vector<std::uint32_t> columns;  // ascending in each row
};
FastPattern makeFastPattern(const FastStructure& structure, unsigned threads);

struct FastSizes {
  double observations = 0;
  double pairs = 0;  // of observations of the same point
  double slots = 0;  // blocks on and right of the diagonal
  double block_bytes = 0;
  bool is_resident = true;  // whether observations are kept where the matrix is not formed
};
template <class T>
FastSizes sizesOf(const FastStructure& structure, const FastPattern& pattern);

// Whether a matrix of numbers of type T that is not formed keeps so many observations.
template <class T>
bool isResident(std::size_t observations) {
  return observations * sizeof(FastRecord<T>) <= std::size_t(256) << 20;
}

// What is done once in an iteration, and a product of the matrix and a vector.
struct FastPrices {
  double build = 0, product = 0;
};
FastPrices pricesOf(const FastSizes& sizes, bool is_explicit);
// Whether a matrix that is formed takes less time, and no more than 4 GiB.
bool isWorthForming(const FastSizes& sizes);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_PATTERN_H
