// Pose graphs.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_GRAPH_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_GRAPH_H

#include "fixture.h"

namespace backend_contract {

template <class Group>
std::vector<gslam::PoseGraphResidual> residualsOf() {
  using gslam::PoseGraphResidual;
  std::vector<PoseGraphResidual> all = {PoseGraphResidual::Logarithm,
                                        PoseGraphResidual::Quaternion};
  if (Group::kFreedom != 7) all.push_back(PoseGraphResidual::Chordal);
  return all;
}

template <class Group>
void expectGraphsSolved(const gslam::OptimizerOptions& options) {
  for (const gslam::PoseGraphResidual residual : residualsOf<Group>()) {
    SCOPED_TRACE(static_cast<int>(residual));
    GraphScene<Group> scene = graphScene<Group>(40, 0.05);
    const Group fixed = scene.graph.T_world_body[0];
    const gslam::OptimizerSummary summary = solveChecked(scene.graph.problem(residual), options);
    EXPECT_TRUE(summary.is_usable) << fullReport(summary);
    EXPECT_LT(summary.final_cost, 1e-12) << fullReport(summary);
    EXPECT_LT(worstPose(scene.graph.T_world_body, scene.truth), 1e-6) << fullReport(summary);
    EXPECT_TRUE(areSameBits(scene.graph.T_world_body[0], fixed));
    EXPECT_EQ(summary.observations, scene.graph.from.size());
    EXPECT_EQ(summary.inliers, scene.graph.from.size());
    EXPECT_EQ(summary.parameters, 39 * Group::kFreedom);
    EXPECT_GT(summary.residuals, 0u);
  }
}

/// Loops that are wrong cost little under a robust loss, and the odometry is not robust.
template <class Group>
void expectLoopsRejected(const gslam::OptimizerOptions& options) {
  for (const gslam::RobustLoss& loss : allLosses()) {
    if (loss.kind == gslam::LossKind::Squared || loss.kind == gslam::LossKind::Huber) continue;
    SCOPED_TRACE(nameOf(loss.kind));
    GraphScene<Group> scene = graphScene<Group>(40, 0.001);
    typename Group::Tangent wrong{};
    wrong[0] = 30;
    std::size_t outliers = 0;
    for (std::size_t i = 0; i < scene.graph.from.size(); ++i) {
      if (scene.graph.is_robust[i] == 0 || i % 3 != 0) continue;
      scene.graph.T_from_to[i] = scene.graph.T_from_to[i] * Group::exp(wrong);
      ++outliers;
    }
    gslam::OptimizerOptions robust = options;
    robust.loss = loss;
    const gslam::OptimizerSummary summary = solveChecked(scene.graph.problem(), robust);
    // Cauchy's never lets go: what is wrong by 30 still pulls a little.
    const double bound = loss.kind == gslam::LossKind::Cauchy ? 3 : 0.3;
    EXPECT_LT(worstPose(scene.graph.T_world_body, scene.truth), bound) << fullReport(summary);
    EXPECT_EQ(summary.inliers, scene.graph.from.size() - outliers);
  }
}

/// Priors pull against edges: no small change of a pose lowers the cost.
template <class Group>
void expectPriorsWeighed(const gslam::OptimizerOptions& options) {
  for (const gslam::PoseGraphResidual residual : residualsOf<Group>()) {
    SCOPED_TRACE(static_cast<int>(residual));
    GraphScene<Group> scene = graphScene<Group>(15, 0.05);
    scene.graph.pose_fixed.clear();
    std::mt19937 generator(5);
    for (const std::uint32_t pose : {0u, 7u, 14u}) {
      scene.graph.prior_pose.push_back(pose);
      scene.graph.prior_T_world_body.push_back(scene.truth[pose] *
                                               Group::exp(smallTangent<Group>(generator, 0.1)));
      scene.graph.prior_information.push_back(5 * Group::Jacobian::identity());
    }
    solveChecked(scene.graph.problem(residual), options);
    const double best = poseGraphCost(scene.graph.problem(residual));
    EXPECT_GT(best, 1e-6);
    for (std::size_t pose = 0; pose < 15; ++pose) {
      for (std::size_t k = 0; k < 2 * Group::kFreedom; ++k) {
        typename Group::Tangent tangent{};
        tangent[k / 2] = k % 2 == 0 ? 1e-5 : -1e-5;
        const Group kept = scene.graph.T_world_body[pose];
        scene.graph.T_world_body[pose] = kept * Group::exp(tangent);
        EXPECT_GT(poseGraphCost(scene.graph.problem(residual)), best * (1 - 1e-9)) << pose;
        scene.graph.T_world_body[pose] = kept;
      }
    }
  }
}

template <class Group>
void expectGraphCovariance(const gslam::OptimizerOptions& options) {
  constexpr std::size_t n = Group::kFreedom, poses = 4;
  GraphScene<Group> scene = graphScene<Group>(poses, 0);
  const auto cost = [&](const std::vector<double>& x) {
    gslam::PoseGraph<Group> moved = scene.graph;
    for (std::size_t i = 1; i < poses; ++i) {
      typename Group::Tangent tangent;
      for (std::size_t k = 0; k < n; ++k) tangent[k] = x[(i - 1) * n + k];
      moved.T_world_body[i] = moved.T_world_body[i] * Group::exp(tangent);
    }
    return poseGraphCost(moved.problem());
  };
  const std::size_t size = (poses - 1) * n;
  const std::vector<double> expected = inverseOf(hessianOf(cost, size, 1e-3), size);
  const std::vector<std::uint32_t> chosen = {3, 0, 1};
  const auto found = poseGraphCovariance(scene.graph.problem(), chosen, options);
  ASSERT_TRUE(found.is_valid) << found.message;
  ASSERT_EQ(found.poses.size(), 3u);
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c < n; ++c) {
      EXPECT_NEAR(found.poses[0](r, c), expected[(2 * n + r) * size + 2 * n + c], 2e-3);
      EXPECT_EQ(found.poses[1](r, c), 0);
      EXPECT_NEAR(found.poses[2](r, c), expected[r * size + c], 2e-3);
    }
  }
}

