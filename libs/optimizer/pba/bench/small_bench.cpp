// What the small problems cost a call: a pose from points with everything (residuals, robust loss,
// covariance, inlier flags), in each variant of SIMD; alignments; two views.
#include <benchmark/benchmark.h>
#include <gslam/base/simd.h>
#include <gslam/geometry/random.h>
#include <gslam/optimizer/alignment_problem.h>
#include <gslam/optimizer/pose_problem.h>
#include <gslam/optimizer/two_view_problem.h>
#include <gslam/optimizer_pba.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "allocations.h"

namespace {

using gslam::Camera;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

Camera benchCamera(const std::string& model) {
  if (model == "radtan") {
    return Camera::fromParameters(model, 640, 480, {500, 510, 320, 240, -0.2, 0.05, 1e-3, -2e-3});
  }
  if (model == "kannala_brandt") {
    return Camera::fromParameters(model, 640, 480, {300, 300, 320, 240, 0.01, -0.02, 3e-3, -1e-3});
  }
  return Camera::fromParameters("pinhole", 640, 480, {500, 510, 320, 240});
}

// Points 2 to 10 m away, 1 pixel of noise; the start is 5 cm and 2 degrees off.
struct SmallScene {
  Camera camera;
  SE3d truth = SE3d(gslam::SO3d::exp({0.4, -0.3, 0.2}), {1, -2, 0.5});
  SE3d start = truth * SE3d::exp({0.03, -0.02, 0.035, 0.02, -0.025, 0.015});
  std::vector<Vec3d> points;
  std::vector<Vec2d> pixels;
  std::vector<std::uint8_t> inliers;

  SmallScene(const std::string& model, std::size_t n, double outliers)
      : camera(benchCamera(model)), inliers(n) {
    std::mt19937_64 generator(n);
    while (points.size() < n) {
      const Vec2d pixel = {gslam::randomUniform(generator, 0.0, 639.0),
                           gslam::randomUniform(generator, 0.0, 479.0)};
      Vec3d bearing{};
      if (!camera.unproject(pixel, bearing)) continue;
      points.push_back(truth * (gslam::randomUniform(generator, 2.0, 10.0) * bearing));
      const bool is_outlier = gslam::randomUniform(generator, 0.0, 1.0) < outliers;
      pixels.push_back(pixel +
                       (is_outlier ? 60.0 : 1.0) * gslam::randomNormal<double, 2>(generator));
    }
  }
};

void benchPose(benchmark::State& state, gslam::Simd variant, const char* model,
               gslam::LossKind loss, double outliers) {
  const gslam::ScopedSimd scoped(variant);
  SmallScene scene(model, static_cast<std::size_t>(state.range(0)), outliers);
  gslam::PoseProblem problem;
  problem.points = scene.points;
  problem.pixels = scene.pixels;
  problem.cameras = {&scene.camera, 1};
  problem.inliers = scene.inliers;
  gslam::OptimizerOptions options;
  options.backend = "pba";
  options.loss = {loss, 2.5};
  std::size_t iterations = 0;
  const gslam_bench::CountAllocations count(state);
  for (auto _ : state) {
    const gslam::OptimizedPose result = gslam::optimizePose(problem, scene.start, options);
    if (!result.is_usable) state.SkipWithError("not usable");
    iterations = result.iterations;
    benchmark::DoNotOptimize(result);
  }
  state.counters["steps"] = static_cast<double>(iterations);
}

void benchAlignment(benchmark::State& state) {
  const std::size_t n = static_cast<std::size_t>(state.range(0));
  SmallScene scene("pinhole", n, 0);
  std::vector<Vec3d> moved;
  std::mt19937_64 generator(1);
  for (const Vec3d& p : scene.points) {
    moved.push_back(scene.truth * p + 0.01 * gslam::randomNormal<double, 3>(generator));
  }
  gslam::AlignmentProblem problem;
  problem.points_b = scene.points;
  problem.points_a = moved;
  gslam::OptimizerOptions options;
  options.backend = "pba";
  for (auto _ : state) {
    benchmark::DoNotOptimize(gslam::optimizeAlignment(problem, scene.start, options));
  }
}

void benchTwoView(benchmark::State& state) {
  const std::size_t n = static_cast<std::size_t>(state.range(0));
  SmallScene scene("pinhole", n, 0);
  const SE3d T(gslam::SO3d::exp({0.02, -0.05, 0.03}), {0.5, 0.05, 0.1});
  std::vector<Vec2d> first(n), second(n);
  std::vector<double> depths(n), now(n);
  std::mt19937_64 generator(1);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d p = scene.truth.inverse() * scene.points[i];
    (void)scene.camera.project(p, first[i]);
    (void)scene.camera.project(T.inverse() * p, second[i]);
    second[i] += 0.5 * gslam::randomNormal<double, 2>(generator);
    depths[i] = gslam::randomUniform(generator, 0.8, 1.25) / p.norm();
  }
  gslam::TwoViewProblem problem;
  problem.first = first;
  problem.second = second;
  problem.first_camera = problem.second_camera = scene.camera;
  problem.inverse_depths = now;
  gslam::OptimizerOptions options;
  options.backend = "pba";
  const SE3d start = T * SE3d::exp({0.01, 0.02, 0, 0.01, 0, 0.01});
  for (auto _ : state) {
    now = depths;
    benchmark::DoNotOptimize(gslam::optimizeTwoView(problem, start, options));
  }
}

const bool small_is_registered = [] {
  struct Case {
    const char* name;
    const char* model;
    gslam::LossKind loss;
    double outliers;
  };
  for (const Case& c :
       {Case{"pinhole", "pinhole", gslam::LossKind::Squared, 0},
        Case{"pinhole_huber", "pinhole", gslam::LossKind::Huber, 0.1},
        Case{"radtan_huber", "radtan", gslam::LossKind::Huber, 0.1},
        Case{"pinhole_cauchy", "pinhole", gslam::LossKind::Cauchy, 0.1},
        Case{"kannala_brandt_huber", "kannala_brandt", gslam::LossKind::Huber, 0.1}}) {
    for (const gslam::Simd variant : gslam::availableSimd()) {
      const std::string name = std::string("pose/") + c.name + "/" + gslam::simdName(variant);
      benchmark::RegisterBenchmark(name.c_str(), benchPose, variant, c.model, c.loss, c.outliers)
          ->Arg(50)
          ->Arg(200)
          ->Arg(1000)
          ->Unit(benchmark::kMicrosecond);
    }
  }
  benchmark::RegisterBenchmark("alignment/points", benchAlignment)
      ->Arg(100)
      ->Arg(10000)
      ->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("two_view", benchTwoView)
      ->Arg(100)
      ->Arg(1000)
      ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
