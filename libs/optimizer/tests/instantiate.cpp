// Uses every header of GSLAM::optimizer; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/optimizer.h>
#include <gslam/optimizer/files.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

std::string instantiateProblems(gslam::Bundle& bundle, gslam::PoseGraph<gslam::SE3d>& graph);

std::string instantiateProblems(gslam::Bundle& bundle, gslam::PoseGraph<gslam::SE3d>& graph) {
  gslam::OptimizerOptions options;
  options.loss = {gslam::LossKind::Huber, 2};
  options.progress = [](const gslam::OptimizerIteration& one) { return one.cost > 0; };
  const gslam::OptimizerSummary summary = optimizeBundle(bundle.problem(), options);
  std::string text = briefReport(summary) + fullReport(summary) + nameOf(summary.status);
  initializePoses(graph.problem());
  text += briefReport(optimizePoseGraph(graph.problem(), options)) + nameOf(options.loss.kind);
  for (const gslam::ProblemFinding& finding : checkBundle(bundle.problem())) text += finding.field;
  for (const std::string& name : gslam::optimizerBackends()) text += name;
  return text + std::to_string(bundleCost(bundle.problem()) + poseGraphCost(graph.problem()));
}

std::size_t instantiateSmallProblems(const gslam::PoseProblem& pose,
                                     const gslam::AlignmentProblem& alignment,
                                     const gslam::TwoViewProblem& views,
                                     const gslam::BundleProblem& bundle,
                                     const std::vector<std::uint32_t>& chosen);

std::size_t instantiateSmallProblems(const gslam::PoseProblem& pose,
                                     const gslam::AlignmentProblem& alignment,
                                     const gslam::TwoViewProblem& views,
                                     const gslam::BundleProblem& bundle,
                                     const std::vector<std::uint32_t>& chosen) {
  return optimizePose(pose, gslam::SE3d()).inliers +
         optimizeAlignment(alignment, gslam::SE3d()).summary.inliers +
         optimizeAlignment(alignment, gslam::SIM3d()).summary.inliers +
         gslam::alignTrajectories<gslam::SIM3d>({}).summary.inliers +
         optimizeTwoView(views, gslam::SE3d()).summary.inliers +
         bundleCovariance(bundle, chosen, chosen, chosen).poses.size() +
         marginalize(bundle, chosen).poses.size() + poseGraphOf(bundle).from.size();
}
