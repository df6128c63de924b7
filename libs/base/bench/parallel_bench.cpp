// What a parallel loop, a task, a log line and the choice of a SIMD variant cost.
#include <benchmark/benchmark.h>
#include <gslam/base.h>

#include <cmath>
#include <vector>

namespace {

void loop(benchmark::State& state, unsigned threads) {
  std::vector<double> values(1 << 18, 2.0);
  gslam::ParallelOptions options;
  options.grain = 4096;
  options.threads = threads;
  for (auto _ : state) {
    gslam::parallelFor(
        0, values.size(), [&values](std::size_t i) { values[i] = std::sqrt(values[i] + 1.0); },
        options);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(values.size()));
}
BENCHMARK_CAPTURE(loop, one_thread, 1)->UseRealTime()->Name("sqrt_loop/gslam_1_thread");
BENCHMARK_CAPTURE(loop, all_threads, 0)->UseRealTime()->Name("sqrt_loop/gslam");

void plainLoop(benchmark::State& state) {
  std::vector<double> values(1 << 18, 2.0);
  for (auto _ : state) {
    for (double& value : values) value = std::sqrt(value + 1.0);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(values.size()));
}
BENCHMARK(plainLoop)->UseRealTime()->Name("sqrt_loop/plain");

void emptyLoop(benchmark::State& state) {
  for (auto _ : state) gslam::parallelFor(0, 2, [](std::size_t i) { benchmark::DoNotOptimize(i); });
}
BENCHMARK(emptyLoop)->UseRealTime()->Name("start_of_a_loop/gslam");

void submit(benchmark::State& state) {
  gslam::ThreadPool pool(1);
  for (auto _ : state) pool.submit([] {}).get();
}
BENCHMARK(submit)->UseRealTime()->Name("submit_and_wait/gslam");

void logOff(benchmark::State& state) {
  for (auto _ : state) GSLAM_LOG(info) << "not evaluated " << state.iterations();
}
BENCHMARK(logOff)->Name("log_line_that_is_off/gslam");

void activeSimd(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(gslam::activeSimd());
}
BENCHMARK(activeSimd)->Name("active_simd/gslam");

}  // namespace
