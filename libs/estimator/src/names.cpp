#include <gslam/estimator/estimate.h>

namespace gslam {
inline namespace v1 {

const char* nameOf(EstimateStatus status) noexcept {
  switch (status) {
    case EstimateStatus::Ok:
      return "Ok";
    case EstimateStatus::TooFewPoints:
      return "TooFewPoints";
    case EstimateStatus::InvalidInput:
      return "InvalidInput";
    case EstimateStatus::Degenerate:
      return "Degenerate";
    case EstimateStatus::NoConsensus:
      return "NoConsensus";
  }
  return "unknown";
}

const char* nameOf(Degeneracy degeneracy) noexcept {
  switch (degeneracy) {
    case Degeneracy::None:
      return "None";
    case Degeneracy::Planar:
      return "Planar";
    case Degeneracy::PureRotation:
      return "PureRotation";
    case Degeneracy::Collinear:
      return "Collinear";
    case Degeneracy::Coincident:
      return "Coincident";
  }
  return "unknown";
}

}  // namespace v1
}  // namespace gslam
