#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bundle_brute_force.h"
#include "solvers.h"

namespace gslam {
namespace {

using bundle_scene::addNoise;
using bundle_scene::addStereo;
using bundle_scene::LongSystem;
using bundle_scene::makeEverything;
using bundle_scene::makeScene;
using bundle_scene::pinhole;
using bundle_scene::Scene;
using bundle_scene::Variables;
using detail::pba::solveBundleCovariance;
using detail::pba::solveGeneralBundle;
using Indices = std::vector<std::uint32_t>;

// Of a square block, against the same of the dense inverse: right sides from the second on.
void expectBlock(const double* found, const LongSystem& inverse, int first, int size,
                 const char* what) {
  const auto at = [&inverse](int row, int column) { return inverse.solution(row, 1 + column); };
  for (int i = first; i < first + size; ++i) {
    for (int k = first; k < first + size; ++k) {
      EXPECT_NEAR(*found++, at(i, k), 2e-5 * std::sqrt(at(i, i) * at(k, k)))
          << what << " " << i - first << " " << k - first;
    }
  }
}

TEST(bundle_covariance, is_the_inverse_of_the_dense_equations) {
  Scene scene = makeEverything();
  const BundleProblem problem = scene.problem();
  OptimizerOptions options;
  options.loss.kind = LossKind::Cauchy;
  options.loss.scale = 2;
  const Variables variables(problem);
  LongSystem inverse = variables.equations(options.loss, variables.size);
  for (int k = 0; k < variables.size; ++k) inverse(k, variables.size + 1 + k) = 1;
  inverse.eliminate(0, variables.size);
  const Indices poses = {3, 0, 1}, points = {0, 5, 2, 8, 13}, cameras = {1, 0};
  const BundleCovariance found = solveBundleCovariance(problem, poses, points, cameras, options);
  ASSERT_TRUE(found.is_valid) << found.message;
  expectBlock(found.poses[0].values, inverse, variables.pose[3], 6, "pose 3");
  expectBlock(found.poses[2].values, inverse, variables.pose[1], 6, "pose 1");
  EXPECT_EQ(found.poses[1], (Mat<double, 6, 6>{}));  // fixed
  EXPECT_EQ(found.points[1], (Mat3d{}));             // fixed
  for (const std::size_t k : {0u, 2u, 3u, 4u}) {
    expectBlock(found.points[k].values, inverse, variables.point[points[k]], 3, "point");
  }
  for (const std::size_t k : {0u, 1u}) {
    const int size = int(variables.parameters[cameras[k]].size());
    ASSERT_EQ(found.cameras[k].size(), std::size_t(size * size));
    expectBlock(found.cameras[k].data(), inverse, variables.intrinsic[cameras[k]], size, "camera");
  }
}

// Squared length of an error in units of its covariance.
double squaredIn(const double* covariance, const double* error, int n) {
  LongSystem system(n);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) system(i, k) = covariance[i * n + k];
    system(i, n) = error[i];
  }
  system.eliminate(0, n);
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += error[i] * system.solution(i);
  return sum;
}

TEST(bundle_covariance, is_that_of_many_trials) {
  const Scene truth = makeScene(4, 25, {pinhole()});
  OptimizerOptions options;
  options.function_tolerance = 1e-10;
  double pose_sum = 0, point_sum = 0, camera_sum = 0;
  constexpr int kTrials = 300;
  const double sigma = 0.5;
  for (int trial = 0; trial < kTrials; ++trial) {
    Scene scene = truth;
    scene.bundle.pose_fixed = {1, 0, 0, 1};
    scene.bundle.camera_freedom = {{1u, true}};
    scene.bundle.information.assign(scene.bundle.pixels.size(),
                                    {1 / (sigma * sigma), 0, 1 / (sigma * sigma)});
    addNoise(scene, sigma, unsigned(1000 + trial));
    ASSERT_TRUE(solveGeneralBundle(scene.problem(), options).is_usable);
    const BundleCovariance c =
        solveBundleCovariance(scene.problem(), Indices{1}, Indices{7}, Indices{0}, options);
    ASSERT_TRUE(c.is_valid) << c.message;
    const SE3d::Tangent e =
        (scene.bundle.T_world_body[1].inverse() * truth.truth.T_world_body[1]).log();
    pose_sum += squaredIn(c.poses[0].values, e.values, 6);
    const Vec3d x = scene.bundle.points[7] - truth.truth.points[7];
    point_sum += squaredIn(c.points[0].values, x.values, 3);
    const double f = scene.bundle.cameras[0].parameters()[0] - 500;
    camera_sum += f * f / c.cameras[0][0];
  }
  // Means of chi-squared distributions, within four of their deviations.
  EXPECT_NEAR(pose_sum / kTrials, 6, 4 * std::sqrt(12. / kTrials));
  EXPECT_NEAR(point_sum / kTrials, 3, 4 * std::sqrt(6. / kTrials));
  EXPECT_NEAR(camera_sum / kTrials, 1, 4 * std::sqrt(2. / kTrials));
}