/// Without an anchor the first pose is one; without edges nothing moves.
template <class Group>
void expectAnchored(const gslam::OptimizerOptions& options) {
  GraphScene<Group> scene = graphScene<Group>(12, 0.05);
  scene.graph.pose_fixed.clear();
  const Group first = scene.graph.T_world_body[0];
  const gslam::OptimizerSummary summary = solveChecked(scene.graph.problem(), options);
  EXPECT_TRUE(areSameBits(scene.graph.T_world_body[0], first));
  EXPECT_LT(worstPose(scene.graph.T_world_body, scene.truth), 1e-6) << fullReport(summary);

  GraphScene<Group> empty = graphScene<Group>(3, 0.05);
  empty.graph.from.clear(), empty.graph.to.clear(), empty.graph.T_from_to.clear();
  empty.graph.information.clear(), empty.graph.is_robust.clear();
  const std::vector<Group> before = empty.graph.T_world_body;
  solveChecked(empty.graph.problem(), options);
  EXPECT_TRUE(areSameBits(empty.graph.T_world_body, before));
}

}  // namespace backend_contract

#define CONTRACT_OF_GRAPHS(Group, function, covariance)               \
  TEST_P(BackendContract, solves_pose_graphs_of_##Group) {            \
    NEEDS_FUNCTION(function);                                         \
    backend_contract::expectGraphsSolved<gslam::Group>(options());    \
  }                                                                   \
  TEST_P(BackendContract, rejects_wrong_loops_of_##Group) {           \
    NEEDS_FUNCTION(function);                                         \
    backend_contract::expectLoopsRejected<gslam::Group>(options());   \
  }                                                                   \
  TEST_P(BackendContract, weighs_priors_of_##Group) {                 \
    NEEDS_FUNCTION(function);                                         \
    backend_contract::expectPriorsWeighed<gslam::Group>(options());   \
  }                                                                   \
  TEST_P(BackendContract, anchors_pose_graphs_of_##Group) {           \
    NEEDS_FUNCTION(function);                                         \
    backend_contract::expectAnchored<gslam::Group>(options());        \
  }                                                                   \
  TEST_P(BackendContract, knows_how_uncertain_poses_are_of_##Group) { \
    NEEDS_FUNCTION(covariance);                                       \
    backend_contract::expectGraphCovariance<gslam::Group>(options()); \
  }

CONTRACT_OF_GRAPHS(SE2d, pose_graph_2d, covariance_2d)
CONTRACT_OF_GRAPHS(SE3d, pose_graph_3d, covariance_3d)
CONTRACT_OF_GRAPHS(SIM3d, pose_graph_sim3, covariance_sim3)

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_GRAPH_H
