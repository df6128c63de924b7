#include <gslam/base/error.h>
#include <gslam/optimizer/alignment_problem.h>
#include <gslam/optimizer/backend.h>
#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer/check.h>
#include <gslam/optimizer/covariance.h>
#include <gslam/optimizer/pose_graph_problem.h>
#include <gslam/optimizer/pose_problem.h>
#include <gslam/optimizer/two_view_problem.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "anchorage.h"
#include "check_input.h"
#include "findings.h"
#include "registry.h"

// Every call: check, choose a back end, let it work.

namespace gslam {
inline namespace v1 {
namespace {

using WallClock = std::chrono::steady_clock;

double secondsFrom(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

// What only the facade knows: who worked, how long all of it took, and what is suspect.
void completeSummary(const OptimizerBackend& backend, WallClock::time_point start,
                     double check_seconds, const std::vector<ProblemFinding>& findings,
                     OptimizerSummary& summary) {
  summary.backend = backend.name;
  std::vector<std::string> warnings;
  for (const ProblemFinding& finding : findings) {
    warnings.push_back(finding.field + " " + finding.problem);
  }
  summary.warnings.insert(summary.warnings.begin(), warnings.begin(), warnings.end());
  summary.times.setup += check_seconds;
  summary.times.total = secondsFrom(start);
}

template <class Group, class Function>
OptimizedAlignment<Group> optimizeAlignmentWith(Function OptimizerBackend::*function,
                                                const char* name, const AlignmentProblem& problem,
                                                const Group& T_a_b,
                                                const OptimizerOptions& options) {
  const WallClock::time_point start = WallClock::now();
  detail::checkOptions(options);
  const OptimizerBackend& backend = detail::backendFor(options, function, name);
  detail::checkAlignmentProblem(problem);
  detail::checkStart("T_a_b", T_a_b.data(), sizeof(Group) / sizeof(double));
  const double check_seconds = secondsFrom(start);
  OptimizedAlignment<Group> result = (backend.*function)(problem, T_a_b, options);
  completeSummary(backend, start, check_seconds, {}, result.summary);
  return result;
}

template <class Group, class Function>
OptimizerSummary optimizeGraphWith(Function OptimizerBackend::*function, const char* name,
                                   const PoseGraphProblem<Group>& problem,
                                   const OptimizerOptions& options) {
  const WallClock::time_point start = WallClock::now();
  detail::checkOptions(options);
  const OptimizerBackend& backend = detail::backendFor(options, function, name);
  const std::vector<ProblemFinding> findings = checkPoseGraph(problem);
  detail::throwFirstError(findings);
  const double check_seconds = secondsFrom(start);
  OptimizerSummary summary = (backend.*function)(problem, options);
  completeSummary(backend, start, check_seconds, findings, summary);
  return summary;
}

void checkChosen(const char* name, Span<const std::uint32_t> chosen, std::size_t count) {
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i] >= count) {
      throw ArgumentError(
          detail::elementOf(name, i),
          "is " + std::to_string(chosen[i]) + ", expected below " + std::to_string(count));
    }
  }
}

template <class Group, class Function>
PoseGraphCovariance<Group> graphCovarianceWith(Function OptimizerBackend::*function,
                                               const char* name,
                                               const PoseGraphProblem<Group>& problem,
                                               Span<const std::uint32_t> poses,
                                               const OptimizerOptions& options) {
  detail::checkOptions(options);
  const OptimizerBackend& backend = detail::backendFor(options, function, name);
  detail::throwFirstError(checkPoseGraph(problem));
  checkChosen("poses", poses, problem.T_world_body.size());
  detail::Anchorage anchorage(problem);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (anchorage.isHeld(poses[i])) continue;
    PoseGraphCovariance<Group> loose;
    loose.message = detail::elementOf("poses", i) + " is not connected to an anchor by edges";
    return loose;
  }
  return (backend.*function)(problem, poses, options);
}

}  // namespace

// Called for every frame: no clock, no memory, a lookup that is a load.
OptimizedPose optimizePose(const PoseProblem& problem, const SE3d& T_world_body,
                           const OptimizerOptions& options) {
  detail::checkOptions(options);
  const OptimizerBackend& backend =
      detail::backendFor(options, &OptimizerBackend::pose, "poses from points");
  detail::checkPoseProblem(problem, T_world_body);
  return backend.pose(problem, T_world_body, options);
}

