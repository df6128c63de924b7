// The order in which the robust loop goes through the matches.
#ifndef GSLAM_ESTIMATOR_ROBUST_RANDOM_ORDER_H
#define GSLAM_ESTIMATOR_ROBUST_RANDOM_ORDER_H

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "robust/random_bits.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Where the problem's match i stands in the caller's arrays: first[order[i]], second[order[i]].
using RandomOrder = std::vector<std::uint32_t>;

// The order of a seed; the same on every machine.
inline RandomOrder randomOrder(std::size_t size, std::uint64_t seed) {
  RandomOrder order(size);
  for (std::size_t i = 0; i < size; ++i) order[i] = static_cast<std::uint32_t>(i);
  RandomBits bits(seed, ~std::uint64_t(0));  // a stream that no sample has
  for (std::size_t i = size; i > 1; --i) {
    std::swap(order[i - 1], order[bits.below(static_cast<std::uint32_t>(i))]);
  }
  return order;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_RANDOM_ORDER_H
