// The pose of a camera with g2o's own types and a Huber loss.
#include <benchmark/benchmark.h>
#include <g2o/core/block_solver.h>
#include <g2o/core/robust_kernel_impl.h>
#include <g2o/solvers/dense/linear_solver_dense.h>
#include <g2o/types/sba/types_six_dof_expmap.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "g2o_search.h"
#include "measure.h"

namespace {

g2o::EdgeSE3ProjectXYZOnlyPose* observation(const PoseScene& scene, std::size_t i,
                                            const std::vector<double>& intrinsics) {
  auto* const edge = new g2o::EdgeSE3ProjectXYZOnlyPose;
  edge->Xw = {scene.points[i][0], scene.points[i][1], scene.points[i][2]};
  edge->fx = intrinsics[0];
  edge->fy = intrinsics[1];
  edge->cx = intrinsics[2];
  edge->cy = intrinsics[3];
  edge->setMeasurement({scene.pixels[i][0], scene.pixels[i][1]});
  edge->setInformation(g2o::Matrix2::Identity());
  auto* const loss = new g2o::RobustKernelHuber;
  loss->setDelta(2);
  edge->setRobustKernel(loss);
  return edge;
}

gslam::SE3d solvePose(const PoseScene& scene) {
  using Blocks = g2o::BlockSolver_6_3;
  G2oSearch<Blocks, g2o::LinearSolverDense> search(
      std::make_unique<g2o::LinearSolverDense<Blocks::PoseMatrixType>>());
  auto* const pose = new g2o::VertexSE3Expmap;
  pose->setEstimate(quatOf(scene.start.inverse()));
  pose->setId(0);
  search.graph.addVertex(pose);
  const std::vector<double> intrinsics = scene.cameras[0].parameters();
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    g2o::EdgeSE3ProjectXYZOnlyPose* const edge = observation(scene, i, intrinsics);
    edge->setVertex(0, pose);
    search.graph.addEdge(edge);
  }
  search.runAsLongAsItGains();
  // A covariance, as the others give it.
  const Eigen::Matrix<double, 6, 6> covariance = pose->A().inverse();
  benchmark::DoNotOptimize(covariance.data());
  return poseOf(pose->estimate()).inverse();
}

const bool kRows = addPoseRows("g2o", solvePose);

}  // namespace
