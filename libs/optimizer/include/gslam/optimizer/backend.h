#ifndef GSLAM_OPTIMIZER_BACKEND_H
#define GSLAM_OPTIMIZER_BACKEND_H

#include <gslam/optimizer/alignment_problem.h>
#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer/covariance.h>
#include <gslam/optimizer/pose_graph_problem.h>
#include <gslam/optimizer/pose_problem.h>
#include <gslam/optimizer/two_view_problem.h>

#include <functional>
#include <string>
#include <vector>

/// @file
/// Back ends: what solves the problems.

namespace gslam {
inline namespace v1 {

/// A back end: a name, and a function for each problem that it can solve. Those it cannot are
/// empty. Problems were checked before a function is called, and options are in their ranges.
///
/// A function that cannot solve this one problem throws ArgumentError before it starts, with what
/// it cannot do.
struct OptimizerBackend {
  std::string name;  ///< such as "pba"
  /// @{
  /// As the public function of the same name.
  std::function<OptimizedPose(const PoseProblem&, const SE3d&, const OptimizerOptions&)> pose;
  std::function<OptimizedAlignment<SE3d>(const AlignmentProblem&, const SE3d&,
                                         const OptimizerOptions&)>
      alignment;
  std::function<OptimizedAlignment<SIM3d>(const AlignmentProblem&, const SIM3d&,
                                          const OptimizerOptions&)>
      similarity_alignment;
  std::function<OptimizedTwoView(const TwoViewProblem&, const SE3d&, const OptimizerOptions&)>
      two_view;
  std::function<OptimizerSummary(const BundleProblem&, const OptimizerOptions&)> bundle;
  std::function<OptimizerSummary(const PoseGraphProblem<SE2d>&, const OptimizerOptions&)>
      pose_graph_2d;
  std::function<OptimizerSummary(const PoseGraphProblem<SE3d>&, const OptimizerOptions&)>
      pose_graph_3d;
  std::function<OptimizerSummary(const PoseGraphProblem<SIM3d>&, const OptimizerOptions&)>
      pose_graph_sim3;
  std::function<BundleCovariance(const BundleProblem&, Span<const std::uint32_t>,
                                 Span<const std::uint32_t>, Span<const std::uint32_t>,
                                 const OptimizerOptions&)>
      bundle_covariance;
  std::function<PoseGraphCovariance<SE2d>(const PoseGraphProblem<SE2d>&, Span<const std::uint32_t>,
                                          const OptimizerOptions&)>
      covariance_2d;
  std::function<PoseGraphCovariance<SE3d>(const PoseGraphProblem<SE3d>&, Span<const std::uint32_t>,
                                          const OptimizerOptions&)>
      covariance_3d;
  std::function<PoseGraphCovariance<SIM3d>(const PoseGraphProblem<SIM3d>&,
                                           Span<const std::uint32_t>, const OptimizerOptions&)>
      covariance_sim3;
  /// @}
};

/// Makes a back end known; one of the same name is replaced. Those of this project register
/// themselves where `gslam/optimizer_pba.h` or `gslam/optimizer_ceres.h` is included and linked.
/// Any thread may do it at any time.
/// @param backend  to be copied
/// @return true, so that a variable can be initialised with it
/// @throws ArgumentError when it has no name
GSLAM_OPTIMIZER_EXPORT bool registerOptimizerBackend(const OptimizerBackend& backend);

/// Names of the back ends that are known, in the order in which they are asked.
GSLAM_OPTIMIZER_EXPORT std::vector<std::string> optimizerBackends();

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_BACKEND_H
