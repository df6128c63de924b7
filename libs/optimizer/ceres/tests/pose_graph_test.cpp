#include <gslam/optimizer/files/g2o.h>
#include <gslam/optimizer_ceres.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <variant>

#include "../../../../tests/harness/test_data.h"
#include "scenes.h"

namespace {

using gslam::OptimizerOptions;
using gslam::OptimizerStatus;
using gslam::OptimizerSummary;
using gslam::PoseGraph;
using gslam::PoseGraphProblem;
using gslam::PoseGraphResidual;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;

template <class Group>
OptimizerSummary solveGraph(const PoseGraphProblem<Group>& problem,
                            const OptimizerOptions& options = {});
template <>
OptimizerSummary solveGraph(const PoseGraphProblem<SE2d>& problem,
                            const OptimizerOptions& options) {
  return gslam::ceresBackend().pose_graph_2d(problem, options);
}
template <>
OptimizerSummary solveGraph(const PoseGraphProblem<SE3d>& problem,
                            const OptimizerOptions& options) {
  return gslam::ceresBackend().pose_graph_3d(problem, options);
}
template <>
OptimizerSummary solveGraph(const PoseGraphProblem<SIM3d>& problem,
                            const OptimizerOptions& options) {
  return gslam::ceresBackend().pose_graph_sim3(problem, options);
}

template <class Group>
Group anyStep(std::mt19937_64& generator, double size) {
  typename Group::Tangent tangent;
  for (double& value : tangent.values) value = scenes::noise(generator, size);
  return Group::exp(tangent);
}

// A ring with chords, measured exactly.
template <class Group>
PoseGraph<Group> ring(std::size_t n) {
  std::mt19937_64 generator(11);
  PoseGraph<Group> graph;
  Group pose;
  for (std::size_t i = 0; i < n; ++i) {
    graph.T_world_body.push_back(pose);
    pose *= anyStep<Group>(generator, 0.5);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (const std::uint32_t step : {1U, 5U}) {
      const auto j = static_cast<std::uint32_t>((i + step) % n);
      graph.from.push_back(i);
      graph.to.push_back(j);
      graph.T_from_to.push_back(graph.T_world_body[i].inverse() * graph.T_world_body[j]);
      auto information = Group::Jacobian::identity();
      for (std::size_t k = 0; k < Group::kFreedom; ++k) information(k, k) = 1.0 + double(k);
      graph.information.push_back(information);
    }
  }
  return graph;
}

template <class Group>
class pose_graph : public testing::Test {};
using Groups = testing::Types<SE2d, SE3d, SIM3d>;
TYPED_TEST_SUITE(pose_graph, Groups, );

TYPED_TEST(pose_graph, finds_the_poses_with_each_residual) {
  using Group = TypeParam;
  for (const PoseGraphResidual residual :
       {PoseGraphResidual::Logarithm, PoseGraphResidual::Quaternion, PoseGraphResidual::Chordal}) {
    if (residual == PoseGraphResidual::Chordal && std::is_same<Group, SIM3d>::value) continue;
    const PoseGraph<Group> truth = ring<Group>(30);
    PoseGraph<Group> graph = truth;
    std::mt19937_64 generator(12);
    for (std::size_t i = 1; i < 30; ++i) graph.T_world_body[i] *= anyStep<Group>(generator, 0.2);
    OptimizerOptions options;
    options.function_tolerance = 1e-20;
    const OptimizerSummary summary = solveGraph(graph.problem(residual), options);
    EXPECT_TRUE(summary.is_usable);
    EXPECT_LT(summary.final_cost, 1e-15) << summary.message;
    for (std::size_t i = 0; i < 30; ++i) {
      EXPECT_TRUE(truth.T_world_body[i].isApprox(graph.T_world_body[i], 1e-7)) << i;
    }
    EXPECT_EQ(0, std::memcmp(&truth.T_world_body[0], &graph.T_world_body[0], sizeof(Group)));
    EXPECT_EQ(29 * Group::kFreedom, summary.parameters);
    EXPECT_EQ(60u, summary.observations);
  }
}

TYPED_TEST(pose_graph, false_loops_lose_their_weight) {
  using Group = TypeParam;
  const PoseGraph<Group> truth = ring<Group>(30);
  PoseGraph<Group> graph = truth;
  std::mt19937_64 generator(13);
  for (std::size_t i = 0; i < 60; ++i) graph.is_robust.push_back(graph.to[i] != graph.from[i] + 1);
  for (std::size_t i = 11; i < 40; i += 10) graph.T_from_to[i] *= anyStep<Group>(generator, 3);
  OptimizerOptions options;
  options.loss = {gslam::LossKind::GemanMcClure, 0.5};
  options.function_tolerance = 1e-15;
  const OptimizerSummary summary = solveGraph(graph.problem(), options);
  EXPECT_EQ(57u, summary.inliers);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_TRUE(truth.T_world_body[i].isApprox(graph.T_world_body[i], 0.05)) << i;
  }
}

