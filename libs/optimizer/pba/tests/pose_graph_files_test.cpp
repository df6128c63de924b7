#include <gslam/geometry/nearest_rotation.h>
#include <gslam/optimizer/files/g2o.h>
#include <gslam/optimizer/initialize_poses.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "solvers.h"
#include "test_data.h"

namespace gslam {
namespace {

using detail::pba::solvePoseGraph;

template <class Group>
PoseGraph<Group> readGraph(const std::string& name) {
  return std::get<PoseGraph<Group>>(readG2o(test_data::folder() + "pose_graphs/" + name));
}

// Published global optima: Rosen et al., "SE-Sync", IJRR 38(2-3), 2019, tables 1 to 3, of the whole
// sum, which is twice our cost.
template <class Group>
double chordalOptimum(const std::string& name) {
  PoseGraph<Group> graph = readGraph<Group>(name);
  const auto problem = graph.problem(PoseGraphResidual::Chordal);
  EXPECT_EQ(initializePoses(problem), PoseInitialization::Chordal);
  const OptimizerSummary summary = solvePoseGraph(problem, OptimizerOptions());
  EXPECT_TRUE(summary.hasConverged()) << summary.message;
  return 2 * summary.final_cost;
}

// Root mean square of the distances, after the rigid alignment that makes it least.
double positionError(const std::vector<SE3d>& poses, const std::vector<SE3d>& truth) {
  const double count = static_cast<double>(poses.size());
  Vec3d mean{}, true_mean{};
  for (const SE3d& pose : poses) mean += pose.translation() / count;
  for (const SE3d& pose : truth) true_mean += pose.translation() / count;
  Mat3d cross{};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    cross += outer(truth[i].translation() - true_mean, poses[i].translation() - mean);
  }
  const SO3d rotation = nearestRotation(cross).rotation;
  double squared = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    squared += (rotation * (poses[i].translation() - mean) - (truth[i].translation() - true_mean))
                   .squaredNorm();
  }
  return std::sqrt(squared / count);
}

TEST(pose_graph_files, se_syncs_optima_are_reached) {
  NEEDS_TEST_DATA();
  EXPECT_LT(chordalOptimum<SE3d>("sphere2500.g2o"), 1.0001 * 1687.0);
  EXPECT_LT(chordalOptimum<SE3d>("parking-garage.g2o"), 1.0001 * 1.263);
  EXPECT_LT(chordalOptimum<SE3d>("smallGrid3D.g2o"), 1.0001 * 1025.4);
  EXPECT_LT(chordalOptimum<SE2d>("INTEL.g2o"), 1.0001 * 393.7);
  EXPECT_LT(chordalOptimum<SE2d>("M3500.g2o"), 1.0001 * 193.9);
}

TEST(pose_graph_files, the_true_sphere_is_found_again) {
  NEEDS_TEST_DATA();
  PoseGraph<SE3d> graph = readGraph<SE3d>("sphere2500.g2o");
  const auto problem = graph.problem(PoseGraphResidual::Quaternion);
  initializePoses(problem);
  OptimizerOptions options;
  options.threads = 2;
  const OptimizerSummary summary = solvePoseGraph(problem, options);
  EXPECT_NEAR(2 * summary.final_cost, 727.15, 0.01);
  // Edges without noise, in the order of the poses that they lead to.
  std::vector<SE3d> truth(1);
  std::ifstream file(test_data::folder() + "pose_graphs/sphere2500_groundtruth.txt");
  std::string line, word;
  while (std::getline(file, line) && truth.size() < graph.T_world_body.size()) {
    std::istringstream in(line);
    std::size_t i, j;
    double v[6];
    in >> word >> i >> j;
    for (double& value : v) in >> value;
    if (j != i + 1) continue;  // a loop
    ASSERT_EQ(j, truth.size());
    const SO3d rotation =
        SO3d::exp({{0, 0, v[5]}}) * SO3d::exp({{0, v[4], 0}}) * SO3d::exp({{v[3], 0, 0}});
    truth.push_back(truth.back() * SE3d(rotation, {{v[0], v[1], v[2]}}));
  }
  ASSERT_EQ(truth.size(), graph.T_world_body.size());
  const std::vector<SE3d> odometry = readGraph<SE3d>("sphere2500.g2o").T_world_body;
  EXPECT_LT(positionError(graph.T_world_body, truth), 0.05 * positionError(odometry, truth));
  EXPECT_LT(positionError(graph.T_world_body, truth), 0.3);  // metres, of a sphere 100 wide
}

}  // namespace
}  // namespace gslam
