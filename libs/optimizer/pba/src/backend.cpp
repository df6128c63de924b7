#include <gslam/optimizer_pba.h>

#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace {

OptimizerSummary solvePbaBundle(const BundleProblem& problem, const OptimizerOptions& options) {
  return detail::pba::isFastBundle(problem, options)
             ? detail::pba::solveFastBundle(problem, options)
             : detail::pba::solveGeneralBundle(problem, options);
}

OptimizerBackend makePbaBackend() {
  namespace pba = detail::pba;
  OptimizerBackend backend;
  backend.name = "pba";
  backend.pose = pba::solvePose;
  backend.alignment = [](const AlignmentProblem& problem, const SE3d& start,
                         const OptimizerOptions& options) {
    return pba::solveAlignment(problem, start, options);
  };
  backend.similarity_alignment = [](const AlignmentProblem& problem, const SIM3d& start,
                                    const OptimizerOptions& options) {
    return pba::solveAlignment(problem, start, options);
  };
  backend.two_view = pba::solveTwoView;
  backend.bundle = solvePbaBundle;
  backend.pose_graph_2d = pba::solvePoseGraph<SE2d>;
  backend.pose_graph_3d = pba::solvePoseGraph<SE3d>;
  backend.pose_graph_sim3 = pba::solvePoseGraph<SIM3d>;
  backend.bundle_covariance = pba::solveBundleCovariance;
  backend.covariance_2d = pba::solvePoseGraphCovariance<SE2d>;
  backend.covariance_3d = pba::solvePoseGraphCovariance<SE3d>;
  backend.covariance_sim3 = pba::solvePoseGraphCovariance<SIM3d>;
  return backend;
}

}  // namespace

const OptimizerBackend& pbaBackend() {
  static const OptimizerBackend backend = makePbaBackend();
  return backend;
}

}  // namespace v1
}  // namespace gslam
