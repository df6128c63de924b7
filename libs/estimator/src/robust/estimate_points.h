// What the estimate functions on plain points share.
#ifndef GSLAM_ESTIMATOR_ROBUST_ESTIMATE_POINTS_H
#define GSLAM_ESTIMATOR_ROBUST_ESTIMATE_POINTS_H

#include <cstddef>
#include <string>

#include "robust/covariance_map.h"
#include "robust/input_check.h"
#include "robust/point_set.h"
#include "robust/robust_loop.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Degenerate, where even all points together do not determine a model.
inline bool refuseShape(const char* name, Degeneracy shape, EstimateSummary& summary) {
  summary.status = EstimateStatus::Degenerate;
  summary.degeneracy = shape;
  summary.message = std::string("all of ") + name + " are " + nameOf(shape) +
                    ", which determines no model, whatever the inliers";
  return false;
}

// All checks of two sets of points and of the options.
template <class Point>
bool checkPairs(Span<const Point> first, Span<const Point> second, std::size_t least,
                double default_threshold, const EstimateOptions& options,
                EstimateSummary& summary) {
  return checkMatches("first", first.size(), "second", second.size(), least, summary) &&
         checkFinite("first", first, summary) && checkFinite("second", second, summary) &&
         checkOptions(options, first.size(), default_threshold, summary);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_ESTIMATE_POINTS_H
