#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "pose_graph_instances.h"
#include "solvers.h"

namespace gslam {
namespace {

using detail::pba::solvePoseGraph;
using pose_graph_test::disturb;
using pose_graph_test::Graph;
using pose_graph_test::GraphRandom;
using pose_graph_test::sameBits;
using pose_graph_test::walk;

constexpr PoseGraphResidual kAllResiduals[] = {
    PoseGraphResidual::Logarithm, PoseGraphResidual::Quaternion, PoseGraphResidual::Chordal};

template <class Group>
bool hasResidual(PoseGraphResidual kind) {
  return Group::kFreedom != 7 || kind != PoseGraphResidual::Chordal;
}

OptimizerOptions tight(unsigned threads = 1) {
  OptimizerOptions options;
  options.function_tolerance = 1e-14;
  options.threads = threads;
  return options;
}

template <class Group>
class PoseGraphSolver : public ::testing::Test {};
using GraphGroups = ::testing::Types<SE2d, SE3d, SIM3d>;
TYPED_TEST_SUITE(PoseGraphSolver, GraphGroups, );

TYPED_TEST(PoseGraphSolver, one_edge_puts_its_pose_where_it_was_measured) {
  Graph<TypeParam> graph = walk<TypeParam>(2, 0, 0, 3);
  const TypeParam first = graph.T_world_body[0], second = graph.T_world_body[1];
  graph.T_world_body[1] = TypeParam();
  const OptimizerSummary summary = solvePoseGraph(graph.problem(), tight());
  EXPECT_TRUE(summary.is_usable);
  EXPECT_TRUE(summary.hasConverged()) << summary.message;
  EXPECT_NEAR(summary.final_cost, 0, 1e-20);
  EXPECT_TRUE(sameBits(graph.T_world_body[0], first));
  EXPECT_TRUE(graph.T_world_body[1].isApprox(second, 1e-9));
}

TYPED_TEST(PoseGraphSolver, finds_the_truth_of_exact_loops_with_every_residual) {
  for (const PoseGraphResidual kind : kAllResiduals) {
    if (!hasResidual<TypeParam>(kind)) continue;
    Graph<TypeParam> graph = walk<TypeParam>(40, 30, 0, 5);
    const std::vector<TypeParam> truth = graph.T_world_body;
    disturb(graph, 0.1, 6);
    const OptimizerSummary summary = solvePoseGraph(graph.problem(kind), tight());
    EXPECT_TRUE(summary.is_usable) << summary.message;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 1e-6)) << i;
    }
  }
}

TYPED_TEST(PoseGraphSolver, the_cost_is_that_of_the_formulas_and_at_a_minimum) {
  for (const PoseGraphResidual kind : kAllResiduals) {
    if (!hasResidual<TypeParam>(kind)) continue;
    Graph<TypeParam> graph = walk<TypeParam>(15, 20, 0.1, 7);
    graph.addPrior(4, graph.T_world_body[4] * GraphRandom(1).pose<TypeParam>(0.2));
    OptimizerOptions options = tight();
    options.loss = {LossKind::Huber, 2};
    const auto problem = graph.problem(kind);
    const double before = poseGraphCost(problem, options.loss);
    const OptimizerSummary summary = solvePoseGraph(problem, options);
    EXPECT_NEAR(summary.initial_cost, before, 1e-10 * before);
    const double cost = poseGraphCost(problem, options.loss);
    EXPECT_NEAR(summary.final_cost, cost, 1e-12 * cost);
    for (std::size_t i = 0; i < graph.T_world_body.size(); ++i) {
      for (std::size_t k = 0; k < TypeParam::kFreedom; ++k) {
        const TypeParam kept = graph.T_world_body[i];
        double sides[2];
        for (const int side : {0, 1}) {
          typename TypeParam::Tangent step{};
          step[k] = side == 0 ? -1e-4 : 1e-4;
          graph.T_world_body[i] = kept * TypeParam::exp(step);
          sides[side] = poseGraphCost(problem, options.loss);
        }
        graph.T_world_body[i] = kept;
        EXPECT_GT(sides[0], cost);
        EXPECT_GT(sides[1], cost);
        EXPECT_NEAR((sides[1] - sides[0]) / 2e-4, 0, 2e-5 * (1 + cost));
      }
    }
  }
}

