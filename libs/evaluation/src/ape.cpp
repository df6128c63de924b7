#include <gslam/base/error.h>
#include <gslam/evaluation/align.h>
#include <gslam/evaluation/ape.h>

#include <cmath>

#include "motion.h"

namespace gslam {
inline namespace v1 {
namespace evaluation {

std::vector<double> lengthsOf(const PosePairs& pairs) {
  std::vector<double> lengths;
  lengths.reserve(pairs.size());
  double length = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i > 0) {
      length += (pairs.reference[i].translation() - pairs.reference[i - 1].translation()).norm();
    }
    lengths.push_back(length);
  }
  return lengths;
}

}  // namespace evaluation

PoseErrors absoluteErrors(const PosePairs& pairs, const SIM3d& S_world_map) {
  PoseErrors errors;
  errors.translation.reserve(pairs.size());
  errors.rotation.reserve(pairs.size());
  errors.full.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const SE3d pose = aligned(S_world_map, pairs.estimate[i]);
    evaluation::addError(pairs.reference[i].inverse() * pose, errors);
    // From the positions themselves: far from the origin no digit is lost by turning them.
    errors.translation.back() = (pairs.reference[i].translation() - pose.translation()).norm();
  }
  return errors;
}

PoseErrorStatistics statisticsOf(const PoseErrors& errors) {
  std::vector<double> degrees = errors.rotation;
  for (double& angle : degrees) angle *= evaluation::kDegrees;
  return {statisticsOf(errors.translation), statisticsOf(std::move(degrees)),
          statisticsOf(errors.full)};
}

Drift driftOf(const PosePairs& pairs, double scale) {
  if (pairs.size() == 0) throw ArgumentError("pairs", "are none, expected one at least");
  Drift drift;
  drift.length = evaluation::lengthsOf(pairs).back();
  if (!(drift.length > 0)) return drift;
  const SE3d error = evaluation::motionError(pairs, 0, pairs.size() - 1, scale);
  drift.translation_percent = 100 * error.translation().norm() / drift.length;
  drift.rotation_deg_per_m = evaluation::kDegrees * error.rotation().angle() / drift.length;
  return drift;
}

}  // namespace v1
}  // namespace gslam