OptimizedAlignment<SE3d> optimizeAlignment(const AlignmentProblem& problem, const SE3d& T_a_b,
                                           const OptimizerOptions& options) {
  return optimizeAlignmentWith(&OptimizerBackend::alignment, "alignments", problem, T_a_b, options);
}

OptimizedAlignment<SIM3d> optimizeAlignment(const AlignmentProblem& problem, const SIM3d& T_a_b,
                                            const OptimizerOptions& options) {
  return optimizeAlignmentWith(&OptimizerBackend::similarity_alignment, "alignments with a scale",
                               problem, T_a_b, options);
}

OptimizedTwoView optimizeTwoView(const TwoViewProblem& problem, const SE3d& T_first_second,
                                 const OptimizerOptions& options) {
  const WallClock::time_point start = WallClock::now();
  detail::checkOptions(options);
  const OptimizerBackend& backend =
      detail::backendFor(options, &OptimizerBackend::two_view, "two views");
  detail::checkTwoViewProblem(problem, T_first_second);
  const double check_seconds = secondsFrom(start);
  OptimizedTwoView result = backend.two_view(problem, T_first_second, options);
  completeSummary(backend, start, check_seconds, {}, result.summary);
  return result;
}

OptimizerSummary optimizeBundle(const BundleProblem& problem, const OptimizerOptions& options) {
  const WallClock::time_point start = WallClock::now();
  detail::checkOptions(options);
  const OptimizerBackend& backend =
      detail::backendFor(options, &OptimizerBackend::bundle, "bundles");
  const std::vector<ProblemFinding> findings = checkBundle(problem);
  detail::throwFirstError(findings);
  const double check_seconds = secondsFrom(start);
  OptimizerSummary summary = backend.bundle(problem, options);
  completeSummary(backend, start, check_seconds, findings, summary);
  return summary;
}

OptimizerSummary optimizePoseGraph(const PoseGraphProblem<SE2d>& problem,
                                   const OptimizerOptions& options) {
  return optimizeGraphWith(&OptimizerBackend::pose_graph_2d, "pose graphs of SE2", problem,
                           options);
}
OptimizerSummary optimizePoseGraph(const PoseGraphProblem<SE3d>& problem,
                                   const OptimizerOptions& options) {
  return optimizeGraphWith(&OptimizerBackend::pose_graph_3d, "pose graphs of SE3", problem,
                           options);
}
OptimizerSummary optimizePoseGraph(const PoseGraphProblem<SIM3d>& problem,
                                   const OptimizerOptions& options) {
  return optimizeGraphWith(&OptimizerBackend::pose_graph_sim3, "pose graphs of SIM3", problem,
                           options);
}

BundleCovariance bundleCovariance(const BundleProblem& problem, Span<const std::uint32_t> poses,
                                  Span<const std::uint32_t> points,
                                  Span<const std::uint32_t> cameras,
                                  const OptimizerOptions& options) {
  detail::checkOptions(options);
  const OptimizerBackend& backend =
      detail::backendFor(options, &OptimizerBackend::bundle_covariance, "covariances of bundles");
  detail::throwFirstError(checkBundle(problem));
  checkChosen("poses", poses, problem.T_world_body.size());
  checkChosen("points", points, problem.points.size());
  checkChosen("cameras", cameras, problem.cameras.size());
  return backend.bundle_covariance(problem, poses, points, cameras, options);
}

PoseGraphCovariance<SE2d> poseGraphCovariance(const PoseGraphProblem<SE2d>& problem,
                                              Span<const std::uint32_t> poses,
                                              const OptimizerOptions& options) {
  return graphCovarianceWith(&OptimizerBackend::covariance_2d, "covariances of pose graphs of SE2",
                             problem, poses, options);
}
PoseGraphCovariance<SE3d> poseGraphCovariance(const PoseGraphProblem<SE3d>& problem,
                                              Span<const std::uint32_t> poses,
                                              const OptimizerOptions& options) {
  return graphCovarianceWith(&OptimizerBackend::covariance_3d, "covariances of pose graphs of SE3",
                             problem, poses, options);
}
PoseGraphCovariance<SIM3d> poseGraphCovariance(const PoseGraphProblem<SIM3d>& problem,
                                               Span<const std::uint32_t> poses,
                                               const OptimizerOptions& options) {
  return graphCovarianceWith(&OptimizerBackend::covariance_sim3,
                             "covariances of pose graphs of SIM3", problem, poses, options);
}

}  // namespace v1
}  // namespace gslam
