#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "fast_reference.h"
#include "test_data.h"

namespace fast_reference {
namespace {

using gslam::Camera;
using gslam::SE3d;
using gslam::Vec3d;

// "Bundle adjustment in the large": cameras that look along -z, with y up.
bool readBal(const std::string& path, Arrays& arrays) {
  std::ifstream file(path);
  std::size_t cameras = 0, points = 0, observations = 0;
  if (!(file >> cameras >> points >> observations)) return false;
  for (std::size_t k = 0; k < observations; ++k) {
    std::uint32_t camera = 0, point = 0;
    double u = 0, v = 0;
    file >> camera >> point >> u >> v;
    arrays.observation_pose.push_back(camera);
    arrays.observation_camera.push_back(camera);
    arrays.observation_point.push_back(point);
    arrays.pixels.push_back({u, -v});
  }
  const SE3d flip(gslam::SO3d::exp({std::acos(-1.0), 0, 0}), Vec3d{});
  for (std::size_t i = 0; i < cameras; ++i) {
    double c[9];
    for (double& x : c) file >> x;
    const SE3d T_bal_world(gslam::SO3d::exp({c[0], c[1], c[2]}), {c[3], c[4], c[5]});
    arrays.T_world_body.push_back((flip * T_bal_world).inverse());
    arrays.cameras.push_back(
        Camera::fromParameters("radtan", 1000, 1000, {c[6], c[6], 0, 0, c[7], c[8], 0, 0}));
    gslam::CameraFreedom freedom;
    freedom.parameters = 1U | (1U << 4) | (1U << 5);
    freedom.keeps_aspect = true;
    arrays.camera_freedom.push_back(freedom);
  }
  for (std::size_t i = 0; i < points; ++i) {
    Vec3d p{};
    file >> p[0] >> p[1] >> p[2];
    arrays.points.push_back(p);
  }
  return bool(file);
}

TEST(fast_bal, reaches_the_known_optimum_of_ladybug_49) {
  NEEDS_TEST_DATA();
  Arrays start;
  ASSERT_TRUE(readBal(test_data::folder() + "bundle_adjustment/problem-49-7776-pre.txt", start));
  for (const auto precision : {gslam::PrecisionKind::Automatic, gslam::PrecisionKind::Double}) {
    Arrays arrays = start;
    OptimizerOptions options;
    options.precision = precision;
    options.max_iterations = 60;
    const OptimizerSummary summary = solve(arrays, options);
    EXPECT_NEAR(summary.initial_cost, 8.509125e5, 0.5);
    EXPECT_LT(summary.final_cost, 1.33445e4) << summary.message;
    EXPECT_NEAR(summary.final_cost, double(cost(arrays.problem())), 1e-10 * summary.final_cost);
  }
}

}  // namespace
}  // namespace fast_reference
