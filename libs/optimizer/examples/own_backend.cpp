// A back end of one's own. It need not solve everything: what is left empty is asked of others.
#include <gslam/optimizer.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <vector>

namespace {

// Takes each pose in turn to the mean of where its edges say that it is. Slow, and in ten lines.
double relax(const gslam::PoseGraphProblem<gslam::SE2d>& problem, std::size_t pose) {
  gslam::SE2d::Tangent sum{};
  double count = 0;
  const gslam::SE2d now = problem.T_world_body[pose];
  for (std::size_t i = 0; i < problem.from.size(); ++i) {
    const gslam::SE2d& edge = problem.T_from_to[i];
    const bool is_end = problem.to[i] == pose;
    if (!is_end && problem.from[i] != pose) continue;
    const gslam::SE2d said = is_end ? problem.T_world_body[problem.from[i]] * edge
                                    : problem.T_world_body[problem.to[i]] * edge.inverse();
    sum += (now.inverse() * said).log();
    ++count;
  }
  if (count > 0) problem.T_world_body[pose] = now * gslam::SE2d::exp((1 / count) * sum);
  return count > 0 ? sum.norm() / count : 0;
}

gslam::OptimizerSummary relaxAll(const gslam::PoseGraphProblem<gslam::SE2d>& problem,
                                 const gslam::OptimizerOptions& options) {
  gslam::OptimizerSummary summary;
  summary.linear_solver = "none";
  summary.initial_cost = poseGraphCost(problem, options.loss);
  summary.status = gslam::OptimizerStatus::MaxIterations;
  summary.message = "Some pose still moves.";
  const std::vector<gslam::SE2d> start(problem.T_world_body.begin(), problem.T_world_body.end());
  for (std::size_t i = 0; i < 100 * options.max_iterations; ++i) {
    double change = 0;
    for (std::size_t pose = 1; pose < problem.T_world_body.size(); ++pose) {
      change += relax(problem, pose);
    }
    if (change < options.parameter_tolerance) {
      summary.status = gslam::OptimizerStatus::Converged;
      summary.message = "No pose moves any more.";
      break;
    }
  }
  summary.final_cost = poseGraphCost(problem, options.loss);
  summary.is_usable = summary.final_cost <= summary.initial_cost;
  if (!summary.is_usable) {  // what was given stays
    std::copy(start.begin(), start.end(), problem.T_world_body.begin());
    summary.status = gslam::OptimizerStatus::Failed;
    summary.final_cost = summary.initial_cost;
  }
  return summary;
}

}  // namespace

int main() {
  gslam::OptimizerBackend backend;
  backend.name = "relaxation";
  backend.pose_graph_2d = relaxAll;
  gslam::registerOptimizerBackend(backend);

  // Once around a square, with a turn that was measured wrong.
  gslam::PoseGraph<gslam::SE2d> graph;
  for (std::uint32_t i = 0; i < 4; ++i) {
    graph.T_world_body.push_back(i == 0 ? gslam::SE2d()
                                        : graph.T_world_body.back() * graph.T_from_to.back());
    graph.from.push_back(i);
    graph.to.push_back((i + 1) % 4);
    graph.T_from_to.emplace_back(gslam::SO2d::fromAngle(i == 2 ? 1.5 : 1.5707963),
                                 gslam::Vec2d{1, 0});
  }
  gslam::OptimizerOptions options;
  options.backend = "relaxation";
  const gslam::OptimizerSummary summary = optimizePoseGraph(graph.problem(), options);
  std::cout << briefReport(summary) << "\n";
  return summary.hasConverged() && summary.final_cost < 0.01 ? 0 : 1;
}
