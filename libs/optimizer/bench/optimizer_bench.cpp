// What the facade costs: checks, reference costs, the way to a back end, files. What back ends cost
// is measured in their folders and in bench/optimizer_peers.
#include <benchmark/benchmark.h>
#include <gslam/optimizer.h>
#include <gslam/optimizer/files.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "allocations.h"

namespace {

using gslam::SE3d;
using gslam::SO3d;

// A street that is driven along once; each point is seen from five places in a row.
gslam::Bundle street(std::size_t points) {
  gslam::Bundle bundle;
  const std::size_t poses = points / 500 + 10;
  for (std::size_t i = 0; i < poses; ++i) {
    bundle.T_world_body.emplace_back(SO3d(), gslam::Vec3d{static_cast<double>(i), 0, 0});
    bundle.cameras.push_back(gslam::Camera::fromParameters(
        "radtan", 640, 480, {500, 500, 319.5, 239.5, -0.01, 0.001, 0, 0}));
  }
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t first = i * (poses - 5) / points;
    bundle.points.push_back(
        {static_cast<double>(first) + 2, 0.01 * static_cast<double>(i % 100), 6});
    for (std::size_t k = 0; k < 5; ++k) {
      gslam::Vec2d pixel;
      bundle.cameras[0].project(bundle.T_world_body[first + k].inverse() * bundle.points.back(),
                                pixel);
      bundle.observation_pose.push_back(static_cast<std::uint32_t>(first + k));
      bundle.observation_camera.push_back(static_cast<std::uint32_t>(first + k));
      bundle.observation_point.push_back(static_cast<std::uint32_t>(i));
      bundle.pixels.push_back(pixel);
    }
  }
  return bundle;
}

void checkBundleRow(benchmark::State& state) {
  gslam::Bundle bundle = street(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(checkBundle(bundle.problem()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bundle.pixels.size()));
}
BENCHMARK(checkBundleRow)->Name("check_bundle")->Arg(1000)->Arg(100000)->Arg(1000000);

void bundleCostRow(benchmark::State& state) {
  gslam::Bundle bundle = street(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(bundleCost(bundle.problem()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bundle.pixels.size()));
}
BENCHMARK(bundleCostRow)->Name("bundle_cost")->Arg(1000)->Arg(100000);

gslam::PoseGraph<SE3d> circle(std::size_t poses) {
  gslam::PoseGraph<SE3d> graph;
  const SE3d step = SE3d::exp({1, 0, 0, 0, 0, 0.01});
  graph.T_world_body.resize(poses);
  const auto connect = [&](std::size_t from, std::size_t to) {
    graph.from.push_back(static_cast<std::uint32_t>(from));
    graph.to.push_back(static_cast<std::uint32_t>(to));
    graph.T_from_to.push_back(graph.T_world_body[from].inverse() * graph.T_world_body[to]);
    graph.information.push_back(100 * SE3d::Jacobian::identity());
  };
  for (std::size_t i = 1; i < poses; ++i) {
    graph.T_world_body[i] = graph.T_world_body[i - 1] * step;
    connect(i - 1, i);
    if (i >= 50) connect(i - 50, i);
  }
  return graph;
}

void checkPoseGraphRow(benchmark::State& state) {
  gslam::PoseGraph<SE3d> graph = circle(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(checkPoseGraph(graph.problem()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(graph.from.size()));
}
BENCHMARK(checkPoseGraphRow)->Name("check_pose_graph")->Arg(2500)->Arg(100000);

void poseGraphCostRow(benchmark::State& state) {
  gslam::PoseGraph<SE3d> graph = circle(2500);
  for (auto _ : state) benchmark::DoNotOptimize(poseGraphCost(graph.problem()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(graph.from.size()));
}
BENCHMARK(poseGraphCostRow)->Name("pose_graph_cost");

// The way to a back end that does nothing, checks included.
void dispatchRow(benchmark::State& state) {
  gslam::OptimizerBackend idle;
  idle.name = "idle";
  idle.pose = [](const gslam::PoseProblem&, const SE3d& start, const gslam::OptimizerOptions&) {
    gslam::OptimizedPose result;
    result.T_world_body = start;
    return result;
  };
  gslam::registerOptimizerBackend(idle);
  const std::size_t n = static_cast<std::size_t>(state.range(0));
  const std::vector<gslam::Vec3d> points(n, {0, 0, 5});
  const std::vector<gslam::Vec2d> pixels(n, {320, 240});
  const std::vector<gslam::Camera> cameras = {
      gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5})};
  gslam::PoseProblem problem;
  problem.points = points;
  problem.pixels = pixels;
  problem.cameras = cameras;
  gslam::OptimizerOptions options;
  options.backend = "idle";
  gslam_bench::CountAllocations count(state);
  for (auto _ : state) benchmark::DoNotOptimize(optimizePose(problem, SE3d(), options));
}
BENCHMARK(dispatchRow)->Name("dispatch_pose")->Arg(3)->Arg(50)->Arg(1000);

std::string balText() {
  const std::string path = "optimizer_bench_bal.txt";
  writeBal(street(10000), path);
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::remove(path.c_str());
  return text.str();
}

void parseBalRow(benchmark::State& state) {
  const std::string text = balText();
  for (auto _ : state) benchmark::DoNotOptimize(gslam::parseBal(text, "bench"));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(parseBalRow)->Name("parse_bal")->Unit(benchmark::kMillisecond);

void parseG2oRow(benchmark::State& state) {
  const std::string path = "optimizer_bench_graph.g2o";
  writeG2o(circle(10000), path);
  std::ostringstream file;
  file << std::ifstream(path).rdbuf();
  std::remove(path.c_str());
  const std::string text = file.str();
  for (auto _ : state) benchmark::DoNotOptimize(gslam::parseG2o(text, "bench"));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(parseG2oRow)->Name("parse_g2o")->Unit(benchmark::kMillisecond);

}  // namespace
