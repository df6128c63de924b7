// Pose graphs by hand with Ceres; residuals and analytic derivatives are ours.
#include <ceres/ceres.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ceres_manifold.h"
#include "factors/pose_edge.h"
#include "measure.h"

namespace {

using gslam::SE3d;

class Edge : public ceres::CostFunction {
 public:
  Edge(gslam::PoseGraphResidual kind, const SE3d& T_from_to, const SE3d::Jacobian& information)
      : kind_(kind),
        T_from_to_(T_from_to),
        weight_(gslam::detail::edgeWeight<SE3d>(kind, information)) {
    set_num_residuals(kind == gslam::PoseGraphResidual::Chordal ? 12 : 6);
    *mutable_parameter_block_sizes() = {7, 7};
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    gslam::detail::EdgeValue<SE3d> value;
    gslam::detail::edgeValue(kind_, poseOf<SE3d>(parameters[0]), poseOf<SE3d>(parameters[1]),
                             T_from_to_, weight_, jacobians != nullptr, value);
    std::copy(value.residual, value.residual + num_residuals(), residuals);
    if (jacobians == nullptr) return true;
    spread(value.by_from, jacobians[0]);
    spread(value.by_to, jacobians[1]);
    return true;
  }

 private:
  // Rows of 6 into rows of 7.
  void spread(const double* by_tangent, double* jacobian) const {
    if (jacobian == nullptr) return;
    for (int r = 0; r < num_residuals(); ++r) {
      std::copy(by_tangent + 6 * r, by_tangent + 6 * r + 6, jacobian + 7 * r);
      jacobian[7 * r + 6] = 0;
    }
  }

  gslam::PoseGraphResidual kind_;
  SE3d T_from_to_;
  gslam::detail::EdgeWeight<SE3d> weight_;
};

void solveGraph(gslam::PoseGraph<SE3d>& graph, gslam::PoseGraphResidual residual) {
  std::vector<double> numbers(7 * graph.T_world_body.size());
  for (std::size_t i = 0; i < graph.T_world_body.size(); ++i) {
    setNumbers(graph.T_world_body[i], &numbers[7 * i]);
  }
  ceres::Problem problem;
  auto* const manifold = new TangentManifold<SE3d>();
  for (std::size_t i = 0; i < graph.T_world_body.size(); ++i) {
    problem.AddParameterBlock(&numbers[7 * i], 7, manifold);
    if (graph.pose_fixed[i] != 0) problem.SetParameterBlockConstant(&numbers[7 * i]);
  }
  for (std::size_t i = 0; i < graph.from.size(); ++i) {
    problem.AddResidualBlock(new Edge(residual, graph.T_from_to[i], graph.information[i]), nullptr,
                             &numbers[7 * graph.from[i]], &numbers[7 * graph.to[i]]);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.num_threads = static_cast<int>(kThreads);
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (std::size_t i = 0; i < graph.T_world_body.size(); ++i) {
    graph.T_world_body[i] = poseOf<SE3d>(&numbers[7 * i]);
  }
}

const bool kRows = addGraphRows("ceres", solveGraph);

}  // namespace
