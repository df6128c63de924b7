// What the standard library has for it.
#include <atomic>
#include <functional>
#include <unordered_map>

#include "values.h"

namespace {

void lookUp(benchmark::State& state) {
  std::unordered_map<std::string, double> value;
  for (const std::string& name : names()) value[name] = 1.5;
  lookUpEach(state, [&](const std::string& name) {
    benchmark::DoNotOptimize(value);
    return value.find(name)->second;
  });
}
BENCHMARK(lookUp)->Name("lookup_by_name/std");

void readAtomic(benchmark::State& state) {
  std::atomic<double> variable(1.5);
  repeat(state, [&] { return variable.load(std::memory_order_acquire); });
}
BENCHMARK(readAtomic)->Name("read_bound/std");

void call(benchmark::State& state) {
  std::function<int(int, int)> function = [](int a, int b) { return a + b; };
  int a = 0;
  repeat(state, [&] {
    benchmark::DoNotOptimize(function);
    return function(++a, 2);
  });
}
BENCHMARK(call)->Name("call_int_int_int/std");

}  // namespace
