// Pose graphs with g2o's own types, whose residual is (t, vec q): half of Quaternion's rotation.
#include <g2o/core/block_solver.h>
#include <g2o/solvers/cholmod/linear_solver_cholmod.h>
#include <g2o/types/slam3d/edge_se3.h>
#include <g2o/types/slam3d/vertex_se3.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "g2o_search.h"
#include "measure.h"

namespace {

using gslam::SE3d;

g2o::Isometry3 isometryOf(const SE3d& T) {
  return quatOf(T).operator g2o::Isometry3();
}

g2o::EdgeSE3::InformationType informationOf(const SE3d::Jacobian& ours) {
  g2o::EdgeSE3::InformationType theirs;
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 6; ++c) {
      const double scale = (r < 3 ? 1 : 2) * (c < 3 ? 1 : 2);
      theirs(r, c) = scale * ours(static_cast<std::size_t>(r), static_cast<std::size_t>(c));
    }
  }
  return theirs;
}

void solveGraph(gslam::PoseGraph<SE3d>& graph, gslam::PoseGraphResidual) {
  using Blocks = g2o::BlockSolver_6_3;
  auto linear = std::make_unique<g2o::LinearSolverCholmod<Blocks::PoseMatrixType>>();
  linear->setBlockOrdering(true);
  G2oSearch<Blocks, g2o::LinearSolverCholmod> search(std::move(linear));
  std::vector<g2o::VertexSE3*> poses;
  for (std::size_t i = 0; i < graph.T_world_body.size(); ++i) {
    auto* const pose = new g2o::VertexSE3;
    pose->setEstimate(isometryOf(graph.T_world_body[i]));
    pose->setId(static_cast<int>(i));
    pose->setFixed(graph.pose_fixed[i] != 0);
    search.graph.addVertex(pose);
    poses.push_back(pose);
  }
  for (std::size_t i = 0; i < graph.from.size(); ++i) {
    auto* const edge = new g2o::EdgeSE3;
    edge->setVertex(0, poses[graph.from[i]]);
    edge->setVertex(1, poses[graph.to[i]]);
    edge->setMeasurement(isometryOf(graph.T_from_to[i]));
    edge->setInformation(informationOf(graph.information[i]));
    search.graph.addEdge(edge);
  }
  search.runAsLongAsItGains();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    graph.T_world_body[i] =
        poseOf(g2o::SE3Quat(poses[i]->estimate().linear(), poses[i]->estimate().translation()));
  }
}

const bool kRows = addGraphRows("g2o", solveGraph, false);

}  // namespace
