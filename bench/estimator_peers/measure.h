// One measurement for all. What a solver finds is compared with the truth before any time is taken:
// `lost` is the percentage of instances without a solution within 1e-6 of the truth, `p999` the
// error that one in a thousand exceeds, `median` that of the middle one.
#ifndef GSLAM_BENCH_ESTIMATOR_PEERS_MEASURE_H
#define GSLAM_BENCH_ESTIMATOR_PEERS_MEASURE_H

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "instances.h"

using Models = std::vector<Numbers>;

/// How far a model is from the truth; infinite for NaN.
using Distance = double (*)(const Numbers& model, const Numbers& truth);

/// @{
/// As parts of the truth's size; matrices whose scale and sign are free; poses.
double plainDistance(const Numbers& model, const Numbers& truth);
double scaleFreeDistance(const Numbers& model, const Numbers& truth);
double poseDistance(const Numbers& model, const Numbers& truth);
/// @}

/// Sets the counters of a row from the errors of all instances.
void reportErrors(benchmark::State& state, std::vector<double> errors);

/// Registers `row/peer` before main().
/// @tparam Solver  one way to solve an Instance:
///   - `Input prepare(const Instance&)`: what it wants, which is not measured
///   - `Output`, which is used again and again
///   - `void solve(const Input&, Output&)`: overwrites the output
///   - `Models models(const Output&)`, to be compared
template <class Solver>
bool addSolver(const char* row, const char* peer, const Instances& (*instances)(),
               Distance distance) {
  benchmark::RegisterBenchmark(
      (std::string(row) + "/" + peer).c_str(), [=](benchmark::State& state) {
        using Input = decltype(Solver::prepare(Instance()));
        std::vector<Input> inputs;
        std::vector<double> errors;
        typename Solver::Output output{};
        for (const Instance& instance : instances()) {
          const Input input = Solver::prepare(instance);
          Solver::solve(input, output);
          double error = std::numeric_limits<double>::infinity();
          for (const Numbers& model : Solver::models(output)) {
            error = std::min(error, distance(model, instance.truth));
          }
          errors.push_back(error);
          if (inputs.size() < 1024) inputs.push_back(input);
        }
        for (auto _ : state) {
          for (const Input& input : inputs) {
            Solver::solve(input, output);
            benchmark::DoNotOptimize(output);
          }
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(inputs.size()));
        reportErrors(state, std::move(errors));
      });
  return true;
}

/// What a robust function found in one scene.
struct Found {
  Numbers model;  ///< rotation matrix and translation, or a matrix; empty: it says that it failed
  Numbers other;  ///< a second one, where it reports two
};

/// Whether a model is right, and its error in degrees or pixels.
struct Verdict {
  bool is_right;
  double error;
};
using Judge = Verdict (*)(const Numbers& model, const Scene& scene);

/// @{
/// Within 1 degree of rotation and 5 of the direction of translation; within 1 degree and 20 cm; of
/// nine in ten points that both cameras see, less than 3 px from where they should be or, of F,
/// from their epipolar line. The errors are degrees of rotation, and pixels.
Verdict judgeRelativePose(const Numbers& model, const Scene& scene);
Verdict judgeAbsolutePose(const Numbers& model, const Scene& scene);
Verdict judgeHomography(const Numbers& model, const Scene& scene);
Verdict judgeFundamental(const Numbers& model, const Scene& scene);
/// @}

/// Sets the counters `right` (per cent), `wrong` (per cent that claim success and are not right),
/// `median_ms` and `median_error`.
void reportVerdicts(benchmark::State& state, const std::vector<Scene>& all,
                    const std::vector<Found>& found, std::vector<double> seconds, Judge judge);

/// Registers `row/peer`: a robust function on 100 scenes.
/// @tparam Robust  `Input prepare(const Scene&)` and `Found run(const Input&)`
template <class Robust>
bool addRobust(const char* row, const char* peer, SceneKind kind, std::size_t n, double outliers,
               Judge judge) {
  benchmark::RegisterBenchmark((std::string(row) + "/" + peer).c_str(), [=](benchmark::State&
                                                                                state) {
    using Input = decltype(Robust::prepare(Scene()));
    using Clock = std::chrono::steady_clock;
    const std::vector<Scene>& all = scenes(kind, n, outliers);
    std::vector<Input> inputs;
    for (const Scene& scene : all) inputs.push_back(Robust::prepare(scene));
    std::vector<Found> found;
    std::vector<double> seconds;
    for (const Input& input : inputs) {
      const Clock::time_point begin = Clock::now();
      found.push_back(Robust::run(input));
      seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    }
    for (auto _ : state) {
      for (const Input& input : inputs) benchmark::DoNotOptimize(Robust::run(input));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(inputs.size()));
    reportVerdicts(state, all, found, std::move(seconds), judge);
  })->Unit(benchmark::kMillisecond);
  return true;
}

/// What all robust functions are asked for.
constexpr double kThreshold = 3;  // pixels
constexpr double kConfidence = 0.999;
constexpr std::size_t kIterations = 10000;  // at most

/// Registers the rows of the robust functions of one implementation.
template <class RelativePose, class Fundamental, class Homography, class AbsolutePose>
bool addRobustRows(const char* peer) {
  using Kind = SceneKind;
  addRobust<RelativePose>("e_200_50", peer, Kind::TwoViews, 200, 0.5, judgeRelativePose);
  addRobust<RelativePose>("e_2000_50", peer, Kind::TwoViews, 2000, 0.5, judgeRelativePose);
  addRobust<RelativePose>("e_200_70", peer, Kind::TwoViews, 200, 0.7, judgeRelativePose);
  addRobust<RelativePose>("e_200_90", peer, Kind::TwoViews, 200, 0.9, judgeRelativePose);
  addRobust<RelativePose>("e_planar_30", peer, Kind::TwoViewsOfPlane, 200, 0.3, judgeRelativePose);
  addRobust<AbsolutePose>("pnp_200_50", peer, Kind::Points, 200, 0.5, judgeAbsolutePose);
  addRobust<AbsolutePose>("pnp_200_90", peer, Kind::Points, 200, 0.9, judgeAbsolutePose);
  addRobust<Homography>("h_200_50", peer, Kind::TwoViewsOfPlane, 200, 0.5, judgeHomography);
  return addRobust<Fundamental>("f_2000_50", peer, Kind::TwoViews, 2000, 0.5, judgeFundamental);
}

#endif  // GSLAM_BENCH_ESTIMATOR_PEERS_MEASURE_H