TEST(bundle_covariance, is_none_without_a_gauge_and_says_what_is_free) {
  for (const std::size_t points : {20u, 60u}) {
    Scene scene = makeScene(5, points, {pinhole()});
    addNoise(scene, 0.3);
    const auto asked = [&scene] {
      return solveBundleCovariance(scene.problem(), Indices{2}, Indices{3}, Indices{},
                                   OptimizerOptions());
    };
    BundleCovariance found = asked();
    EXPECT_FALSE(found.is_valid);
    EXPECT_THAT(found.message, testing::HasSubstr("7 directions of 5 variables"));
    ASSERT_EQ(found.poses.size(), 1u);
    EXPECT_EQ(found.poses[0], (Mat<double, 6, 6>{}));
    EXPECT_EQ(found.points[0], (Mat3d{}));
    scene.bundle.pose_fixed = {1, 0, 0, 0, 0};
    found = asked();
    EXPECT_FALSE(found.is_valid);
    EXPECT_THAT(found.message, testing::HasSubstr("1 direction of 4 variables"));
    addStereo(scene, 0.3);  // scale
    found = asked();
    EXPECT_TRUE(found.is_valid) << found.message;
  }
}

TEST(bundle_covariance, is_none_of_a_point_seen_once_or_a_pose_not_seen) {
  Scene scene = makeScene(4, 30, {pinhole()});
  scene.bundle.pose_fixed = {1, 0, 0, 1};
  scene.bundle.points.push_back(scene.bundle.points[0]);
  scene.bundle.observation_pose.push_back(1);
  scene.bundle.observation_point.push_back(30);
  scene.bundle.observation_camera.push_back(0);
  scene.bundle.pixels.push_back(scene.bundle.pixels[0]);
  const OptimizerOptions options;
  BundleCovariance found =
      solveBundleCovariance(scene.problem(), Indices{1}, Indices{30}, Indices{}, options);
  EXPECT_FALSE(found.is_valid);
  EXPECT_THAT(found.message, testing::HasSubstr("point 30"));
  // Others do not mind.
  found = solveBundleCovariance(scene.problem(), Indices{1}, Indices{3}, Indices{}, options);
  EXPECT_TRUE(found.is_valid) << found.message;
  scene.bundle.T_world_body.push_back(SE3d());
  scene.bundle.pose_fixed.push_back(0);
  found = solveBundleCovariance(scene.problem(), Indices{1}, Indices{3}, Indices{}, options);
  EXPECT_FALSE(found.is_valid);
  EXPECT_THAT(found.message, testing::HasSubstr("6 directions of 1 variables, most of pose 4"));
}

TEST(bundle_covariance, is_the_same_by_sparse_factors) {
  Scene scene = makeEverything();
  OptimizerOptions options;
  const auto asked = [&](LinearSolverKind kind) {
    options.linear_solver = kind;
    return solveBundleCovariance(scene.problem(), Indices{3, 1}, Indices{2, 4}, Indices{0},
                                 options);
  };
  const BundleCovariance dense = asked(LinearSolverKind::Dense);
  const BundleCovariance sparse = asked(LinearSolverKind::Sparse);
  ASSERT_TRUE(dense.is_valid && sparse.is_valid) << dense.message << sparse.message;
  const auto expectSame = [](const double* a, const double* b, std::size_t n) {
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::fabs(a[i]));
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(a[i], b[i], 1e-6 * largest);
  };
  for (std::size_t k = 0; k < 2; ++k) {
    expectSame(dense.poses[k].values, sparse.poses[k].values, 36);
    expectSame(dense.points[k].values, sparse.points[k].values, 9);
  }
  expectSame(dense.cameras[0].data(), sparse.cameras[0].data(), dense.cameras[0].size());
  Scene loose = makeScene(5, 40, {pinhole()});
  options.linear_solver = LinearSolverKind::Sparse;
  const BundleCovariance none =
      solveBundleCovariance(loose.problem(), Indices{1}, Indices{}, Indices{}, options);
  EXPECT_FALSE(none.is_valid);
  EXPECT_THAT(none.message, testing::HasSubstr("singular"));
}

}  // namespace
}  // namespace gslam
