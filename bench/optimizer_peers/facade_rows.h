// The rows of a back end of the facade.
#ifndef GSLAM_BENCH_OPTIMIZER_PEERS_FACADE_ROWS_H
#define GSLAM_BENCH_OPTIMIZER_PEERS_FACADE_ROWS_H

#include <gslam/optimizer.h>

#include <cstddef>

#include "measure.h"

/// What a facade's back end did.
inline Course courseOf(const gslam::OptimizerSummary& summary) {
  Course course;
  for (const gslam::OptimizerIteration& one : summary.iterations) course.add(one.cost, one.seconds);
  return course;
}

/// @tparam Name  has a static `text`: the back end's
template <class Name>
struct FacadeRows {
  static gslam::OptimizerOptions options() {
    gslam::OptimizerOptions options;
    options.backend = Name::text;
    return options;
  }
  static Course bundle(BundleArrays& arrays, std::size_t iterations) {
    gslam::OptimizerOptions all = options();
    all.threads = arrays.points.size() > 2000 ? kThreads : 1;
    all.max_iterations = iterations;
    all.function_tolerance = all.gradient_tolerance = all.parameter_tolerance = 0;
    return courseOf(optimizeBundle(arrays.problem(), all));
  }
  static gslam::SE3d pose(const PoseScene& scene) {
    gslam::PoseProblem problem;
    problem.points = scene.points;
    problem.pixels = scene.pixels;
    problem.cameras = scene.cameras;
    static const gslam::OptimizerOptions all = [] {
      gslam::OptimizerOptions huber = options();
      huber.loss = {gslam::LossKind::Huber, 2};
      return huber;
    }();
    return optimizePose(problem, scene.start, all).T_world_body;
  }
  static void graph(gslam::PoseGraph<gslam::SE3d>& graph, gslam::PoseGraphResidual residual) {
    gslam::OptimizerOptions all = options();
    all.threads = kThreads;
    optimizePoseGraph(graph.problem(residual), all);
  }
  static bool add(const char* peer, bool with_pose) {
    addBundleRows(peer, bundle);
    addGraphRows(peer, graph);
    return with_pose ? addPoseRows(peer, pose) : true;
  }
};

#endif  // GSLAM_BENCH_OPTIMIZER_PEERS_FACADE_ROWS_H
