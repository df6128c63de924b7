#include <benchmark/benchmark.h>
#include <gslam/geometry/undistort.h>

#include "camera_data.h"

namespace {

using gslam::Camera;
using gslam::Vec2d;
using gslam::Vec3d;
using namespace camera_data;  // NOLINT(google-build-using-namespace)

Camera make(const char* model, int width, int height, const std::array<double, 4>& focal,
            const std::array<double, 4>& rest) {
  std::vector<double> values(focal.begin(), focal.end());
  values.insert(values.end(), rest.begin(), rest.end());
  return Camera::fromParameters(model, width, height, values);
}
Camera radtan() {
  return make("radtan", kWidth, kHeight, kRadtanFocal, kRadtan);
}
Camera fisheye() {
  return make("kannala_brandt", 512, 512, kFisheyeFocal, kFisheye);
}

void project(benchmark::State& state, const Camera& camera) {
  std::vector<Vec3d> points;
  for (const auto& p : camera_data::points()) points.push_back({p[0], p[1], p[2]});
  std::vector<Vec2d> pixels(kPoints);
  std::vector<std::uint8_t> is_valid(kPoints);
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera.projectMany(points, pixels, is_valid));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPoints));
}
BENCHMARK_CAPTURE(project, radtan, radtan())->Name("camera_project_radtan/gslam");
BENCHMARK_CAPTURE(project, fisheye, fisheye())->Name("camera_project_fisheye/gslam");

void projectJacobians(benchmark::State& state, const Camera& camera) {
  std::vector<Vec3d> points;
  for (const auto& p : camera_data::points()) points.push_back({p[0], p[1], p[2]});
  std::vector<Vec2d> pixels(kPoints);
  std::vector<gslam::Mat<double, 2, 3>> by_point(kPoints);
  std::vector<double> by_parameters(kPoints * 2 * camera.parameterCount());
  for (auto _ : state) {
    for (std::size_t i = 0; i < kPoints; ++i) {
      (void)camera.project(points[i], pixels[i], &by_point[i],
                           by_parameters.data() + i * 2 * camera.parameterCount());
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPoints));
}
BENCHMARK_CAPTURE(projectJacobians, radtan, radtan())->Name("camera_jacobians_radtan/gslam");

void unproject(benchmark::State& state, const Camera& camera) {
  std::vector<Vec2d> pixels;
  for (const auto& p : camera_data::pixels(camera.width(), camera.height())) {
    pixels.push_back({p[0], p[1]});
  }
  std::vector<Vec3d> bearings(kPoints);
  std::vector<std::uint8_t> is_valid(kPoints);
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera.unprojectMany(pixels, bearings, is_valid));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPoints));
}
BENCHMARK_CAPTURE(unproject, radtan, radtan())->Name("camera_unproject_radtan/gslam");
BENCHMARK_CAPTURE(unproject, fisheye, fisheye())->Name("camera_unproject_fisheye/gslam");

void undistort(benchmark::State& state) {
  const Camera source = radtan();
  const Camera target = Camera::fromParameters("pinhole", kWidth, kHeight,
                                               {kRadtanFocal.begin(), kRadtanFocal.end()});
  const gslam::Undistorter undistorter(source, target);
  const int channels = static_cast<int>(state.range(0));
  const std::vector<std::uint8_t> in = image(static_cast<std::size_t>(channels));
  std::vector<std::uint8_t> out(in.size());
  gslam::ParallelOptions one;
  one.threads = 1;
  for (auto _ : state) {
    undistorter.apply(
        gslam::ImageSpan<const std::uint8_t>::dense(in.data(), kWidth, kHeight, channels),
        gslam::ImageSpan<std::uint8_t>::dense(out.data(), kWidth, kHeight, channels),
        std::uint8_t(0), one);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kWidth * kHeight);
}
BENCHMARK(undistort)->Name("camera_undistort/gslam")->Arg(1)->Arg(3)->Arg(4);

}  // namespace
