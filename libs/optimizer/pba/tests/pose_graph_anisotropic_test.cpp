// Edges that know far more of some directions than of others, as those of cubicle do.
#include <gslam/optimizer/initialize_poses.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "pose_graph_instances.h"
#include "solvers.h"

namespace gslam {
namespace {

using detail::pba::solvePoseGraph;
using pose_graph_test::Graph;
using pose_graph_test::GraphRandom;

// U^T diag(w) U with a random rotation in each half; w from 1 to `condition`, evenly by their logs.
// The root, and with it noise of this information, comes out too.
struct Anisotropy {
  SE3d::Jacobian information{};
  SE3d::Jacobian deviation{};  // times a vector of unit normals: the noise

  Anisotropy(double least, double condition, GraphRandom& random) {
    for (std::size_t half = 0; half < 6; half += 3) {
      const Mat3d turn = SO3d::exp({{random.normal(), random.normal(), random.normal()}}).matrix();
      Mat3d weights{}, deviations{};
      for (std::size_t i = 0; i < 3; ++i) {
        weights(i, i) = least * std::pow(condition, 0.5 * static_cast<double>(i));
        deviations(i, i) = 1 / std::sqrt(weights(i, i));
      }
      information.setBlock(half, half, turn * weights * turn.transpose());
      deviation.setBlock(half, half, turn * deviations);
    }
  }
};

// A walk of unit steps, row by row to and fro, through a cube of side^3, with an edge to each
// neighbour that was visited before. Poses are the odometry.
Graph<SE3d> anisotropicGrid(std::size_t side, double least, double condition,
                            std::vector<SE3d>& truth) {
  GraphRandom random(3);
  Graph<SE3d> graph;
  std::vector<std::size_t> at(side * side * side);
  const auto connect = [&](std::size_t i, std::size_t j) {
    const Anisotropy weight(least, condition, random);
    SE3d::Tangent noise;
    for (double& value : noise.values) value = random.normal();
    graph.add(i, j, truth[i].inverse() * truth[j] * SE3d::exp(weight.deviation * noise),
              weight.information);
  };
  for (std::size_t k = 0; k < at.size(); ++k) {
    const std::size_t z = k / (side * side), row = k / side;
    const std::size_t y = z % 2 == 0 ? row % side : side - 1 - row % side;
    const std::size_t x = row % 2 == 0 ? k % side : side - 1 - k % side;
    const auto place = [side](std::size_t a, std::size_t b, std::size_t c) {
      return (c * side + b) * side + a;
    };
    at[place(x, y, z)] = k;
    truth.push_back(
        SE3d(SO3d::exp({{random.normal(), random.normal(), random.normal()}}),
             {{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}}));
    if (k == 0) {
      graph.T_world_body.push_back(truth[0]);
      continue;
    }
    connect(k - 1, k);
    graph.T_world_body.push_back(graph.T_world_body.back() * graph.T_from_to.back());
    const std::size_t neighbours[] = {x > 0 ? at[place(x - 1, y, z)] : k,
                                      y > 0 ? at[place(x, y - 1, z)] : k,
                                      z > 0 ? at[place(x, y, z - 1)] : k};
    for (const std::size_t other : neighbours) {
      if (other + 1 < k) connect(other, k);
    }
  }
  return graph;
}

struct AnisotropicResult {
  double expected = 0;  // by the number of edges and poses
  double at_truth = 0;
  OptimizerSummary from_odometry, from_chordal;
};

AnisotropicResult solveGrid(std::size_t side, double least, double condition,
                            PoseGraphResidual residual) {
  std::vector<SE3d> truth;
  const Graph<SE3d> grid = anisotropicGrid(side, least, condition, truth);
  AnisotropicResult result;
  result.expected =
      3.0 * (static_cast<double>(grid.from.size()) - static_cast<double>(truth.size()) + 1);
  Graph<SE3d> graph = grid;
  graph.T_world_body = truth;
  result.at_truth = poseGraphCost(graph.problem(residual));
  OptimizerOptions options;
  options.max_iterations = 100;
  graph = grid;
  result.from_odometry = solvePoseGraph(graph.problem(residual), options);
  graph = grid;
  EXPECT_EQ(initializePoses(graph.problem(residual)), PoseInitialization::Chordal);
  result.from_chordal = solvePoseGraph(graph.problem(residual), options);
  return result;
}

TEST(pose_graph_anisotropic, information_does_not_keep_a_grid_from_its_minimum) {
  const std::size_t side = std::getenv("GSLAM_FULL_TESTS") != nullptr ? 8 : 4;
  for (const double condition : {1e2, 1e4, 1e6}) {
    for (const PoseGraphResidual residual :
         {PoseGraphResidual::Logarithm, PoseGraphResidual::Quaternion}) {
      SCOPED_TRACE(condition);
      const AnisotropicResult result = solveGrid(side, 60, condition, residual);
      EXPECT_TRUE(result.from_chordal.hasConverged()) << result.from_chordal.message;
      // Chi squared: half of it, within five standard deviations. Noise is that of the logarithm.
      if (residual == PoseGraphResidual::Logarithm) {
        EXPECT_NEAR(result.from_chordal.final_cost, result.expected,
                    5 * std::sqrt(result.expected));
      }
      EXPECT_LT(result.from_chordal.final_cost, result.at_truth);
      if (side > 4) continue;  // from odometry of 512 steps some take more than 100 iterations
      EXPECT_TRUE(result.from_odometry.hasConverged()) << result.from_odometry.message;
      EXPECT_NEAR(result.from_odometry.final_cost, result.from_chordal.final_cost,
                  1e-4 * result.from_chordal.final_cost);
      EXPECT_LT(result.from_odometry.iterations.size(), 20u);  // does not stall
    }
  }
}

}  // namespace
}  // namespace gslam
