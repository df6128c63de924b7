#include <gslam/base/error.h>
#include <gslam/evaluation/evaluate.h>

#include <optional>

#include "evo_matrices.h"

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

// Where evo is to be reproduced from KITTI's files.
std::optional<evaluation::EvoMatrices> evoMatrices(const Evaluation& result, std::size_t reference,
                                                   std::size_t estimate) {
  const EvaluationOptions& options = result.options;
  if (options.reference_matrices.empty() && options.estimate_matrices.empty()) return {};
  if (options.reference_matrices.size() != reference ||
      options.estimate_matrices.size() != estimate) {
    throw ArgumentError("matrices", "are " + std::to_string(options.reference_matrices.size()) +
                                        " and " + std::to_string(options.estimate_matrices.size()) +
                                        ", expected one for each pose");
  }
  if (options.association.method != AssociationMethod::evo) return {};
  return evaluation::EvoMatrices(result.pairs, options.reference_matrices,
                                 options.estimate_matrices, options.alignment.method,
                                 result.alignment.S_world_map);
}

void measureRelative(const std::optional<evaluation::EvoMatrices>& matrices, Evaluation& result) {
  const EvaluationOptions& options = result.options;
  const double scale = result.alignment.S_world_map.scale();
  for (const RpeOptions& rpe : options.rpe) {
    const std::vector<PairRange> ranges = rangesOf(result.pairs, rpe);
    PoseErrors errors = relativeErrors(result.pairs, ranges, scale);
    if (matrices) matrices->useInRelative(ranges, errors);
    result.rpe.push_back({rpe, statisticsOf(errors)});
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
  const auto matrices = evoMatrices(result, reference.size(), estimate.size());
  if (result.has_ape) {
    PoseErrors errors = absoluteErrors(result.pairs, result.alignment.S_world_map);
    if (matrices) matrices->useInAbsolute(errors);
    result.ape = statisticsOf(errors);
  }
  if (result.has_relative) measureRelative(matrices, result);
  result.score = scoreOfRun(reference, estimate, options, result.pairs);
  if (!options.covariances.empty() && result.has_ape) {
    result.nees = neesOfRun(result, estimate.size());
    result.has_nees = true;
  }
  return result;
}

}  // namespace v1
}  // namespace gslam
