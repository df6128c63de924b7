#ifndef GSLAM_ESTIMATOR_ESTIMATE_H
#define GSLAM_ESTIMATOR_ESTIMATE_H

#include <gslam/estimator/export.h>
#include <gslam/geometry/mat.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// @file
/// What the robust functions, `gslam::estimate...`, found.

namespace gslam {
inline namespace v1 {

/// Whether a model was found that can be relied on, and if not, why.
enum class EstimateStatus {
  Ok,            ///< the consensus is better than chance, and determines the model
  TooFewPoints,  ///< fewer matches than one sample needs
  InvalidInput,  ///< sizes that differ, a number that is not finite, an option out of range
  Degenerate,    ///< the inliers do not determine the model: see Estimate::degeneracy
  NoConsensus,   ///< no model has more inliers than chance explains
};

/// What is special about the inliers.
enum class Degeneracy {
  None,          ///< nothing
  Planar,        ///< all on one plane of the scene
  PureRotation,  ///< the camera turned without moving: no parallax
  Collinear,     ///< all on one line
  Coincident,    ///< all at one point
};

/// What is the same for every model: how the search ended.
struct EstimateSummary {
  EstimateStatus status = EstimateStatus::NoConsensus;  ///< whether the model can be relied on
  std::string message;  ///< a sentence for people: what happened, and what to do where it failed
  std::vector<std::uint8_t> inliers;  ///< a 1 for each match within the threshold of the returned
                                      ///< model, else a 0; as many as matches
  std::size_t inlier_count = 0;       ///< number of ones
  double inlier_ratio = 0;            ///< inlier_count as a part of all matches
  double threshold = 0;               ///< that was used, in the unit of the residuals
  double score = 0;               ///< of the returned model, smaller is better: see EstimateScoring
  double rms = 0;                 ///< root mean square of the inliers' residuals
  double log10_false_alarms = 0;  ///< of the returned model: see EstimateOptions
  std::size_t iterations = 0;     ///< samples drawn
  Degeneracy degeneracy = Degeneracy::None;  ///< what is special about the inliers

  /// Whether the model can be relied on.
  bool ok() const noexcept { return status == EstimateStatus::Ok; }
};

/// A model that was searched for among outliers.
/// @tparam Model  what was searched for, e.g. SE3d
/// @tparam Dof    its degrees of freedom, or those of its tangent
///
/// Thread-safety: plain data.
template <class Model, std::size_t Dof>
struct Estimate : EstimateSummary {
  Model model{};  ///< the best found; the identity or zeros where nothing was found
  /// Of the model, from its inliers' residuals: their variance times (J^T J)^-1. That the threshold
  /// cuts off tails is not made up for: it should be three standard deviations or more. Each
  /// function says in which coordinates. Equal matches count once. Zeros where status is not Ok.
  Mat<double, Dof, Dof> covariance{};
  /// A second model that explains the matches as well, e.g. of a plane seen twice.
  std::optional<Model> alternative;
};

/// Name of a status, such as "NoConsensus".
GSLAM_ESTIMATOR_EXPORT const char* nameOf(EstimateStatus status) noexcept;
/// Name of a degeneracy, such as "Planar".
GSLAM_ESTIMATOR_EXPORT const char* nameOf(Degeneracy degeneracy) noexcept;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ESTIMATE_H
