// One measurement for all: an operation over 1024 random elements, results stored.
#ifndef GSLAM_BENCH_GEOMETRY_PEERS_ROTATIONS_H
#define GSLAM_BENCH_GEOMETRY_PEERS_ROTATIONS_H

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

/// Rotation vectors, evenly distributed in the ball of radius pi.
inline std::vector<std::array<double, 3>> rotationVectors(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-3.14159, 3.14159);
  std::vector<std::array<double, 3>> vectors;
  while (vectors.size() < 1024) {
    const std::array<double, 3> v = {uniform(random), uniform(random), uniform(random)};
    if (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] < 3.14159 * 3.14159) vectors.push_back(v);
  }
  return vectors;
}

/// What one library calls these things.
/// @tparam Group  has types Rotation and Vector, and static functions vector(x, y, z), exp, log,
///                inverse, mult and act
template <class Group>
class Rotations {
 public:
  using Rotation = typename Group::Rotation;
  using Vector = typename Group::Vector;

  Rotations() : a_(rotations(1)), b_(rotations(2)), v_(vectors(3)) {}

  void mult(benchmark::State& state) const {
    measure<Rotation>(state, [this](std::size_t i) { return Group::mult(a_[i], b_[i]); });
  }
  void act(benchmark::State& state) const {
    measure<Vector>(state, [this](std::size_t i) { return Group::act(a_[i], v_[i]); });
  }
  void exp(benchmark::State& state) const {
    measure<Rotation>(state, [this](std::size_t i) { return Group::exp(v_[i]); });
  }
  void log(benchmark::State& state) const {
    measure<Vector>(state, [this](std::size_t i) { return Group::log(a_[i]); });
  }
  void inverse(benchmark::State& state) const {
    measure<Rotation>(state, [this](std::size_t i) { return Group::inverse(a_[i]); });
  }

 private:
  static std::vector<Vector> vectors(unsigned seed) {
    std::vector<Vector> result;
    for (const auto& v : rotationVectors(seed)) result.push_back(Group::vector(v[0], v[1], v[2]));
    return result;
  }
  static std::vector<Rotation> rotations(unsigned seed) {
    std::vector<Rotation> result;
    for (const Vector& v : vectors(seed)) result.push_back(Group::exp(v));
    return result;
  }

  template <class Result, class Operation>
  static void measure(benchmark::State& state, const Operation& operation) {
    std::vector<Result> results(1024);
    for (auto _ : state) {
      for (std::size_t i = 0; i < results.size(); ++i) results[i] = operation(i);
      benchmark::DoNotOptimize(results.data());
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(results.size()));
  }

  std::vector<Rotation> a_, b_;
  std::vector<Vector> v_;
};

template <class Group, void (Rotations<Group>::*operation)(benchmark::State&) const>
void rotation(benchmark::State& state) {
  static const Rotations<Group> rotations;
  (rotations.*operation)(state);
}

#define PEER(Group, name)                                                               \
  BENCHMARK_TEMPLATE(rotation, Group, &Rotations<Group>::mult)->Name("so3_mult/" name); \
  BENCHMARK_TEMPLATE(rotation, Group, &Rotations<Group>::act)->Name("so3_act/" name);   \
  BENCHMARK_TEMPLATE(rotation, Group, &Rotations<Group>::exp)->Name("so3_exp/" name);   \
  BENCHMARK_TEMPLATE(rotation, Group, &Rotations<Group>::log)->Name("so3_log/" name);   \
  BENCHMARK_TEMPLATE(rotation, Group, &Rotations<Group>::inverse)->Name("so3_inverse/" name)

#endif  // GSLAM_BENCH_GEOMETRY_PEERS_ROTATIONS_H
