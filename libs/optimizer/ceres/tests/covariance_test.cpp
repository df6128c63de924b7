#include <gslam/optimizer_ceres.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"

namespace {

using gslam::BundleCovariance;
using gslam::BundleProblem;
using gslam::Camera;
using gslam::CameraFreedom;
using gslam::Mat3d;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;
using scenes::Bundle;

// The inverse by Gauss and Jordan, in long double.
std::vector<std::vector<long double>> inverseOf(std::vector<std::vector<long double>> m) {
  const std::size_t n = m.size();
  for (std::size_t r = 0; r < n; ++r) {
    m[r].resize(2 * n, 0);
    m[r][n + r] = 1;
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t r = k; r < n; ++r) {
      if (std::fabs(m[r][k]) > std::fabs(m[best][k])) best = r;
    }
    std::swap(m[k], m[best]);
    const long double pivot = m[k][k];
    for (long double& value : m[k]) value /= pivot;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == k) continue;
      const long double factor = m[r][k];
      for (std::size_t c = 0; c < 2 * n; ++c) m[r][c] -= factor * m[k][c];
    }
  }
  for (auto& row : m) row.erase(row.begin(), row.begin() + std::ptrdiff_t(n));
  return m;
}

// Three poses, the first one fixed; a camera whose focal length is free; points.
struct Scene {
  Bundle bundle = Bundle::make(3, 8, {scenes::radtan()}, {}, 1);
  std::vector<std::uint8_t> fixed = {1, 0, 0};
  std::vector<CameraFreedom> freedom = {{0b110001, true}};
  gslam::PositionPrior prior = {1, bundle.poses[1].translation(), 1e4 * Mat3d::identity()};

  BundleProblem problem() {
    BundleProblem views = bundle.problem();
    views.pose_fixed = fixed;
    views.camera_freedom = freedom;
    views.position_priors = {&prior, 1};
    return views;
  }

  // All whitened residuals after a step of 2 x 6, 8 x 3, 3 numbers.
  std::vector<double> residuals(const std::vector<double>& step) const {
    std::vector<SE3d> poses = bundle.poses;
    for (std::size_t i = 0; i < 2; ++i) {
      SE3d::Tangent tangent;
      for (std::size_t k = 0; k < 6; ++k) tangent[k] = step[6 * i + k];
      poses[1 + i] *= SE3d::exp(tangent);
    }
    std::vector<double> values = bundle.cameras[0].parameters();
    const double aspect = values[1] / values[0];
    values[0] += step[36];
    values[1] = aspect * values[0];
    values[4] += step[37];
    values[5] += step[38];
    const Camera camera = Camera::fromParameters("radtan", 640, 480, values);
    std::vector<double> result;
    for (std::size_t o = 0; o < bundle.pixels.size(); ++o) {
      const std::size_t j = bundle.observation_point[o];
      const Vec3d point =
          bundle.points[j] + Vec3d{step[12 + 3 * j], step[13 + 3 * j], step[14 + 3 * j]};
      Vec2d pixel{};
      EXPECT_TRUE(camera.project(poses[bundle.observation_pose[o]].inverse() * point, pixel));
      result.push_back(pixel[0] - bundle.pixels[o][0]);
      result.push_back(pixel[1] - bundle.pixels[o][1]);
    }
    const Vec3d off = 100.0 * (poses[1].translation() - prior.position);
    for (const double value : off.values) result.push_back(value);
    return result;
  }

  std::vector<std::vector<long double>> covariance() const {
    constexpr std::size_t n = 39;
    std::vector<std::vector<double>> columns;
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<double> step(n, 0.0);
      const double h = i == 36 ? 1e-3 : 1e-5;
      step[i] = h;
      std::vector<double> column = residuals(step);
      step[i] = -h;
      const std::vector<double> before = residuals(step);
      for (std::size_t r = 0; r < column.size(); ++r) column[r] = (column[r] - before[r]) / (2 * h);
      columns.push_back(column);
    }
    std::vector<std::vector<long double>> normal(n, std::vector<long double>(n, 0));
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        for (std::size_t r = 0; r < columns[a].size(); ++r) {
          normal[a][b] += static_cast<long double>(columns[a][r]) * columns[b][r];
        }
      }
    }
    return inverseOf(normal);
  }
};

// Relative to the variances.
void expectNear(const std::vector<std::vector<long double>>& expected, std::size_t first,
                const double* actual, std::size_t size) {
  for (std::size_t r = 0; r < size; ++r) {
    for (std::size_t c = 0; c < size; ++c) {
      const double unit =
          std::sqrt(double(expected[first + r][first + r] * expected[first + c][first + c]));
      EXPECT_NEAR(double(expected[first + r][first + c]) / unit, actual[r * size + c] / unit, 1e-4)
          << first << ": " << r << " " << c;
    }
  }
}