TYPED_TEST(PoseGraphSolver, threads_do_not_change_a_bit) {
  for (const PoseGraphResidual kind : kAllResiduals) {
    if (!hasResidual<TypeParam>(kind)) continue;
    std::vector<TypeParam> first;
    for (const unsigned threads : {1u, 2u, 3u, 7u}) {
      Graph<TypeParam> graph = walk<TypeParam>(110, 70, 0.05, 8);
      disturb(graph, 0.05, 9);
      OptimizerOptions options;
      options.threads = threads;
      options.loss = {LossKind::GemanMcClure, 5};
      EXPECT_TRUE(solvePoseGraph(graph.problem(kind), options).is_usable);
      if (first.empty()) first = graph.T_world_body;
      for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_TRUE(sameBits(graph.T_world_body[i], first[i])) << threads << " threads, pose " << i;
      }
    }
  }
}

TYPED_TEST(PoseGraphSolver, anchors_keep_every_bit) {
  Graph<TypeParam> graph = walk<TypeParam>(30, 20, 0.05, 10);
  graph.pose_fixed.assign(30, 0);
  graph.pose_fixed[7] = graph.pose_fixed[8] = graph.pose_fixed[21] = 1;
  disturb(graph, 0.05, 11, 0);
  const std::vector<TypeParam> before = graph.T_world_body;
  const OptimizerSummary summary = solvePoseGraph(graph.problem(), OptimizerOptions());
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  EXPECT_EQ(summary.parameters, 27 * TypeParam::kFreedom);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(sameBits(graph.T_world_body[i], before[i]), graph.pose_fixed[i] != 0) << i;
  }
}

TYPED_TEST(PoseGraphSolver, parts_that_nothing_connects_are_held_one_by_one) {
  Graph<TypeParam> graph = walk<TypeParam>(20, 15, 0, 12);
  const Graph<TypeParam> other = walk<TypeParam>(15, 10, 0, 13);
  for (std::size_t e = 0; e < other.from.size(); ++e) {
    graph.add(other.from[e] + 20, other.to[e] + 20, other.T_from_to[e], other.information[e]);
  }
  graph.is_robust.clear();
  graph.T_world_body.insert(graph.T_world_body.end(), other.T_world_body.begin(),
                            other.T_world_body.end());
  graph.T_world_body.push_back(TypeParam());  // without edges
  const std::vector<TypeParam> truth = graph.T_world_body;
  GraphRandom random(14);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i != 0 && i != 20 && i != 35) graph.T_world_body[i] *= random.pose<TypeParam>(0.05);
  }
  const OptimizerSummary summary = solvePoseGraph(graph.problem(), tight());
  EXPECT_TRUE(summary.is_usable);
  for (const std::size_t i : {0u, 20u, 35u}) EXPECT_TRUE(sameBits(graph.T_world_body[i], truth[i]));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 1e-6)) << i;
  }
}

TYPED_TEST(PoseGraphSolver, a_prior_replaces_the_anchor) {
  Graph<TypeParam> graph = walk<TypeParam>(20, 10, 0, 15);
  const std::vector<TypeParam> truth = graph.T_world_body;
  graph.addPrior(11, truth[11]);
  disturb(graph, 0.1, 16, 0);
  EXPECT_TRUE(solvePoseGraph(graph.problem(), tight()).is_usable);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 1e-6)) << i;
  }
}

TYPED_TEST(PoseGraphSolver, false_loops_lose_against_geman_and_mcclure) {
  Graph<TypeParam> graph = walk<TypeParam>(60, 70, 0.005, 17);
  const std::vector<TypeParam> truth = graph.T_world_body;
  for (auto& weight : graph.information) weight = 4e4 * TypeParam::Jacobian::identity();
  GraphRandom random(18);
  const std::size_t honest = graph.from.size();
  for (int k = 0; k < 30; ++k) {
    const std::size_t i = random.below(60), j = (i + 2 + random.below(56)) % 60;
    graph.add(i, j, random.pose<TypeParam>(2), graph.information[0]);
    graph.is_robust.push_back(1);
  }
  disturb(graph, 0.02, 19);
  OptimizerOptions options = tight();
  options.max_iterations = 200;
  options.loss = {LossKind::GemanMcClure, 8};
  const OptimizerSummary summary = solvePoseGraph(graph.problem(), options);
  EXPECT_TRUE(summary.is_usable);
  EXPECT_NEAR(static_cast<double>(summary.inliers), static_cast<double>(honest), 6.0);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 0.1)) << i;
  }
}

