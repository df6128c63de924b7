// Rotations: each operation over 1024 random elements, results stored.
#include <benchmark/benchmark.h>
#include <gslam/geometry.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace {

using gslam::SO3;
using gslam::Vec;

constexpr std::size_t kElements = 1024;

// Evenly distributed in the ball of radius pi: rotation vectors, and as good as any other points.
template <class T>
std::vector<Vec<T, 3>> randomVectors(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> coordinate(-3.14159265, 3.14159265);
  std::vector<Vec<T, 3>> vectors;
  while (vectors.size() < kElements) {
    Vec<T, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = static_cast<T>(coordinate(generator));
    if (v.norm() < T(3.14159265)) vectors.push_back(v);
  }
  return vectors;
}

template <class T>
std::vector<SO3<T>> randomRotations(unsigned seed) {
  std::vector<SO3<T>> rotations;
  for (const Vec<T, 3>& v : randomVectors<T>(seed)) rotations.push_back(SO3<T>::exp(v));
  return rotations;
}

// results[i] = operation(i) for all i; the compiler must take results as read after each round, and
// whatever lies in memory as changed before the next.
template <class Result, class Operation>
void measure(benchmark::State& state, const Operation& operation) {
  std::vector<Result> results(kElements);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kElements; ++i) results[i] = operation(i);
    benchmark::DoNotOptimize(results.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kElements));
}

template <class T>
void multiply(benchmark::State& state) {
  std::vector<SO3<T>> a = randomRotations<T>(1), b = randomRotations<T>(2);
  benchmark::DoNotOptimize(a.data());
  benchmark::DoNotOptimize(b.data());
  measure<SO3<T>>(state, [&](std::size_t i) { return a[i] * b[i]; });
}
BENCHMARK_TEMPLATE(multiply, double)->Name("so3_mult/gslam/double");
BENCHMARK_TEMPLATE(multiply, float)->Name("so3_mult/gslam/float");

template <class T>
void act(benchmark::State& state) {
  std::vector<SO3<T>> a = randomRotations<T>(1);
  std::vector<Vec<T, 3>> points = randomVectors<T>(2);
  benchmark::DoNotOptimize(a.data());
  benchmark::DoNotOptimize(points.data());
  measure<Vec<T, 3>>(state, [&](std::size_t i) { return a[i] * points[i]; });
}
BENCHMARK_TEMPLATE(act, double)->Name("so3_act/gslam/double");
BENCHMARK_TEMPLATE(act, float)->Name("so3_act/gslam/float");

template <class T>
void exponential(benchmark::State& state) {
  std::vector<Vec<T, 3>> tangents = randomVectors<T>(1);
  benchmark::DoNotOptimize(tangents.data());
  measure<SO3<T>>(state, [&](std::size_t i) { return SO3<T>::exp(tangents[i]); });
}
BENCHMARK_TEMPLATE(exponential, double)->Name("so3_exp/gslam/double");
BENCHMARK_TEMPLATE(exponential, float)->Name("so3_exp/gslam/float");

template <class T>
void logarithm(benchmark::State& state) {
  std::vector<SO3<T>> a = randomRotations<T>(1);
  benchmark::DoNotOptimize(a.data());
  measure<Vec<T, 3>>(state, [&](std::size_t i) { return a[i].log(); });
}
BENCHMARK_TEMPLATE(logarithm, double)->Name("so3_log/gslam/double");
BENCHMARK_TEMPLATE(logarithm, float)->Name("so3_log/gslam/float");

template <class T>
void invert(benchmark::State& state) {
  std::vector<SO3<T>> a = randomRotations<T>(1);
  benchmark::DoNotOptimize(a.data());
  measure<SO3<T>>(state, [&](std::size_t i) { return a[i].inverse(); });
}
BENCHMARK_TEMPLATE(invert, double)->Name("so3_inverse/gslam/double");
BENCHMARK_TEMPLATE(invert, float)->Name("so3_inverse/gslam/float");

}  // namespace
