#include <gslam/optimizer_ceres.h>

#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace {

OptimizerBackend makeCeresBackend() {
  OptimizerBackend backend;
  backend.name = "ceres";
  backend.pose = detail::by_ceres::solvePose;
  backend.alignment = detail::by_ceres::solveAlignment<SE3d>;
  backend.similarity_alignment = detail::by_ceres::solveAlignment<SIM3d>;
  backend.two_view = detail::by_ceres::solveTwoView;
  backend.bundle = detail::by_ceres::solveBundle;
  backend.pose_graph_2d = detail::by_ceres::solvePoseGraph<SE2d>;
  backend.pose_graph_3d = detail::by_ceres::solvePoseGraph<SE3d>;
  backend.pose_graph_sim3 = detail::by_ceres::solvePoseGraph<SIM3d>;
  backend.bundle_covariance = detail::by_ceres::solveBundleCovariance;
  backend.covariance_2d = detail::by_ceres::solvePoseGraphCovariance<SE2d>;
  backend.covariance_3d = detail::by_ceres::solvePoseGraphCovariance<SE3d>;
  backend.covariance_sim3 = detail::by_ceres::solvePoseGraphCovariance<SIM3d>;
  return backend;
}

}  // namespace

const OptimizerBackend& ceresBackend() {
  static const OptimizerBackend backend = makeCeresBackend();
  return backend;
}

}  // namespace v1
}  // namespace gslam
