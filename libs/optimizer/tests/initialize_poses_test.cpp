#include <gslam/base/error.h>
#include <gslam/optimizer/initialize_poses.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pose_graph_instances.h"

namespace gslam {
namespace {

using pose_graph_test::disturb;
using pose_graph_test::Graph;
using pose_graph_test::GraphRandom;
using pose_graph_test::sameBits;
using pose_graph_test::walk;

constexpr PoseInitialization kWays[] = {PoseInitialization::Chordal,
                                        PoseInitialization::SpanningTree};

template <class Group>
class InitializePoses : public ::testing::Test {};
using InitialGroups = ::testing::Types<SE2d, SE3d, SIM3d>;
TYPED_TEST_SUITE(InitializePoses, InitialGroups, );

template <class Group>
void forget(Graph<Group>& graph, std::size_t first = 1) {
  GraphRandom random(99);
  for (std::size_t i = first; i < graph.T_world_body.size(); ++i) {
    if (graph.pose_fixed.empty() || graph.pose_fixed[i] == 0)
      graph.T_world_body[i] = random.pose<Group>(1);
  }
}

TYPED_TEST(InitializePoses, finds_the_truth_where_measurements_are_exact) {
  for (const PoseInitialization way : kWays) {
    Graph<TypeParam> graph = walk<TypeParam>(60, 40, 0, 1);
    const std::vector<TypeParam> truth = graph.T_world_body;
    forget(graph);
    EXPECT_EQ(initializePoses(graph.problem(), way), way);
    EXPECT_TRUE(sameBits(graph.T_world_body[0], truth[0]));
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 1e-9)) << i;
    }
  }
}

TYPED_TEST(InitializePoses, chordal_relaxation_beats_the_tree_where_there_is_noise) {
  Graph<TypeParam> graph = walk<TypeParam>(80, 120, 0.05, 2);
  Graph<TypeParam> tree = graph;
  const double truth = poseGraphCost(graph.problem());
  initializePoses(graph.problem());
  initializePoses(tree.problem(), PoseInitialization::SpanningTree);
  EXPECT_LT(poseGraphCost(graph.problem()), 3 * truth);
  EXPECT_LT(poseGraphCost(graph.problem()), poseGraphCost(tree.problem()));
}

TYPED_TEST(InitializePoses, all_anchors_keep_every_bit_and_are_begun_from) {
  for (const PoseInitialization way : kWays) {
    Graph<TypeParam> graph = walk<TypeParam>(40, 25, 0, 3);
    const std::vector<TypeParam> truth = graph.T_world_body;
    graph.pose_fixed.assign(40, 0);
    graph.pose_fixed[9] = graph.pose_fixed[30] = 1;
    forget(graph, 0);
    initializePoses(graph.problem(), way);
    for (const std::size_t i : {9u, 30u}) EXPECT_TRUE(sameBits(graph.T_world_body[i], truth[i]));
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 1e-9)) << i;
    }
  }
}

TYPED_TEST(InitializePoses, without_an_anchor_a_complete_prior_says_where) {
  for (const PoseInitialization way : kWays) {
    Graph<TypeParam> graph = walk<TypeParam>(20, 15, 0, 4);
    const std::vector<TypeParam> truth = graph.T_world_body;
    graph.addPrior(3, TypeParam(), typename TypeParam::Jacobian{});  // says nothing
    graph.addPrior(13, truth[13]);
    forget(graph, 0);
    initializePoses(graph.problem(), way);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 1e-9)) << i;
    }
  }
}

TYPED_TEST(InitializePoses, each_part_begins_at_its_lowest_pose) {
  for (const PoseInitialization way : kWays) {
    Graph<TypeParam> graph = walk<TypeParam>(15, 10, 0, 5);
    const Graph<TypeParam> other = walk<TypeParam>(10, 6, 0, 6);
    for (std::size_t e = 0; e < other.from.size(); ++e) {
      graph.add(other.from[e] + 15, other.to[e] + 15, other.T_from_to[e]);
    }
    graph.is_robust.clear();
    graph.T_world_body.insert(graph.T_world_body.end(), other.T_world_body.begin(),
                              other.T_world_body.end());
    graph.T_world_body.push_back(GraphRandom(7).pose<TypeParam>(1));  // without edges
    const std::vector<TypeParam> truth = graph.T_world_body;
    forget(graph);
    graph.T_world_body[15] = truth[15];
    graph.T_world_body[25] = truth[25];
    EXPECT_EQ(initializePoses(graph.problem(), way), way);
    for (const std::size_t i : {0u, 15u, 25u})
      EXPECT_TRUE(sameBits(graph.T_world_body[i], truth[i]));
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 1e-9)) << i;
    }
  }
}

TYPED_TEST(InitializePoses, falls_back_to_the_tree_where_edges_weigh_nothing) {
  Graph<TypeParam> graph = walk<TypeParam>(10, 0, 0, 8);
  const std::vector<TypeParam> truth = graph.T_world_body;
  graph.information[4] = typename TypeParam::Jacobian{};
  forget(graph);
  EXPECT_EQ(initializePoses(graph.problem()), PoseInitialization::SpanningTree);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 1e-9)) << i;
  }
}

TYPED_TEST(InitializePoses, a_start_without_numbers_does_no_harm) {
  Graph<TypeParam> graph = walk<TypeParam>(1, 0, 0, 9);
  initializePoses(graph.problem());
  Graph<TypeParam> empty;
  EXPECT_EQ(initializePoses(empty.problem()), PoseInitialization::Chordal);
}

TEST(initialize_poses, an_edge_to_nowhere_is_refused) {
  Graph<SE3d> graph = walk<SE3d>(5, 0, 0, 10);
  graph.add(2, 900, SE3d());
  graph.is_robust.clear();
  EXPECT_THROW(initializePoses(graph.problem()), ArgumentError);
}

TEST(initialize_poses, information_may_be_left_out) {
  Graph<SE3d> graph = walk<SE3d>(10, 5, 0, 11);
  const std::vector<SE3d> truth = graph.T_world_body;
  forget(graph);
  graph.information.clear();
  initializePoses(graph.problem());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(graph.T_world_body[i].isApprox(truth[i], 1e-9));
  }
}

}  // namespace
}  // namespace gslam
