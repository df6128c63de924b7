#include <gslam/optimizer/check.h>
#include <gslam/optimizer/pose_graph_problem.h>

#include <cstddef>

#include "check_input.h"
#include "factors/loss.h"
#include "factors/pose_edge.h"
#include "findings.h"

// The cost of a pose graph by the plain formulas.

namespace gslam {
inline namespace v1 {
namespace {

// Squared norm of the whitened residual.
template <class Group>
double edgeSquare(PoseGraphResidual kind, const Group& from, const Group& to,
                  const Group& T_from_to, const typename Group::Jacobian& information) {
  const detail::EdgeWeight<Group> weight = detail::edgeWeight<Group>(kind, information);
  detail::EdgeValue<Group> value;
  detail::edgeValue(kind, from, to, T_from_to, weight, false, value);
  double square = 0;
  for (std::size_t i = 0; i < value.rows; ++i) square += value.residual[i] * value.residual[i];
  return square;
}

template <class Group>
double graphCost(const PoseGraphProblem<Group>& problem, const RobustLoss& loss) {
  detail::checkLoss(loss, "loss");
  detail::throwFirstError(checkPoseGraph(problem));
  const Span<Group> poses = problem.T_world_body;
  double cost = 0;
  for (std::size_t i = 0; i < problem.from.size(); ++i) {
    const double s = edgeSquare(
        problem.residual, poses[problem.from[i]], poses[problem.to[i]], problem.T_from_to[i],
        problem.information.empty() ? Group::Jacobian::identity() : problem.information[i]);
    const bool is_robust = problem.is_robust.empty() || problem.is_robust[i] != 0;
    cost += 0.5 * (is_robust ? detail::lossAt(loss, s).rho : s);
  }
  for (std::size_t i = 0; i < problem.prior_pose.size(); ++i) {
    cost += 0.5 * edgeSquare(problem.residual, Group(), poses[problem.prior_pose[i]],
                             problem.prior_T_world_body[i], problem.prior_information[i]);
  }
  return cost;
}

}  // namespace

double poseGraphCost(const PoseGraphProblem<SE2d>& problem, const RobustLoss& loss) {
  return graphCost(problem, loss);
}
double poseGraphCost(const PoseGraphProblem<SE3d>& problem, const RobustLoss& loss) {
  return graphCost(problem, loss);
}
double poseGraphCost(const PoseGraphProblem<SIM3d>& problem, const RobustLoss& loss) {
  return graphCost(problem, loss);
}

}  // namespace v1
}  // namespace gslam