TYPED_TEST(PoseGraphSolver, conjugate_gradients_reach_the_same_minimum) {
  Graph<TypeParam> graph = walk<TypeParam>(20, 16, 0.05, 20);
  disturb(graph, 0.05, 21);
  Graph<TypeParam> copy = graph;
  OptimizerOptions options;
  options.function_tolerance = 1e-12;
  const OptimizerSummary direct = solvePoseGraph(graph.problem(), options);
  options.linear_solver = LinearSolverKind::Iterative;
  options.linear_tolerance = 1e-3;
  options.max_linear_iterations = 1000;
  const OptimizerSummary iterative = solvePoseGraph(copy.problem(), options);
  EXPECT_NEAR(iterative.final_cost, direct.final_cost, 1e-8 * direct.final_cost);
  EXPECT_GT(iterative.iterations.at(1).linear_iterations, 3u);
}

TEST(pose_graph_solver, what_it_does_instead_of_what_was_asked_for_is_said) {
  const auto warnings = [](LinearSolverKind solver, PreconditionerKind preconditioner) {
    Graph<SE2d> graph = walk<SE2d>(5, 3, 0.05, 28);
    OptimizerOptions options;
    options.linear_solver = solver;
    options.preconditioner = preconditioner;
    return solvePoseGraph(graph.problem(), options).warnings.size();
  };
  EXPECT_EQ(warnings(LinearSolverKind::Automatic, PreconditionerKind::PowerSeries), 0u);
  EXPECT_EQ(warnings(LinearSolverKind::Sparse, PreconditionerKind::Automatic), 0u);
  EXPECT_EQ(warnings(LinearSolverKind::Dense, PreconditionerKind::Automatic), 1u);
  EXPECT_EQ(warnings(LinearSolverKind::Iterative, PreconditionerKind::BlockJacobi), 0u);
  EXPECT_EQ(warnings(LinearSolverKind::Iterative, PreconditionerKind::PowerSeries), 1u);
}

TYPED_TEST(PoseGraphSolver, a_start_without_a_cost_fails_and_stays) {
  Graph<TypeParam> graph = walk<TypeParam>(5, 3, 0, 22);
  typename TypeParam::Tangent nowhere{};
  nowhere[0] = std::numeric_limits<double>::quiet_NaN();
  graph.T_world_body[2] = graph.T_world_body[2] * TypeParam::exp(nowhere);
  const std::vector<TypeParam> before = graph.T_world_body;
  const OptimizerSummary summary = solvePoseGraph(graph.problem(), OptimizerOptions());
  EXPECT_EQ(summary.status, OptimizerStatus::Failed);
  EXPECT_FALSE(summary.is_usable);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_TRUE(sameBits(graph.T_world_body[i], before[i]));
  }
}

TYPED_TEST(PoseGraphSolver, the_summary_counts_what_there_is) {
  Graph<TypeParam> graph = walk<TypeParam>(12, 8, 0.01, 23);
  graph.addPrior(3, graph.T_world_body[3]);
  const auto problem = graph.problem();
  OptimizerOptions options;
  options.max_iterations = 0;
  const std::vector<TypeParam> before = graph.T_world_body;
  const OptimizerSummary summary = solvePoseGraph(problem, options);
  EXPECT_EQ(summary.status, OptimizerStatus::MaxIterations);
  EXPECT_EQ(summary.backend, "pba");
  EXPECT_FALSE(summary.linear_solver.empty());
  EXPECT_EQ(summary.observations, graph.from.size());
  EXPECT_EQ(summary.inliers, graph.from.size());
  EXPECT_EQ(summary.residuals, (graph.from.size() + 1) * TypeParam::kFreedom);
  EXPECT_EQ(summary.parameters, 12 * TypeParam::kFreedom);
  EXPECT_EQ(summary.initial_cost, summary.final_cost);
  EXPECT_EQ(summary.iterations.size(), 1u);
}

