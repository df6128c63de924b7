#include <gslam/base/error.h>
#include <gslam/evaluation/evaluate.h>

namespace gslam {
inline namespace v1 {
namespace {

bool hasScale(AlignmentMethod method) {
  return method == AlignmentMethod::sim3 || method == AlignmentMethod::scale;
}

Coverage coverageOfRun(const Trajectory& reference, const Trajectory& estimate,
                       const EvaluationOptions& options, const PosePairs& pairs) {
  if (!options.frames.empty()) return coverageOf(options.frames, pairs.is_numbered);
  CoverageOptions how;
  how.time_offset = pairs.time_offset;
  how.lost_after = options.lost_after;
  how.is_numbered = pairs.is_numbered;
  return coverageOf(reference, estimate, how);
}

Score scoreOfRun(const Trajectory& reference, const Trajectory& estimate,
                 const EvaluationOptions& options, const PosePairs& pairs) {
  ScoreOptions how;
  how.has_scale = hasScale(options.alignment.method);
  how.time_offset = pairs.time_offset;
  how.is_numbered = pairs.is_numbered;
  return scoreOf(reference, estimate, how);
}

Nees neesOfRun(const Evaluation& evaluation, std::size_t poses) {
  const EvaluationOptions& options = evaluation.options;
  if (options.covariances.size() != poses) {
    throw ArgumentError("covariances", "are " + std::to_string(options.covariances.size()) +
                                           ", expected one for each of " + std::to_string(poses) +
                                           " poses of the estimate");
  }
  if (options.association.method == AssociationMethod::interpolate) {
    throw ArgumentError("covariances", "are not for an association that interpolates");
  }
  std::vector<PoseCovariance> covariances;
  covariances.reserve(evaluation.pairs.size());
  for (const std::size_t place : evaluation.pairs.estimate_places) {
    covariances.push_back(options.covariances[place]);
  }
  return neesOf(evaluation.pairs, covariances, evaluation.alignment.S_world_map);
}

void measureRelative(Evaluation& result) {
  const EvaluationOptions& options = result.options;
  const double scale = result.alignment.S_world_map.scale();
  for (const RpeOptions& rpe : options.rpe) {
    const std::vector<PairRange> ranges = rangesOf(result.pairs, rpe);
    result.rpe.push_back({rpe, statisticsOf(relativeErrors(result.pairs, ranges, scale))});
  }
  if (options.has_kitti) result.kitti = kittiErrors(result.pairs, {}, scale);
  result.segments = segmentErrors(result.pairs, options.segments, result.alignment.S_world_map);
  result.drift = driftOf(result.pairs, scale);
}

}  // namespace

Evaluation evaluate(const Trajectory& reference, const Trajectory& estimate,
                    const EvaluationOptions& options) {
  Evaluation result;
  result.options = options;
  result.pairs = pairPoses(reference, estimate, options.association);
  result.coverage = coverageOfRun(reference, estimate, options, result.pairs);
  result.alignment = align(result.pairs, options.alignment);
  result.has_ape = result.alignment.is_valid;
  // A rigid alignment does not change relative motions.
  result.has_relative = result.alignment.is_valid || !hasScale(options.alignment.method);
  if (result.has_ape) {
    result.ape = statisticsOf(absoluteErrors(result.pairs, result.alignment.S_world_map));
  }
  if (result.has_relative) measureRelative(result);
  result.score = scoreOfRun(reference, estimate, options, result.pairs);
  if (!options.covariances.empty() && result.has_ape) {
    result.nees = neesOfRun(result, estimate.size());
    result.has_nees = true;
  }
  return result;
}

}  // namespace v1
}  // namespace gslam
