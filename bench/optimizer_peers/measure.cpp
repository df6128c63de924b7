#include "measure.h"

#include <benchmark/benchmark.h>
#include <gslam/optimizer_pba.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <string>
#include <utility>

namespace {

using Clock = std::chrono::steady_clock;
using GetBundle = const BundleArrays& (*)();

bool isSlow() {
  return std::getenv("GSLAM_PEERS_SLOW") != nullptr;
}

template <synthetic_bundle::Shape (*shape)()>
const BundleArrays& synthetic() {
  static const BundleArrays arrays = make(shape());
  return arrays;
}

double peakMegabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.compare(0, 6, "VmHWM:") == 0) return std::strtod(line.c_str() + 6, nullptr) / 1024;
  }
  return 0;
}

// The lowest cost of a row, found once.
double lowestCost(const std::string& row, GetBundle bundle) {
  static std::map<std::string, double> known;
  const auto found = known.find(row);
  if (found != known.end()) return found->second;
  BundleArrays arrays = bundle();
  gslam::OptimizerOptions options;
  options.backend = "pba";
  options.threads = kThreads;
  options.max_iterations = 100;
  options.function_tolerance = 1e-9;
  options.linear_tolerance = 1e-3;
  return known[row] = optimizeBundle(arrays.problem(), options).final_cost;
}

double secondsTo(const Course& course, double cost) {
  for (std::size_t i = 0; i < course.costs.size(); ++i) {
    if (course.costs[i] <= cost) return course.seconds[i];
  }
  return 0;
}

// Of all threads of the program.
double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// One call of a peer.
struct Solved {
  BundleArrays arrays;
  Course course;
  double cpu_seconds;

  Solved(const BundleArrays& start, SolveBundle solve, std::size_t iterations)
      : arrays(start), cpu_seconds(-cpuSeconds()) {
    course = solve(arrays, iterations);
    cpu_seconds += cpuSeconds();
  }
};

// Nobody shall measure a solver that does nothing, or something else; empty: all is well.
std::string complaint(double start, double lowest, double claimed, double found) {
  if (!(std::abs(claimed - found) < 0.01 * found)) {
    return "the cost is " + std::to_string(found) + ", not " + std::to_string(claimed);
  }
  if (!(start - found > 0.98 * (start - lowest))) {
    return "the cost is " + std::to_string(found) + ", far from " + std::to_string(lowest);
  }
  return "";
}

double startCost(GetBundle bundle) {
  BundleArrays start = bundle();
  return bundleCost(start.problem());
}

void bundleRow(benchmark::State& state, const std::string& row, GetBundle bundle,
               SolveBundle solve) {
  if (bundle().T_world_body.empty()) {
    state.SkipWithError("GSLAM_TEST_DATA names no folder");
    return;
  }
  double cpu_seconds = 0, cpu_steps = 0, claimed = 0, found = 0;
  std::size_t steps = 0;
  for (auto _ : state) {
    {
      const Solved first(bundle(), solve, 1);
      cpu_seconds -= first.cpu_seconds;
      cpu_steps -= double(first.course.iterations());
    }
    Solved all(bundle(), solve, 10);
    cpu_seconds += all.cpu_seconds;
    cpu_steps += double(all.course.iterations());
    steps += all.course.iterations();
    state.SetIterationTime(all.course.seconds.back() - all.course.seconds.front());
    claimed = all.course.costs.back();
    found = bundleCost(all.arrays.problem());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(steps));
  const double start = startCost(bundle);
  state.counters["start_cost"] = start;
  state.counters["cost"] = found;
  state.counters["cpu_ms"] = 1e3 * cpu_seconds / cpu_steps;
  state.counters["peak_mb"] = peakMegabytes();
  const double lowest = lowestCost(row, bundle);
  const std::string wrong = complaint(start, lowest, claimed, found);
  if (!wrong.empty()) state.SkipWithError(wrong.c_str());
  if (!isSlow()) return;
  const Course course = Solved(bundle(), solve, 50).course;
  state.counters["to_1_percent_s"] = secondsTo(course, 1.01 * lowest);
  state.counters["to_0.1_percent_s"] = secondsTo(course, 1.001 * lowest);
}

