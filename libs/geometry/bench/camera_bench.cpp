// Cameras: each operation over 4096 points of the image, results stored.
#include <benchmark/benchmark.h>
#include <gslam/geometry/camera.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace {

using gslam::Camera;
using gslam::Vec2d;
using gslam::Vec3d;

constexpr std::size_t kPoints = 4096;

// Real calibrations where there are some.
Camera cameraOf(const std::string& model) {
  if (model == "pinhole") {
    return Camera::fromParameters(model, 1226, 370, {707.0912, 707.0912, 601.8873, 183.1104});
  }
  if (model == "radtan4") {
    return Camera::fromParameters(
        "radtan", 752, 480,
        {458.654, 457.296, 367.215, 248.375, -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05});
  }
  if (model == "radtan8") {
    return Camera::fromParameters(
        "radtan", 640, 480,
        {380, 385, 322.5, 239.1, 0.9, 0.21, 0.0011, -0.0007, 0.012, 1.21, 0.42, 0.041});
  }
  if (model == "kannala_brandt") {
    return Camera::fromParameters(model, 512, 512,
                                  {190.978477, 190.973307, 254.931706, 256.897442, 0.003482389,
                                   0.000715034, -0.00205323, 0.000202936});
  }
  if (model == "fov") {
    return Camera::fromParameters(model, 640, 480, {318, 321, 319.5, 239.5, 0.933});
  }
  if (model == "ocam") {
    return Camera::fromParameters(model, 640, 480,
                                  {326.939156, 261.744395, 1.001968, 0.0014, 0.000113, -325.8881, 0,
                                   8.612196e-04, -3.553896e-08, 6.737619e-09});
  }
  if (model == "double_sphere") {
    return Camera::fromParameters(model, 512, 512,
                                  {158.286, 158.2743, 254.9611, 256.8894, -0.172130, 0.593117});
  }
  if (model == "eucm") {
    return Camera::fromParameters(model, 752, 480,
                                  {460.7648, 459.4051, 365.8937, 249.335, 0.590336, 1.127468});
  }
  if (model == "mei") {
    return Camera::fromParameters(model, 752, 480,
                                  {700, 702, 370, 245, 0.81, -0.19, 0.14, 0.0004, -0.0011});
  }
  return Camera::fromParameters("equirectangular", 1920, 960, {});
}

std::vector<Vec2d> randomPixels(const Camera& camera) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, camera.width() - 1), v(0, camera.height() - 1);
  std::vector<Vec2d> pixels(kPoints);
  for (Vec2d& pixel : pixels) pixel = {u(random), v(random)};
  return pixels;
}

void projectMany(benchmark::State& state, const std::string& model) {
  const Camera camera = cameraOf(model);
  std::vector<Vec2d> pixels = randomPixels(camera);
  std::vector<Vec3d> points(kPoints);
  std::vector<std::uint8_t> is_valid(kPoints);
  (void)camera.unprojectMany(pixels, points, is_valid);
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera.projectMany(points, pixels, is_valid));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPoints));
}

void unprojectMany(benchmark::State& state, const std::string& model) {
  const Camera camera = cameraOf(model);
  const std::vector<Vec2d> pixels = randomPixels(camera);
  std::vector<Vec3d> bearings(kPoints);
  std::vector<std::uint8_t> is_valid(kPoints);
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera.unprojectMany(pixels, bearings, is_valid));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPoints));
}

// One by one, as an optimizer does: with the derivatives by point and parameters.
void projectWithJacobians(benchmark::State& state, const std::string& model) {
  const Camera camera = cameraOf(model);
  const std::vector<Vec2d> pixels = randomPixels(camera);
  std::vector<Vec3d> points(kPoints);
  std::vector<std::uint8_t> is_valid(kPoints);
  (void)camera.unprojectMany(pixels, points, is_valid);
  Vec2d pixel;
  gslam::Mat<double, 2, 3> by_point;
  double by_parameters[2 * 18];
  for (auto _ : state) {
    for (const Vec3d& point : points) {
      benchmark::DoNotOptimize(camera.project(point, pixel, &by_point, by_parameters));
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPoints));
}

void make(benchmark::State& state, const std::string& model) {
  const Camera camera = cameraOf(model);
  const std::string name = camera.modelName();
  const std::vector<double> values = camera.parameters();
  for (auto _ : state) {
    benchmark::DoNotOptimize(Camera::fromParameters(name, 640, 480, values));
  }
}

const bool registered = [] {
  for (const std::string model : {"pinhole", "radtan4", "radtan8", "kannala_brandt", "fov", "ocam",
                                  "double_sphere", "eucm", "mei", "equirectangular"}) {
    benchmark::RegisterBenchmark(("camera_project/gslam/" + model).c_str(), projectMany, model);
    benchmark::RegisterBenchmark(("camera_unproject/gslam/" + model).c_str(), unprojectMany, model);
    benchmark::RegisterBenchmark(("camera_project_jacobians/gslam/" + model).c_str(),
                                 projectWithJacobians, model);
    benchmark::RegisterBenchmark(("camera_make/gslam/" + model).c_str(), make, model);
  }
  return true;
}();

}  // namespace
