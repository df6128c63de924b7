// What all sides of the comparison of cameras work on: EuRoC's left camera and TUM-VI's fisheye.
#ifndef GSLAM_BENCH_GEOMETRY_PEERS_CAMERA_DATA_H
#define GSLAM_BENCH_GEOMETRY_PEERS_CAMERA_DATA_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace camera_data {

constexpr std::size_t kPoints = 4096;
constexpr int kWidth = 752, kHeight = 480;

constexpr std::array<double, 4> kRadtanFocal = {458.654, 457.296, 367.215, 248.375};
constexpr std::array<double, 4> kRadtan = {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05};
constexpr std::array<double, 4> kFisheyeFocal = {190.97847715128717, 190.9733070521226,
                                                 254.93170605935475, 256.8974428996504};
constexpr std::array<double, 4> kFisheye = {0.0034823894022493434, 0.0007150348452162257,
                                            -0.0020532361418706202, 0.00020293673591811182};

/// Points in front of the camera, which EuRoC's sees in its image.
inline std::vector<std::array<double, 3>> points() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-0.8, 0.8), y(-0.5, 0.5), depth(0.5, 20);
  std::vector<std::array<double, 3>> result(kPoints);
  for (auto& p : result) {
    const double z = depth(random);
    p = {x(random) * z, y(random) * z, z};
  }
  return result;
}

/// Pixels of an image of this size.
inline std::vector<std::array<double, 2>> pixels(double width, double height) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0, width - 1), v(0, height - 1);
  std::vector<std::array<double, 2>> result(kPoints);
  for (auto& p : result) p = {u(random), v(random)};
  return result;
}

inline std::vector<std::uint8_t> image(std::size_t channels) {
  std::mt19937 random(3);
  std::vector<std::uint8_t> result(std::size_t(kWidth) * std::size_t(kHeight) * channels);
  for (auto& value : result) value = static_cast<std::uint8_t>(random());
  return result;
}

}  // namespace camera_data

#endif  // GSLAM_BENCH_GEOMETRY_PEERS_CAMERA_DATA_H
