// Each operation of each group over 1024 random elements, results stored.
#include <benchmark/benchmark.h>
#include <gslam/geometry.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace {

using gslam::SE3;
using gslam::SIM3;
using gslam::SO3;
using gslam::Vec;

constexpr std::size_t kElements = 1024;

// Evenly distributed in the ball of radius pi: rotation vectors, and as good as any other points.
template <class T>
Vec<T, 3> randomVector(std::mt19937& generator) {
  std::uniform_real_distribution<double> coordinate(-3.14159265, 3.14159265);
  Vec<T, 3> v;
  do {
    for (std::size_t i = 0; i < 3; ++i) v[i] = static_cast<T>(coordinate(generator));
  } while (v.norm() >= T(3.14159265));
  return v;
}

template <class G>
std::vector<typename G::Tangent> randomTangents(unsigned seed) {
  using T = typename G::Scalar;
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<typename G::Tangent> tangents(kElements);
  for (typename G::Tangent& a : tangents) {
    for (std::size_t i = 0; i < G::kFreedom; ++i) a[i] = static_cast<T>(normal(generator));
    if (G::kFreedom == 7) a[6] *= T(0.3);
    const Vec<T, 3> v = randomVector<T>(generator);
    const std::size_t turn = G::kFreedom == 3 ? 0 : 3;
    for (std::size_t i = 0; i < 3; ++i) a[turn + i] = v[i];
  }
  benchmark::DoNotOptimize(tangents.data());
  return tangents;
}

template <class G>
std::vector<G> randomElements(unsigned seed) {
  std::vector<G> elements;
  for (const typename G::Tangent& a : randomTangents<G>(seed)) elements.push_back(G::exp(a));
  benchmark::DoNotOptimize(elements.data());
  return elements;
}

template <class T>
std::vector<Vec<T, 3>> randomPoints(unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<Vec<T, 3>> points;
  for (std::size_t i = 0; i < kElements; ++i) points.push_back(randomVector<T>(generator));
  benchmark::DoNotOptimize(points.data());
  return points;
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

template <class G>
void multiply(benchmark::State& state) {
  const std::vector<G> a = randomElements<G>(1), b = randomElements<G>(2);
  measure<G>(state, [&](std::size_t i) { return a[i] * b[i]; });
}

template <class G>
void act(benchmark::State& state) {
  const std::vector<G> a = randomElements<G>(1);
  const auto points = randomPoints<typename G::Scalar>(2);
  measure<typename G::Point>(state, [&](std::size_t i) { return a[i] * points[i]; });
}

template <class G>
void exponential(benchmark::State& state) {
  const auto tangents = randomTangents<G>(1);
  measure<G>(state, [&](std::size_t i) { return G::exp(tangents[i]); });
}

template <class G>
void logarithm(benchmark::State& state) {
  const std::vector<G> a = randomElements<G>(1);
  measure<typename G::Tangent>(state, [&](std::size_t i) { return a[i].log(); });
}

template <class G>
void invert(benchmark::State& state) {
  const std::vector<G> a = randomElements<G>(1);
  measure<G>(state, [&](std::size_t i) { return a[i].inverse(); });
}

template <class G>
void leftJacobian(benchmark::State& state) {
  const auto tangents = randomTangents<G>(1);
  measure<typename G::Jacobian>(state, [&](std::size_t i) { return G::leftJacobian(tangents[i]); });
}

template <class G>
void leftJacobianInverse(benchmark::State& state) {
  const auto tangents = randomTangents<G>(1);
  measure<typename G::Jacobian>(state,
                                [&](std::size_t i) { return G::leftJacobianInverse(tangents[i]); });
}

#define GSLAM_BENCH_GROUP(name, Group, scalar)                                            \
  BENCHMARK_TEMPLATE(multiply, Group<scalar>)->Name(name "_mult/gslam/" #scalar);         \
  BENCHMARK_TEMPLATE(act, Group<scalar>)->Name(name "_trans/gslam/" #scalar);             \
  BENCHMARK_TEMPLATE(exponential, Group<scalar>)->Name(name "_exp/gslam/" #scalar);       \
  BENCHMARK_TEMPLATE(logarithm, Group<scalar>)->Name(name "_log/gslam/" #scalar);         \
  BENCHMARK_TEMPLATE(invert, Group<scalar>)->Name(name "_inverse/gslam/" #scalar);        \
  BENCHMARK_TEMPLATE(leftJacobian, Group<scalar>)->Name(name "_jacobian/gslam/" #scalar); \
  BENCHMARK_TEMPLATE(leftJacobianInverse, Group<scalar>)                                  \
      ->Name(name "_jacobian_inverse/gslam/" #scalar)

GSLAM_BENCH_GROUP("so3", SO3, double);
GSLAM_BENCH_GROUP("so3", SO3, float);
GSLAM_BENCH_GROUP("se3", SE3, double);
GSLAM_BENCH_GROUP("se3", SE3, float);
GSLAM_BENCH_GROUP("sim3", SIM3, double);
GSLAM_BENCH_GROUP("sim3", SIM3, float);

}  // namespace
