// How long the figures of a million poses take, and how fast trajectories are read.
#include <benchmark/benchmark.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/evaluation.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr std::size_t kPoses = 1000000;

gslam::Trajectory makeTrajectory(double noise) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<gslam::StampedPose> poses;
  poses.reserve(kPoses);
  for (std::size_t i = 0; i < kPoses; ++i) {
    const double t = 0.005 * double(i);
    const gslam::Vec3d place = {
        {8 * std::sin(0.31 * t), 5 * std::cos(0.23 * t) + 0.2 * t, std::sin(0.17 * t)}};
    gslam::SE3d::Tangent d;
    for (std::size_t k = 0; k < 6; ++k) d[k] = noise * normal(random);
    poses.push_back({std::int64_t(i) * 5000000,
                     gslam::SE3d(gslam::SO3d::exp({{0, 0.1 * std::sin(t), 0.4 * t}}), place) *
                         gslam::SE3d::exp(d)});
  }
  return gslam::Trajectory(std::move(poses));
}

const gslam::Trajectory& reference() {
  static const gslam::Trajectory made = makeTrajectory(0);
  return made;
}

const gslam::Trajectory& estimate() {
  static const gslam::Trajectory made = makeTrajectory(0.02);
  return made;
}

const gslam::PosePairs& pairs() {
  static const gslam::PosePairs made = gslam::pairPoses(reference(), estimate());
  return made;
}

void countPoses(benchmark::State& state) {
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(kPoses));
}

void pairPoses(benchmark::State& state, const char* method) {
  gslam::AssociationOptions how;
  how.method = gslam::associationMethod(method);
  (void)estimate();
  (void)reference();
  for (auto _ : state) benchmark::DoNotOptimize(gslam::pairPoses(reference(), estimate(), how));
  countPoses(state);
}
BENCHMARK_CAPTURE(pairPoses, one_to_one, "one-to-one")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pairPoses, interpolate, "interpolate")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pairPoses, evo, "evo")->Unit(benchmark::kMillisecond);

// From pairs to statistics.
void ape(benchmark::State& state) {
  (void)pairs();
  for (auto _ : state) {
    const gslam::Alignment alignment = gslam::align(pairs());
    benchmark::DoNotOptimize(statisticsOf(gslam::absoluteErrors(pairs(), alignment.S_world_map)));
  }
  countPoses(state);
}
BENCHMARK(ape)->Unit(benchmark::kMillisecond);

void rpe(benchmark::State& state, const char* text) {
  (void)pairs();
  const gslam::RpeOptions options = gslam::parseRpe(text);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        statisticsOf(gslam::relativeErrors(pairs(), gslam::rangesOf(pairs(), options))));
  }
  countPoses(state);
}
BENCHMARK_CAPTURE(rpe, frames, "1f")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rpe, metres, "5m:all")->Unit(benchmark::kMillisecond);

void score(benchmark::State& state, bool has_scale) {
  (void)reference();
  (void)estimate();
  gslam::ScoreOptions options;
  options.has_scale = has_scale;
  for (auto _ : state) benchmark::DoNotOptimize(gslam::scoreOf(reference(), estimate(), options));
  countPoses(state);
}
BENCHMARK_CAPTURE(score, se3, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(score, sim3, true)->Unit(benchmark::kMillisecond);

// All that `gslam eval --rpe 1f` does but for the files.
void evaluate(benchmark::State& state) {
  (void)reference();
  (void)estimate();
  gslam::EvaluationOptions options;
  options.rpe = {gslam::parseRpe("1f")};
  for (auto _ : state) benchmark::DoNotOptimize(gslam::evaluate(reference(), estimate(), options));
  countPoses(state);
}
BENCHMARK(evaluate)->Unit(benchmark::kMillisecond);

void parseTum(benchmark::State& state) {
  const std::string text = gslam::printTrajectory(estimate());
  for (auto _ : state) benchmark::DoNotOptimize(gslam::parseTrajectory(text, "text"));
  countPoses(state);
}
BENCHMARK(parseTum)->Unit(benchmark::kMillisecond);

}  // namespace
