// What all implementations are asked: the same names, the same arguments.
#ifndef GSLAM_BENCH_SVAR_PEERS_VALUES_H
#define GSLAM_BENCH_SVAR_PEERS_VALUES_H

#include <allocations.h>
#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <vector>

/// Names as parameters have them.
inline std::vector<std::string> names() {
  std::vector<std::string> made;
  for (const char* part : {"camera", "tracker", "mapper", "loop"}) {
    for (const char* name : {"_width", "_scale", "_levels", "_max_features"}) {
      made.push_back(std::string(part) + name);
    }
  }
  return made;
}

/// Twenty arguments: ten doubles, five integers, five strings, p0 to p19.
inline std::vector<std::string> arguments() {
  std::vector<std::string> made = {"program"};
  for (int i = 0; i < 20; ++i) {
    const std::string value = i < 10 ? "0.5" : i < 15 ? "1000" : "sequence/left.png";
    made.push_back("--p" + std::to_string(i) + "=" + value);
  }
  return made;
}

/// Calls `look(name)` with one name after the other.
template <class Look>
void lookUpEach(benchmark::State& state, Look look) {
  const std::vector<std::string> all = names();
  std::size_t i = 0;
  const gslam_bench::CountAllocations count(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(look(all[i]));
    if (++i == all.size()) i = 0;
  }
}

/// Calls `work()` in each iteration.
template <class Work>
void repeat(benchmark::State& state, Work work) {
  const gslam_bench::CountAllocations count(state);
  for (auto _ : state) benchmark::DoNotOptimize(work());
}

#endif  // GSLAM_BENCH_SVAR_PEERS_VALUES_H