// The lowest cost of a graph, found once.
double lowestCost(const std::string& file, gslam::PoseGraphResidual residual) {
  static std::map<std::pair<std::string, gslam::PoseGraphResidual>, double> known;
  const auto found = known.find({file, residual});
  if (found != known.end()) return found->second;
  gslam::PoseGraph<gslam::SE3d> graph = realGraph(file);
  gslam::OptimizerOptions options;
  options.backend = "pba";
  options.function_tolerance = 1e-9;
  const double cost = optimizePoseGraph(graph.problem(residual), options).final_cost;
  return known[{file, residual}] = cost;
}

void graphRow(benchmark::State& state, const std::string& file, gslam::PoseGraphResidual residual,
              SolveGraph solve) {
  if (realGraph(file).T_world_body.empty()) {
    state.SkipWithError("GSLAM_TEST_DATA names no folder");
    return;
  }
  gslam::PoseGraph<gslam::SE3d> graph = realGraph(file);
  state.counters["start_cost"] = poseGraphCost(graph.problem(residual));
  double cost = 0, cpu_seconds = 0;
  for (auto _ : state) {
    graph = realGraph(file);
    const double cpu_start = cpuSeconds();
    const Clock::time_point start = Clock::now();
    solve(graph, residual);
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count());
    cpu_seconds += cpuSeconds() - cpu_start;
    cost = poseGraphCost(graph.problem(residual));
  }
  state.counters["cost"] = cost;
  state.counters["cpu_ms"] = 1e3 * cpu_seconds / double(state.iterations());
  const double lowest = lowestCost(file, residual);
  if (!(cost < 1.01 * lowest)) {
    const std::string wrong =
        "the cost is " + std::to_string(cost) + ", far from " + std::to_string(lowest);
    state.SkipWithError(wrong.c_str());
  }
}

}  // namespace

bool addBundleRows(const char* peer, SolveBundle solve) {
  const auto add = [=](const std::string& row, GetBundle bundle) {
    benchmark::RegisterBenchmark(
        (row + "/" + peer).c_str(),
        [=](benchmark::State& state) { bundleRow(state, row, bundle, solve); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  };
  add("ba_49_7776", realBundle);
  add("ba_ladybug", synthetic<synthetic_bundle::ladybug>);
  add("ba_trafalgar", synthetic<synthetic_bundle::trafalgar>);
  if (isSlow()) add("ba_venice", synthetic<synthetic_bundle::venice>);
  add("local_ba", synthetic<synthetic_bundle::local>);
  return true;
}

bool addPoseRows(const char* peer, SolvePose solve) {
  for (const std::size_t points : {50u, 200u, 1000u}) {
    benchmark::RegisterBenchmark(("pose_" + std::to_string(points) + "/" + peer).c_str(),
                                 [=](benchmark::State& state) {
                                   const PoseScene scene = poseScene(points);
                                   const double error =
                                       (scene.truth.inverse() * solve(scene)).log().norm();
                                   if (!(error < 0.02)) state.SkipWithError("far from the truth");
                                   for (auto _ : state) benchmark::DoNotOptimize(solve(scene));
                                 })
        ->Unit(benchmark::kMicrosecond);
  }
  return true;
}

bool addGraphRows(const char* peer, SolveGraph solve, bool has_chordal) {
  using gslam::PoseGraphResidual;
  for (const char* const file : {"sphere2500", "parking-garage"}) {
    for (const auto residual : {PoseGraphResidual::Chordal, PoseGraphResidual::Quaternion}) {
      if (residual == PoseGraphResidual::Chordal && !has_chordal) continue;
      const std::string suffix = residual == PoseGraphResidual::Chordal ? "_f/" : "_g/";
      benchmark::RegisterBenchmark(
          (file + suffix + peer).c_str(),
          [=](benchmark::State& state) { graphRow(state, file, residual, solve); })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}
