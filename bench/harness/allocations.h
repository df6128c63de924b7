#ifndef GSLAM_BENCH_HARNESS_ALLOCATIONS_H
#define GSLAM_BENCH_HARNESS_ALLOCATIONS_H

#include <benchmark/benchmark.h>

#include <cstddef>

namespace gslam_bench {

/// Calls of operator new in the whole program until now.
std::size_t allocations();

/// Reports the counter `allocs`, allocations an iteration, over its life.
///
///     for (auto _ : state) ...   with  CountAllocations count(state);  before the loop
class CountAllocations {
 public:
  explicit CountAllocations(benchmark::State& state) : state_(state), before_(allocations()) {}
  ~CountAllocations() {
    state_.counters["allocs"] = benchmark::Counter(static_cast<double>(allocations() - before_) /
                                                   static_cast<double>(state_.iterations()));
  }
  CountAllocations(const CountAllocations&) = delete;
  CountAllocations& operator=(const CountAllocations&) = delete;

 private:
  benchmark::State& state_;
  std::size_t before_;
};

}  // namespace gslam_bench

#endif  // GSLAM_BENCH_HARNESS_ALLOCATIONS_H