TEST(pose_graph_solver, everything_fixed_or_nothing_at_all_is_no_problem) {
  Graph<SE3d> graph = walk<SE3d>(4, 2, 0.1, 24);
  graph.pose_fixed.assign(4, 1);
  EXPECT_TRUE(solvePoseGraph(graph.problem(), OptimizerOptions()).is_usable);
  Graph<SE3d> empty;
  EXPECT_TRUE(solvePoseGraph(empty.problem(), OptimizerOptions()).is_usable);
}

TEST(pose_graph_solver, progress_may_end_it_or_throw_and_what_was_found_is_kept) {
  for (const bool throws : {false, true}) {
    Graph<SE3d> graph = walk<SE3d>(30, 20, 0.05, 25);
    disturb(graph, 0.1, 26);
    const double before = poseGraphCost(graph.problem());
    OptimizerOptions options;
    double reported = 0;
    options.progress = [&](const OptimizerIteration& iteration) {
      reported = iteration.cost;
      if (throws && iteration.number == 2) throw std::runtime_error("enough");
      return iteration.number < 2;
    };
    if (throws) {
      EXPECT_THROW(solvePoseGraph(graph.problem(), options), std::runtime_error);
    } else {
      EXPECT_EQ(solvePoseGraph(graph.problem(), options).status, OptimizerStatus::Cancelled);
    }
    EXPECT_LT(reported, before);
    EXPECT_NEAR(poseGraphCost(graph.problem()), reported, 1e-12 * reported);
  }
}

TEST(pose_graph_solver, the_mean_of_two_priors_has_their_weights) {
  Graph<SE3d> graph;
  graph.T_world_body.resize(1);
  graph.addPrior(0, SE3d(SO3d(), {{1, 0, 0}}), 3 * SE3d::Jacobian::identity());
  graph.addPrior(0, SE3d(SO3d(), {{5, 0, 0}}), 1 * SE3d::Jacobian::identity());
  EXPECT_TRUE(solvePoseGraph(graph.problem(), tight()).is_usable);
  EXPECT_NEAR(graph.T_world_body[0].translation()[0], 2, 1e-9);
}

TEST(pose_graph_solver, edges_that_repeat_count_each) {
  Graph<SE2d> once = walk<SE2d>(10, 6, 0.1, 27);
  Graph<SE2d> twice = once;
  for (std::size_t e = 0; e < once.from.size(); ++e) {
    once.information[e] *= 2;
    twice.add(once.from[e], once.to[e], once.T_from_to[e], SE2d::Jacobian(twice.information[e]));
  }
  once.is_robust.clear();
  twice.is_robust.clear();
  EXPECT_TRUE(solvePoseGraph(once.problem(), tight()).is_usable);
  EXPECT_TRUE(solvePoseGraph(twice.problem(), tight()).is_usable);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_TRUE(once.T_world_body[i].isApprox(twice.T_world_body[i], 1e-7));
}

// The derivatives of an edge overflow, whose residual along them is 0.
TEST(pose_graph_solver, takes_no_gradient_without_a_value_for_a_small_one) {
  Graph<SE3d> graph;
  graph.T_world_body = {SE3d(), SE3d(SO3d::exp({0, 0.1, 0}), {1e200, 0, 0})};
  graph.pose_fixed = {0, 1};
  auto information = SE3d::Jacobian::identity();
  for (std::size_t k = 0; k < 3; ++k) information(k, k) = 1e300;
  graph.add(0, 1, SE3d(SO3d(), {1e200, 0, 0}), information);
  const OptimizerSummary summary = solvePoseGraph(graph.problem(), OptimizerOptions());
  EXPECT_NEAR(summary.initial_cost, 0.005, 1e-9);
  EXPECT_FALSE(summary.hasConverged()) << summary.message;
}

}  // namespace
}  // namespace gslam
