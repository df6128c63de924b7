// Pose graphs of GSLAM_TEST_DATA to convergence, from the chordal start, which is part of the time.
#include <benchmark/benchmark.h>
#include <gslam/optimizer/files/g2o.h>
#include <gslam/optimizer/initialize_poses.h>
#include <gslam/optimizer_pba.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <variant>

namespace {

using gslam::PoseGraphResidual;

struct GraphCase {
  std::string file;
  PoseGraphResidual residual;
  unsigned threads;
};

template <class Group>
void runGraph(benchmark::State& state, const gslam::PoseGraph<Group>& graph,
              const GraphCase& what) {
  using Clock = std::chrono::steady_clock;
  gslam::OptimizerOptions options;
  options.backend = "pba";
  options.threads = what.threads;
  double start_seconds = 0;
  gslam::OptimizerSummary summary;
  for (auto _ : state) {
    state.PauseTiming();
    gslam::PoseGraph<Group> copy = graph;
    const auto problem = copy.problem(what.residual);
    state.ResumeTiming();
    const Clock::time_point begin = Clock::now();
    gslam::initializePoses(problem);
    start_seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    summary = gslam::optimizePoseGraph(problem, options);
  }
  if (!summary.hasConverged()) state.SkipWithError(summary.message.c_str());
  state.counters["start_ms"] = 1e3 * start_seconds / static_cast<double>(state.iterations());
  state.counters["steps"] = static_cast<double>(summary.iterations.size()) - 1;
  state.counters["sum"] = 2 * summary.final_cost;  // as SE-Sync and g2o count
}

void benchGraph(benchmark::State& state, const GraphCase& what) {
  const gslam::AnyPoseGraph graph = gslam::readG2o(what.file);
  std::visit([&](const auto& kind) { runGraph(state, kind, what); }, graph);
}

const bool graphs_are_registered = [] {
  const char* const data = std::getenv("GSLAM_TEST_DATA");
  if (data == nullptr) return false;
  for (const std::string name : {"sphere2500", "parking-garage", "smallGrid3D", "INTEL", "M3500"}) {
    const std::string file = std::string(data) + "/pose_graphs/" + name + ".g2o";
    std::FILE* const found = std::fopen(file.c_str(), "r");
    if (found == nullptr) continue;
    std::fclose(found);
    for (const PoseGraphResidual residual :
         {PoseGraphResidual::Chordal, PoseGraphResidual::Quaternion}) {
      for (const unsigned threads : {1u, 2u}) {
        const std::string title = "pose_graph/" + name +
                                  (residual == PoseGraphResidual::Chordal ? "/F/" : "/G/") +
                                  std::to_string(threads);
        benchmark::RegisterBenchmark(title.c_str(), benchGraph, GraphCase{file, residual, threads})
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
  return true;
}();

}  // namespace
