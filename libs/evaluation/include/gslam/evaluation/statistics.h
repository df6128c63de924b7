#ifndef GSLAM_EVALUATION_STATISTICS_H
#define GSLAM_EVALUATION_STATISTICS_H

#include <gslam/evaluation/export.h>

#include <cstddef>
#include <vector>

/// @file
/// What is said of many errors at once.

namespace gslam {
inline namespace v1 {

/// Numbers about a list of errors, in the unit of these; sse in its square.
///
/// Thread-safety: plain data.
struct Statistics {
  std::size_t count = 0;  ///< of 0 all others are 0 and mean nothing
  double rmse = 0;        ///< root of the mean of the squares
  double mean = 0;        ///< arithmetic
  double median = 0;      ///< the 50th percentile
  double std = 0;         ///< about the mean, of the whole population: divided by count
  double min = 0;         ///< least
  double max = 0;         ///< most
  double sse = 0;         ///< sum of the squares
  double p90 = 0;         ///< percentiles: see percentile()
  double p95 = 0;         ///< 95th percentile
  double p99 = 0;         ///< 99th percentile
};

/// The statistics of values. O(n).
/// @param values  in any order; finite
/// @throws ArgumentError when one is not finite
GSLAM_EVALUATION_EXPORT Statistics statisticsOf(std::vector<double> values);

/// What a part of the values is below: on a straight line between the two nearest in order, so that
/// 0 gives the least, 1 the most, and 0.5 the median (Hyndman and Fan's type 7, as numpy and R).
/// O(n).
/// @param values  in any order, one at least
/// @param part    0 to 1
/// @throws ArgumentError when there are no values, or the part is not from 0 to 1
GSLAM_EVALUATION_EXPORT double percentile(std::vector<double> values, double part);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_STATISTICS_H
