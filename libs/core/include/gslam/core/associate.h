#ifndef GSLAM_CORE_ASSOCIATE_H
#define GSLAM_CORE_ASSOCIATE_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/core/detail/stamp_pairing.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Which measurements of two sensors belong together.

namespace gslam {
inline namespace v1 {

/// Pairs stamps of two lists, each with at most one of the other.
///
/// Of all ways to pair stamps that are no further apart than the tolerance, one with the most pairs
/// is taken, and among these one with the least sum of distances. (TUM's associate.py takes the
/// nearest pair first, and then may leave stamps alone that had a partner.) Pairs do not cross.
///
/// Time and memory: linear in the number of stamps, times the number of stamps within the
/// tolerance of one.
///
/// @param a, b       nanoseconds, ascending, none twice
/// @param tolerance  most nanoseconds between the two of a pair, 0 or more
/// @return ascending
/// @throws ArgumentError when a list is not ascending, the tolerance negative, or more than 2^28
///   pairs are within it
inline std::vector<StampPair> associate(Span<const std::int64_t> a, Span<const std::int64_t> b,
                                        std::int64_t tolerance) {
  detail::checkAscending("a", a);
  detail::checkAscending("b", b);
  if (tolerance < 0) {
    throw ArgumentError("tolerance", "is " + std::to_string(tolerance) + ", expected 0 or more");
  }
  return detail::StampPairing(a, b, static_cast<std::uint64_t>(tolerance)).pairs();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_ASSOCIATE_H
