#include "robust/input_check.h"

#include <cmath>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

template <std::size_t N>
bool checkAllFinite(const char* name, Span<const Vec<double, N>> points, EstimateSummary& summary) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < N; ++k) {
      if (std::isfinite(points[i][k])) continue;
      return refuseInput(std::string(name) + "[" + std::to_string(i) + "] is not finite", summary);
    }
  }
  return true;
}

const char* problemOf(const EstimateOptions& options) {
  if (!(options.threshold >= 0) || !std::isfinite(options.threshold)) {
    return "threshold is not a number from 0 on";
  }
  if (!(options.confidence > 0 && options.confidence < 1)) {
    return "confidence is not between 0 and 1";
  }
  if (options.max_iterations == 0) return "max_iterations is 0, expected 1 or more";
  if (!(options.max_seconds >= 0)) return "max_seconds is not a number from 0 on";
  if (!(options.max_false_alarms > 0)) return "max_false_alarms is not above 0";
  switch (options.sampling) {
    case EstimateSampling::Uniform:
    case EstimateSampling::Prosac:
      break;
    default:
      return "sampling is none of enum EstimateSampling";
  }
  switch (options.scoring) {
    case EstimateScoring::Msac:
    case EstimateScoring::Ransac:
    case EstimateScoring::Lmeds:
    case EstimateScoring::Magsac:
      return nullptr;
  }
  return "scoring is none of enum EstimateScoring";
}

bool checkQuality(Span<const float> quality, std::size_t matches, EstimateSummary& summary) {
  if (quality.empty()) return true;
  if (quality.size() != matches) {
    return refuseInput("quality has " + std::to_string(quality.size()) + " elements, expected " +
                           std::to_string(matches) + ", as many as matches, or none",
                       summary);
  }
  for (std::size_t i = 0; i < matches; ++i) {
    if (!std::isfinite(quality[i])) {
      return refuseInput("quality[" + std::to_string(i) + "] is not finite", summary);
    }
  }
  return true;
}

}  // namespace

bool refuseInput(const std::string& message, EstimateSummary& summary) {
  summary.status = EstimateStatus::InvalidInput;
  summary.message = message;
  return false;
}

bool checkMatches(const char* name_a, std::size_t a, const char* name_b, std::size_t b,
                  std::size_t least, EstimateSummary& summary) {
  if (a != b) {
    return refuseInput(std::string(name_b) + " has " + std::to_string(b) + " elements, expected " +
                           std::to_string(a) + ", as many as " + name_a,
                       summary);
  }
  if (a > 0xffffffffu) return refuseInput("more matches than 32 bits count", summary);
  summary.inliers.assign(a, 0);
  if (a >= least) return true;
  summary.status = EstimateStatus::TooFewPoints;
  summary.message = std::to_string(a) + " given, expected " + std::to_string(least) + " or more";
  return false;
}

bool checkFinite(const char* name, Span<const Vec2d> points, EstimateSummary& summary) {
  return checkAllFinite<2>(name, points, summary);
}

bool checkFinite(const char* name, Span<const Vec3d> points, EstimateSummary& summary) {
  return checkAllFinite<3>(name, points, summary);
}

bool checkOptions(const EstimateOptions& options, std::size_t matches, double default_threshold,
                  EstimateSummary& summary) {
  if (const char* problem = problemOf(options)) return refuseInput(problem, summary);
  if (!checkQuality(options.quality, matches, summary)) return false;
  summary.threshold = options.threshold > 0 ? options.threshold : default_threshold;
  if (summary.threshold > 0 || options.scoring == EstimateScoring::Lmeds) return true;
  return refuseInput(
      "threshold is 0, but the unit of the points is not known: give the largest residual of an "
      "inlier, or use EstimateScoring::Lmeds",
      summary);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