TEST(covariance, is_the_inverse_of_dense_normal_equations) {
  Scene scene;
  const std::vector<std::uint32_t> poses = {2, 0, 1}, points = {4, 0}, cameras = {0};
  const BundleCovariance found =
      gslam::ceresBackend().bundle_covariance(scene.problem(), poses, points, cameras, {});
  ASSERT_TRUE(found.is_valid) << found.message;
  const auto expected = scene.covariance();
  ASSERT_EQ(3u, found.poses.size());
  expectNear(expected, 6, found.poses[0].data(), 6);
  expectNear(expected, 0, found.poses[2].data(), 6);
  EXPECT_EQ((gslam::Mat<double, 6, 6>{}), found.poses[1]);
  ASSERT_EQ(2u, found.points.size());
  expectNear(expected, 12 + 3 * 4, found.points[0].data(), 3);
  expectNear(expected, 12, found.points[1].data(), 3);
  ASSERT_EQ(1u, found.cameras.size());
  ASSERT_EQ(9u, found.cameras[0].size());
  expectNear(expected, 36, found.cameras[0].data(), 3);
}

TEST(covariance, of_a_camera_that_shares_its_block_with_a_pose) {
  Scene scene;
  Scene separate;
  // The same camera thrice: those of fixed and free poses are blocks of different kinds.
  scene.bundle.cameras.assign(3, scene.bundle.cameras[0]);
  scene.freedom.assign(3, {0b1, true});
  separate.freedom.assign(3, {0b1, true});
  separate.bundle.cameras = scene.bundle.cameras;
  for (std::size_t o = 0; o < scene.bundle.pixels.size(); ++o) {
    scene.bundle.observation_camera[o] = scene.bundle.observation_pose[o];
    separate.bundle.observation_camera[o] = scene.bundle.observation_pose[o];
  }
  // An observation by another pose, with no weight, parts pose and camera.
  BundleProblem problem = separate.problem();
  std::vector<Vec3d> information(separate.bundle.pixels.size() + 2, Vec3d{1, 0, 1});
  for (std::size_t k = 0; k < 2; ++k) {
    separate.bundle.observation_pose.push_back(0);
    separate.bundle.observation_camera.push_back(static_cast<std::uint32_t>(1 + k));
    separate.bundle.observation_point.push_back(0);
    separate.bundle.pixels.push_back(separate.bundle.pixels[0]);
    information[information.size() - 1 - k] = {};
  }
  problem = separate.problem();
  problem.information = information;
  const std::vector<std::uint32_t> poses = {1, 2}, points = {3}, cameras = {0, 1, 2};
  const BundleCovariance a =
      gslam::ceresBackend().bundle_covariance(scene.problem(), poses, points, cameras, {});
  const BundleCovariance b =
      gslam::ceresBackend().bundle_covariance(problem, poses, points, cameras, {});
  ASSERT_TRUE(a.is_valid && b.is_valid) << a.message << b.message;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 36; ++k) {
      EXPECT_NEAR(a.poses[i].values[k], b.poses[i].values[k], 1e-7);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    ASSERT_EQ(1u, a.cameras[c].size());
    EXPECT_NEAR(a.cameras[c][0], b.cameras[c][0], 1e-5 * a.cameras[c][0]);
  }
}

TEST(covariance, of_anchored_points_is_that_of_free_ones_where_anchors_are_fixed) {
  Bundle scene = Bundle::make(3, 8, {scenes::pinhole()}, {}, 1);
  const std::vector<std::uint8_t> fixed = {1, 1, 0};
  BundleProblem problem = scene.problem();
  problem.pose_fixed = fixed;
  const std::vector<std::uint32_t> pose = {2}, points = {0, 5}, anchors(8, 1);
  const BundleCovariance a = gslam::ceresBackend().bundle_covariance(problem, pose, points, {}, {});
  problem.point_anchor = anchors;
  const BundleCovariance b = gslam::ceresBackend().bundle_covariance(problem, pose, points, {}, {});
  ASSERT_TRUE(a.is_valid && b.is_valid);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 9; ++k) {
      EXPECT_NEAR(a.points[i].values[k], b.points[i].values[k], 1e-9);
    }
  }
}

TEST(covariance, says_when_nothing_fixes_the_whole) {
  Scene scene;
  BundleProblem problem = scene.problem();
  problem.position_priors = {};
  const std::vector<std::uint32_t> pose = {1};
  const BundleCovariance found = gslam::ceresBackend().bundle_covariance(problem, pose, {}, {}, {});
  EXPECT_FALSE(found.is_valid);  // the scale
  EXPECT_NE("", found.message);
}

}  // namespace
