// A pose graph whose loops are partly wrong.
#include <gslam/geometry/random.h>
#include <gslam/optimizer.h>
#include <gslam/optimizer_pba.h>

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

int main() {
  // Three times around a circle; every pose sees the one a round earlier.
  std::mt19937 generator(7);
  const auto off = [&](double reach) { return gslam::randomUniform(generator, -reach, reach); };
  const auto noise = [&](double reach) {
    return gslam::SE3d::exp(
        {off(reach), off(reach), off(reach), off(reach), off(reach), off(reach)});
  };
  const gslam::SE3d step = gslam::SE3d::exp({1, 0, 0, 0, 0, 2 * 3.14159265358979 / 40});
  gslam::PoseGraph<gslam::SE3d> graph;
  std::vector<gslam::SE3d> truth = {gslam::SE3d()};
  for (std::size_t i = 1; i < 120; ++i) truth.push_back(truth.back() * step);
  const auto add = [&](std::size_t from, std::size_t to, const gslam::SE3d& error) {
    graph.from.push_back(static_cast<std::uint32_t>(from));
    graph.to.push_back(static_cast<std::uint32_t>(to));
    graph.T_from_to.push_back(truth[from].inverse() * truth[to] * error);
    graph.is_robust.push_back(to != from + 1);
    graph.information.push_back(1e4 * gslam::SE3d::Jacobian::identity());
  };
  for (std::size_t i = 0; i + 1 < 120; ++i) add(i, i + 1, noise(0.01));
  for (std::size_t i = 0; i + 40 < 120; i += 2) add(i, i + 40, noise(i % 20 == 0 ? 3 : 0.01));
  graph.T_world_body = truth;

  gslam::OptimizerOptions options;
  options.loss = {gslam::LossKind::GemanMcClure, 5};
  initializePoses(graph.problem(), gslam::PoseInitialization::SpanningTree);
  const gslam::OptimizerSummary summary = optimizePoseGraph(graph.problem(), options);
  std::cout << fullReport(summary);
  const double error = (graph.T_world_body[119].translation() - truth[119].translation()).norm();
  std::cout << "error at the end: " << error << " m\n";
  return summary.is_usable && error < 0.5 ? 0 : 1;
}
