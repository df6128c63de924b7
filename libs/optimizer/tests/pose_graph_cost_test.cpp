#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "backend_contract/scenes.h"

namespace {

using gslam::LossKind;
using gslam::PoseGraph;
using gslam::PoseGraphResidual;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;

// Two poses and an edge whose error is exp(tangent).
template <class Group>
PoseGraph<Group> oneEdge(const typename Group::Tangent& tangent) {
  PoseGraph<Group> graph = backend_contract::graphScene<Group>(2, 0).graph;
  graph.T_from_to[0] = graph.T_from_to[0] * Group::exp(tangent).inverse();
  graph.is_robust.clear();
  return graph;
}

template <class Group>
double quadratic(const typename Group::Tangent& r, const typename Group::Jacobian& information) {
  return 0.5 * r.dot(information * r);
}

TEST(pose_graph_cost, of_the_logarithm_is_that_of_the_tangent) {
  const SE3d::Tangent tangent = {0.1, -0.2, 0.3, 0.4, 0.1, -0.3};
  PoseGraph<SE3d> graph = oneEdge<SE3d>(tangent);
  const double expected = quadratic<SE3d>(tangent, graph.information[0]);
  EXPECT_NEAR(poseGraphCost(graph.problem()), expected, 1e-13);
  graph.information.clear();
  EXPECT_NEAR(poseGraphCost(graph.problem()), 0.5 * tangent.squaredNorm(), 1e-13);

  const SE2d::Tangent flat = {0.1, -0.2, 0.3};
  PoseGraph<SE2d> plane = oneEdge<SE2d>(flat);
  EXPECT_NEAR(poseGraphCost(plane.problem()), quadratic<SE2d>(flat, plane.information[0]), 1e-13);

  const SIM3d::Tangent scaled = {0.1, -0.2, 0.3, 0.4, 0.1, -0.3, 0.2};
  PoseGraph<SIM3d> similar = oneEdge<SIM3d>(scaled);
  EXPECT_NEAR(poseGraphCost(similar.problem()), quadratic<SIM3d>(scaled, similar.information[0]),
              1e-12);
}

TEST(pose_graph_cost, of_the_quaternion_is_that_of_g2o) {
  const SE3d::Tangent tangent = {0.1, -0.2, 0.3, 0.4, 0.1, -0.3};
  PoseGraph<SE3d> graph = oneEdge<SE3d>(tangent);
  const SE3d error = SE3d::exp(tangent);
  SE3d::Tangent r;
  for (std::size_t i = 0; i < 3; ++i) {
    r[i] = error.translation()[i];
    r[i + 3] = 2 * error.data()[i] * (error.data()[3] < 0 ? -1 : 1);
  }
  EXPECT_NEAR(poseGraphCost(graph.problem(PoseGraphResidual::Quaternion)),
              quadratic<SE3d>(r, graph.information[0]), 1e-13);
}

TEST(pose_graph_cost, of_chords_is_that_of_se_sync) {
  const SE3d::Tangent tangent = {0.1, -0.2, 0.3, 0.4, 0.1, -0.3};
  PoseGraph<SE3d> graph = oneEdge<SE3d>(tangent);
  graph.information[0] = SE3d::Jacobian::identity();
  for (std::size_t i = 0; i < 3; ++i) {
    graph.information[0](i, i) = 4 + static_cast<double>(i);
    graph.information[0](i + 3, i + 3) = 40 + static_cast<double>(i);
  }
  const double tau = 3 / (1 / 4.0 + 1 / 5.0 + 1 / 6.0);
  const double kappa = 6 / (1 / 40.0 + 1 / 41.0 + 1 / 42.0);
  const SE3d from = graph.T_world_body[0], to = graph.T_world_body[1], z = graph.T_from_to[0];
  const gslam::Mat3d rotations =
      to.rotation().matrix() - from.rotation().matrix() * z.rotation().matrix();
  const gslam::Vec3d offset =
      to.translation() - from.translation() - from.rotation() * z.translation();
  double square = tau * offset.squaredNorm();
  for (std::size_t i = 0; i < 9; ++i) {
    square += kappa * rotations.data()[i] * rotations.data()[i];
  }
  EXPECT_NEAR(poseGraphCost(graph.problem(PoseGraphResidual::Chordal)), 0.5 * square, 1e-12);
}

TEST(pose_graph_cost, has_a_loss_on_robust_edges_only) {
  const SE3d::Tangent tangent = {3, 4, 0, 0, 0, 0};
  PoseGraph<SE3d> graph = oneEdge<SE3d>(tangent);
  graph.information.clear();
  const gslam::RobustLoss huber = {LossKind::Huber, 2};
  EXPECT_NEAR(poseGraphCost(graph.problem(), huber), 8, 1e-12);
  graph.is_robust = {0};
  EXPECT_NEAR(poseGraphCost(graph.problem(), huber), 12.5, 1e-12);
  graph.is_robust = {1};
  EXPECT_NEAR(poseGraphCost(graph.problem(), huber), 8, 1e-12);
  graph.prior_pose = {1};
  graph.prior_T_world_body = {graph.T_world_body[1] * SE3d::exp(tangent).inverse()};
  graph.prior_information = {SE3d::Jacobian::identity()};
  EXPECT_NEAR(poseGraphCost(graph.problem(), huber), 20.5, 1e-12);
}

TEST(pose_graph_cost, refuses_what_cannot_be_right) {
  PoseGraph<SE3d> graph = oneEdge<SE3d>({});
  graph.to[0] = 0;
  EXPECT_EQ(backend_contract::complaintOf([&] { poseGraphCost(graph.problem()); }),
            "to[0] is the pose that the edge comes from");
  EXPECT_EQ(backend_contract::complaintOf([&] {
              poseGraphCost(graph.problem(), {LossKind::Huber, -1});
            }),
            "loss.scale is -1, expected above 0, and finite");
}

}  // namespace
