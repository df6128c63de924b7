// Bundle adjustment of synthetic bundles with the counts of well-known sets: time of an iteration,
// time until the cost is within 1 % and 0.1 % of the best, memory. Peers are measured by
// bench/optimizer_peers.
#include <benchmark/benchmark.h>
#include <gslam/optimizer.h>
#include <gslam/optimizer_pba.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

#include "synthetic_bundle.h"

namespace {

using gslam::OptimizerOptions;
using gslam::OptimizerSummary;

// Megabytes of a line of /proc/self/status, such as VmHWM; 0 where there is none.
double megabytes(const char* name) {
  std::FILE* const file = std::fopen("/proc/self/status", "r");
  if (file == nullptr) return 0;
  char line[256];
  double found = 0;
  while (std::fgets(line, sizeof(line), file) != nullptr) {
    if (std::strncmp(line, name, std::strlen(name)) == 0) {
      found = std::atof(line + std::strlen(name) + 1) / 1024;
    }
  }
  std::fclose(file);
  return found;
}

// Seconds until the cost is at most `factor` times the last one, with what came before the loop.
double secondsTo(const OptimizerSummary& summary, double factor) {
  for (const gslam::OptimizerIteration& iteration : summary.iterations) {
    if (iteration.cost <= factor * summary.final_cost) return iteration.seconds;
  }
  return summary.times.total;
}

OptimizerOptions optionsOf(const benchmark::State& state) {
  OptimizerOptions options;
  options.backend = "pba";
  options.threads = static_cast<unsigned>(state.range(0));
  options.max_iterations = 12;
  options.function_tolerance = 1e-5;
  return options;
}

void measure(benchmark::State& state, const synthetic_bundle::Shape& shape,
             OptimizerOptions options) {
  const synthetic_bundle::Arrays start = synthetic_bundle::make(shape);
  OptimizerSummary summary;
  double least = 1e300, least_cpu = 1e300;
  std::clock_t first_cpu = 0, last_cpu = 0;
  options.progress = [&](const gslam::OptimizerIteration& iteration) {
    last_cpu = std::clock();
    if (iteration.number == 0) first_cpu = last_cpu;
    return true;
  };
  double before = 0;
  for (auto _ : state) {
    state.PauseTiming();
    synthetic_bundle::Arrays arrays = start;
    const gslam::BundleProblem problem = arrays.problem();
    if (before == 0) before = megabytes("VmRSS:");
    state.ResumeTiming();
    summary = gslam::optimizeBundle(problem, options);
    const double iterations = static_cast<double>(summary.iterations.size()) - 1;
    const double seconds = summary.iterations.back().seconds - summary.iterations[0].seconds;
    least = std::min(least, 1e3 * seconds / iterations);
    least_cpu =
        std::min(least_cpu, 1e3 * double(last_cpu - first_cpu) / (CLOCKS_PER_SEC * iterations));
  }
  const double peak = megabytes("VmHWM:");
  state.SetLabel(summary.linear_solver);
  state.counters["ms_iteration"] = least;
  state.counters["cpu_ms_iteration"] = least_cpu;
  state.counters["s_to_1%"] = secondsTo(summary, 1.01);
  state.counters["s_to_0.1%"] = secondsTo(summary, 1.001);
  state.counters["peak_MB"] = peak;
  state.counters["state_B_obs"] =
      (peak - before) * 1048576 / static_cast<double>(start.pixels.size());
  state.counters["cost"] = summary.final_cost;
}

void localBundle(benchmark::State& state) {
  measure(state, synthetic_bundle::local(), optionsOf(state));
}
void ladybugLike(benchmark::State& state) {
  measure(state, synthetic_bundle::ladybug(), optionsOf(state));
}
void trafalgarLike(benchmark::State& state) {
  measure(state, synthetic_bundle::trafalgar(), optionsOf(state));
}
void veniceLike(benchmark::State& state) {
  measure(state, synthetic_bundle::venice(), optionsOf(state));
}
void ladybugLikeDouble(benchmark::State& state) {
  OptimizerOptions options = optionsOf(state);
  options.precision = gslam::PrecisionKind::Double;
  measure(state, synthetic_bundle::ladybug(), options);
}
void ladybugLikeImplicit(benchmark::State& state) {
  OptimizerOptions options = optionsOf(state);
  options.schur = gslam::SchurKind::Implicit;
  measure(state, synthetic_bundle::ladybug(), options);
}

// The argument is the number of threads. Memory is the peak of the whole process, with the problem
// twice: for peak_MB and state_B_obs choose one benchmark with --benchmark_filter.
BENCHMARK(localBundle)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ladybugLike)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ladybugLikeDouble)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ladybugLikeImplicit)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(trafalgarLike)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(veniceLike)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

}  // namespace
