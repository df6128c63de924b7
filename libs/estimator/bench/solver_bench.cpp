// What solvers of n points cost as n grows. Minimal solvers, and other implementations, are
// measured by bench/estimator_peers.
#include <benchmark/benchmark.h>
#include <gslam/estimator/solvers.h>
#include <gslam/geometry/random.h>

#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace {

using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

// Points 2 to 10 units before two cameras that are one unit apart.
struct Views {
  SE3d T_second_first;
  std::vector<Vec3d> points, first, second, origins;
  std::vector<Vec2d> first_plane, second_plane;

  explicit Views(std::size_t n) {
    std::mt19937_64 generator(n);
    T_second_first = SE3d(gslam::SO3d::exp({0.1, -0.2, 0.05}), {0.8, 0.1, 0.2});
    for (std::size_t i = 0; i < n; ++i) {
      const double depth = gslam::randomUniform(generator, 2.0, 10.0);
      points.push_back({gslam::randomUniform(generator, -0.6, 0.6) * depth,
                        gslam::randomUniform(generator, -0.6, 0.6) * depth, depth});
      const Vec3d in_second = T_second_first * points.back();
      first.push_back(points.back().normalized());
      second.push_back(in_second.normalized());
      origins.push_back({0, 0, 0});
      first_plane.push_back({points.back()[0] / depth, points.back()[1] / depth});
      second_plane.push_back({in_second[0] / in_second[2], in_second[1] / in_second[2]});
    }
  }
};

// Items are points.
template <class Solve>
void measure(benchmark::State& state, const Solve& solve) {
  const Views views(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    const std::size_t count = solve(views);
    benchmark::DoNotOptimize(count);
    if (count == 0) state.SkipWithError("no solution");
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void fundamental8pt(benchmark::State& state) {
  measure(state, [](const Views& views) {
    gslam::Mat3d f;
    return gslam::fundamental8pt(views.first_plane, views.second_plane, f);
  });
}

void essential8pt(benchmark::State& state) {
  measure(state, [](const Views& views) {
    gslam::Mat3d e;
    return gslam::essential8pt(views.first, views.second, e);
  });
}

void homographyDlt(benchmark::State& state) {
  measure(state, [](const Views& views) {
    gslam::Mat3d h;
    return gslam::homographyDlt(views.first_plane, views.first_plane, h);
  });
}

void sqpnp(benchmark::State& state) {
  measure(state, [](const Views& views) {
    std::array<SE3d, 4> poses;
    return gslam::sqpnp(views.second, views.points, poses);
  });
}

void epnp(benchmark::State& state) {
  measure(state, [](const Views& views) {
    SE3d pose;
    return gslam::epnp(views.second, views.points, pose);
  });
}

void gpnp(benchmark::State& state) {
  measure(state, [](const Views& views) {
    std::array<SE3d, 4> poses;
    return gslam::gpnp(views.origins, views.second, views.points, poses);
  });
}

void similarity3D(benchmark::State& state) {
  measure(state, [](const Views& views) {
    gslam::SIM3d similarity;
    return gslam::similarity3D(views.points, views.points, similarity);
  });
}

void planeFromPoints(benchmark::State& state) {
  measure(state, [](const Views& views) {
    gslam::Vec4d plane;
    return gslam::planeFromPoints(views.points, plane);
  });
}

constexpr int kFew = 10, kMany = 10000, kStep = 10;
BENCHMARK(fundamental8pt)->RangeMultiplier(kStep)->Range(kFew, kMany);
BENCHMARK(essential8pt)->RangeMultiplier(kStep)->Range(kFew, kMany);
BENCHMARK(homographyDlt)->RangeMultiplier(kStep)->Range(kFew, kMany);
BENCHMARK(sqpnp)->RangeMultiplier(kStep)->Range(kFew, kMany);
BENCHMARK(epnp)->RangeMultiplier(kStep)->Range(kFew, kMany);
BENCHMARK(gpnp)->RangeMultiplier(kStep)->Range(kFew, kMany);
BENCHMARK(similarity3D)->RangeMultiplier(kStep)->Range(kFew, kMany);
BENCHMARK(planeFromPoints)->RangeMultiplier(kStep)->Range(kFew, kMany);

}  // namespace