TYPED_TEST(pose_graph, priors_replace_the_anchor) {
  using Group = TypeParam;
  const PoseGraph<Group> truth = ring<Group>(30);
  PoseGraph<Group> graph = truth;
  std::mt19937_64 generator(14);
  for (std::size_t i = 0; i < 30; ++i) graph.T_world_body[i] *= anyStep<Group>(generator, 0.1);
  graph.prior_pose = {7};
  graph.prior_T_world_body = {truth.T_world_body[7]};
  graph.prior_information = {Group::Jacobian::identity()};
  OptimizerOptions options;
  options.function_tolerance = 1e-20;
  const OptimizerSummary summary = solveGraph(graph.problem(), options);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_TRUE(truth.T_world_body[i].isApprox(graph.T_world_body[i], 1e-6)) << i;
  }
  EXPECT_EQ(30 * Group::kFreedom, summary.parameters);
}

// Of a chain of two edges with the identity as information and no rotation between: the first pose
// after the anchor has the identity, and so on.
TEST(pose_graph_covariance, of_a_chain_adds_up) {
  PoseGraph<SE3d> graph;
  graph.T_world_body.assign(3, SE3d());
  graph.from = {0, 1};
  graph.to = {1, 2};
  graph.T_from_to.assign(2, SE3d());
  const std::vector<std::uint32_t> poses = {2, 0, 1};
  const auto found = gslam::ceresBackend().covariance_3d(graph.problem(), poses, {});
  ASSERT_TRUE(found.is_valid) << found.message;
  for (std::size_t k = 0; k < 36; ++k) {
    const double one = k % 7 == 0 ? 1 : 0;
    EXPECT_NEAR(2 * one, found.poses[0].values[k], 1e-12);
    EXPECT_NEAR(0, found.poses[1].values[k], 0);
    EXPECT_NEAR(one, found.poses[2].values[k], 1e-12);
  }
  graph.from = {1};
  graph.to = {2};
  graph.T_from_to.resize(1);
  const std::vector<std::uint32_t> loose = {1};
  EXPECT_FALSE(gslam::ceresBackend().covariance_3d(graph.problem(), loose, {}).is_valid);
}

TEST(pose_graph_files, tiny_grid_reaches_the_optimum_of_se_sync) {
  NEEDS_TEST_DATA();
  auto graph =
      std::get<PoseGraph<SE3d>>(gslam::readG2o(test_data::folder() + "pose_graphs/tinyGrid3D.g2o"));
  OptimizerOptions options;
  options.max_iterations = 200;
  options.function_tolerance = 1e-12;
  const OptimizerSummary summary = solveGraph(graph.problem(PoseGraphResidual::Chordal), options);
  EXPECT_EQ(OptimizerStatus::Converged, summary.status) << summary.message;
  EXPECT_NEAR(18.52, 2 * summary.final_cost, 0.02);
}

}  // namespace
