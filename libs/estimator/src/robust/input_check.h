// What the robust functions ask of their input before anything else.
#ifndef GSLAM_ESTIMATOR_ROBUST_INPUT_CHECK_H
#define GSLAM_ESTIMATOR_ROBUST_INPUT_CHECK_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// Each returns whether all is well; otherwise it sets status and message. So they are chained:
//   if (!checkMatches(...) || !checkFinite(...) || !checkOptions(...)) return result;

// Sizes that agree, and enough. Sets inliers to as many zeros as there are matches.
bool checkMatches(const char* name_a, std::size_t a, const char* name_b, std::size_t b,
                  std::size_t least, EstimateSummary& summary);

// No NaN, no infinity: "second[17] is not finite".
bool checkFinite(const char* name, Span<const Vec2d> points, EstimateSummary& summary);
bool checkFinite(const char* name, Span<const Vec3d> points, EstimateSummary& summary);

// Ranges of the options. Sets summary.threshold: that of the options, or default_threshold where
// they have none; 0 stands for a function without a default.
bool checkOptions(const EstimateOptions& options, std::size_t matches, double default_threshold,
                  EstimateSummary& summary);

// For what only one function checks.
bool refuseInput(const std::string& message, EstimateSummary& summary);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_INPUT_CHECK_H
