// What the facade adds to what back ends do.
#include <gmock/gmock.h>
#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "backend_contract/scenes.h"

namespace {

using backend_contract::bundleScene;
using backend_contract::complaintOf;
using backend_contract::graphScene;
using gslam::OptimizerBackend;
using gslam::OptimizerOptions;
using gslam::OptimizerSummary;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;
using testing::ElementsAre;
using testing::HasSubstr;

OptimizerSummary answer() {
  OptimizerSummary summary;
  summary.status = gslam::OptimizerStatus::Converged;
  summary.warnings = {"of the back end"};
  summary.times.setup = 0.001;
  return summary;
}

template <class Group>
gslam::PoseGraphCovariance<Group> covarianceOf(const gslam::PoseGraphProblem<Group>&,
                                               gslam::Span<const std::uint32_t> poses,
                                               const OptimizerOptions&) {
  gslam::PoseGraphCovariance<Group> result;
  result.is_valid = true;
  result.poses.resize(poses.size());
  return result;
}

// Answers everything, and takes 2 ms for a bundle.
OptimizerOptions fakeOptions() {
  OptimizerBackend fake;
  fake.name = "fake";
  fake.pose = [](const gslam::PoseProblem&, const SE3d& start, const OptimizerOptions&) {
    gslam::OptimizedPose result;
    result.T_world_body = start;
    return result;
  };
  fake.alignment = [](const gslam::AlignmentProblem&, const SE3d& start, const OptimizerOptions&) {
    return gslam::OptimizedAlignment<SE3d>{start, answer(), {}};
  };
  fake.similarity_alignment = [](const gslam::AlignmentProblem&, const SIM3d& start,
                                 const OptimizerOptions&) {
    return gslam::OptimizedAlignment<SIM3d>{start, answer(), {}};
  };
  fake.bundle = [](const gslam::BundleProblem&, const OptimizerOptions&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return answer();
  };
  fake.pose_graph_2d = [](const gslam::PoseGraphProblem<SE2d>&, const OptimizerOptions&) {
    return answer();
  };
  fake.pose_graph_3d = [](const gslam::PoseGraphProblem<SE3d>&,
                          const OptimizerOptions&) -> OptimizerSummary {
    throw std::runtime_error("from progress");
  };
  fake.bundle_covariance = [](const gslam::BundleProblem&, gslam::Span<const std::uint32_t> poses,
                              gslam::Span<const std::uint32_t>, gslam::Span<const std::uint32_t>,
                              const OptimizerOptions&) {
    gslam::BundleCovariance result;
    result.poses.resize(poses.size());
    return result;
  };
  fake.covariance_2d = covarianceOf<SE2d>;
  fake.covariance_3d = covarianceOf<SE3d>;
  fake.covariance_sim3 = covarianceOf<SIM3d>;
  gslam::registerOptimizerBackend(fake);
  OptimizerOptions options;
  options.backend = "fake";
  return options;
}

TEST(optimize, completes_the_summary) {
  auto scene = bundleScene(4, 10, 0.01);
  scene.pose_fixed.clear();
  const OptimizerSummary summary = optimizeBundle(scene.problem(), fakeOptions());
  EXPECT_EQ(summary.backend, "fake");
  EXPECT_TRUE(summary.hasConverged());
  EXPECT_GT(summary.times.total, 0.002);
  EXPECT_GT(summary.times.setup, 0.001);
  EXPECT_LT(summary.times.setup, summary.times.total);
  EXPECT_THAT(summary.warnings,
              ElementsAre(HasSubstr("T_world_body is free as a whole"), "of the back end"));
}

TEST(optimize, refuses_a_problem_before_the_back_end_sees_it) {
  auto scene = bundleScene(4, 10, 0.01);
  scene.of_pose[2] = 4;
  EXPECT_EQ(complaintOf([&] { optimizeBundle(scene.problem(), fakeOptions()); }),
            "observation_pose[2] is 4, expected below 4");
  EXPECT_EQ(complaintOf([&] { bundleCovariance(scene.problem(), {}, {}, {}, fakeOptions()); }),
            "observation_pose[2] is 4, expected below 4");
  auto graph = graphScene<SE2d>(5, 0).graph;
  graph.from[1] = 9;
  EXPECT_EQ(complaintOf([&] { optimizePoseGraph(graph.problem(), fakeOptions()); }),
            "from[1] is 9, expected below 5");
}

TEST(optimize, hands_on_starts_and_exceptions) {
  const gslam::Vec3d point = {1, 2, 3};
  gslam::AlignmentProblem problem;
  problem.points_a = problem.points_b = gslam::Span<const gslam::Vec3d>(&point, 1);
  const SE3d start = SE3d::exp({1, 2, 3, 0.1, 0.2, 0.3});
  const auto rigid = optimizeAlignment(problem, start, fakeOptions());
  EXPECT_TRUE(rigid.T_a_b.isApprox(start, 0));
  EXPECT_EQ(rigid.summary.backend, "fake");
  const SIM3d scaled(start.rotation(), start.translation(), 2);
  EXPECT_TRUE(optimizeAlignment(problem, scaled, fakeOptions()).T_a_b.isApprox(scaled, 0));
  auto graph = graphScene<SE3d>(5, 0).graph;
  EXPECT_THROW(optimizePoseGraph(graph.problem(), fakeOptions()), std::runtime_error);
}

TEST(optimize, checks_what_covariances_are_asked_for) {
  auto scene = bundleScene(4, 10, 0.01);
  const std::vector<std::uint32_t> good = {0, 3, 3}, bad = {0, 10};
  const OptimizerOptions options = fakeOptions();
  EXPECT_EQ(bundleCovariance(scene.problem(), good, {}, {}, options).poses.size(), 3u);
  EXPECT_EQ(complaintOf([&] { bundleCovariance(scene.problem(), bad, {}, {}, options); }),
            "poses[1] is 10, expected below 4");
  EXPECT_EQ(complaintOf([&] { bundleCovariance(scene.problem(), {}, bad, {}, options); }),
            "points[1] is 10, expected below 10");
  EXPECT_EQ(complaintOf([&] { bundleCovariance(scene.problem(), {}, {}, bad, options); }),
            "cameras[1] is 10, expected below 1");
  auto plane = graphScene<SE2d>(5, 0).graph;
  auto space = graphScene<SE3d>(5, 0).graph;
  auto similar = graphScene<SIM3d>(5, 0).graph;
  EXPECT_TRUE(poseGraphCovariance(plane.problem(), good, options).is_valid);
  EXPECT_EQ(poseGraphCovariance(space.problem(), good, options).poses.size(), 3u);
  EXPECT_EQ(complaintOf([&] { poseGraphCovariance(similar.problem(), bad, options); }),
            "poses[1] is 10, expected below 5");
}

TEST(optimize, gives_no_covariance_of_what_nothing_connects_to_an_anchor) {
  auto graph = graphScene<SE3d>(5, 0).graph;
  graph.T_world_body.resize(7);  // an edge between the two, and none to the others
  graph.pose_fixed.resize(7);
  graph.from.push_back(5);
  graph.to.push_back(6);
  graph.T_from_to.emplace_back();
  graph.information.push_back(SE3d::Jacobian::identity());
  graph.is_robust.push_back(0);
  const std::vector<std::uint32_t> held = {4, 0}, loose = {4, 6};
  EXPECT_TRUE(poseGraphCovariance(graph.problem(), held, fakeOptions()).is_valid);
  const auto found = poseGraphCovariance(graph.problem(), loose, fakeOptions());
  EXPECT_FALSE(found.is_valid);
  EXPECT_EQ(found.message, "poses[1] is not connected to an anchor by edges");
  graph.pose_fixed[5] = 1;
  EXPECT_TRUE(poseGraphCovariance(graph.problem(), loose, fakeOptions()).is_valid);
}

}  // namespace
