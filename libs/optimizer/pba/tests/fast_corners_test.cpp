#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "fast_reference.h"

// What is rare: cameras of two kinds, points and cameras that are hardly seen, an end in the
// middle.

namespace fast_reference {
namespace {

using gslam::Camera;
using gslam::LinearSolverKind;
using gslam::OptimizerStatus;

TEST(fast_corners, free_cameras_keep_their_derivatives_beside_cameras_of_other_models) {
  Arrays start = synthetic_bundle::make(tiny(true));
  const double f = start.cameras[2].parameter("fx");
  start.cameras[2] = Camera::fromParameters("kannala_brandt", 1000, 1000, {f, f, 0, 0, 0, 0, 0, 0});
  start.camera_freedom[2].parameters = 0;
  Arrays found = start, expected = start;
  OptimizerOptions options;
  options.max_iterations = 1;
  options.initial_damping = 1e-2;
  options.precision = gslam::PrecisionKind::Double;
  options.linear_solver = LinearSolverKind::Dense;
  ASSERT_TRUE(gslam::detail::pba::isFastBundle(found.problem(), options));
  const OptimizerSummary summary = solve(found, options);
  takeStep(expected.problem(), 1e-2);
  ASSERT_TRUE(summary.iterations[1].is_successful) << summary.message;
  EXPECT_NEAR(summary.final_cost, double(cost(expected.problem())), 1e-7 * summary.final_cost);
}

// Camera 0 sees one point, and some points are seen by one camera.
Arrays hardlySeen() {
  const Arrays all = synthetic_bundle::make(tiny(true));
  Arrays arrays = all;
  arrays.observation_pose.clear();
  arrays.observation_point.clear();
  arrays.observation_camera.clear();
  arrays.pixels.clear();
  bool has_first = false;
  std::vector<std::uint8_t> is_seen(all.points.size(), 0);
  for (std::size_t k = 0; k < all.pixels.size(); ++k) {
    const std::uint32_t pose = all.observation_pose[k], point = all.observation_point[k];
    if (pose == 0 && has_first) continue;
    if (point % 4 == 0 && is_seen[point] != 0) continue;
    has_first = has_first || pose == 0;
    is_seen[point] = 1;
    arrays.observation_pose.push_back(pose);
    arrays.observation_point.push_back(point);
    arrays.observation_camera.push_back(all.observation_camera[k]);
    arrays.pixels.push_back(all.pixels[k]);
  }
  return arrays;
}

TEST(fast_corners, cameras_and_points_that_are_seen_once_disturb_no_solver) {
  const Arrays start = hardlySeen();
  std::vector<double> costs;
  for (const auto precision : {gslam::PrecisionKind::Double, gslam::PrecisionKind::Mixed}) {
    for (const auto kind :
         {LinearSolverKind::Dense, LinearSolverKind::Sparse, LinearSolverKind::Iterative}) {
      Arrays arrays = start;
      OptimizerOptions options;
      options.precision = precision;
      options.linear_solver = kind;
      options.function_tolerance = 1e-9;
      options.max_iterations = 100;
      const OptimizerSummary summary = solve(arrays, options);
      EXPECT_TRUE(summary.hasConverged()) << summary.message << " " << summary.linear_solver;
      EXPECT_NEAR(summary.final_cost, double(cost(arrays.problem())), 1e-9 * summary.final_cost);
      costs.push_back(summary.final_cost);
      EXPECT_NEAR(costs.back(), costs.front(), 1e-3 * costs.front()) << summary.linear_solver;
    }
  }
}

TEST(fast_corners, a_cancelled_search_keeps_the_last_step) {
  for (std::size_t last = 0; last < 4; ++last) {
    Arrays arrays = synthetic_bundle::make(tiny(true));
    OptimizerOptions options;
    options.progress = [&](const gslam::OptimizerIteration& iteration) {
      return iteration.number < last;
    };
    const OptimizerSummary summary = solve(arrays, options);
    EXPECT_EQ(summary.status, OptimizerStatus::Cancelled);
    EXPECT_EQ(summary.iterations.size(), last + 1);
    EXPECT_EQ(summary.final_cost, summary.iterations.back().cost);
    EXPECT_NEAR(summary.final_cost, double(cost(arrays.problem())), 1e-11 * summary.final_cost);
  }
}

TEST(fast_corners, rejected_steps_leave_no_trace) {
  Arrays arrays = synthetic_bundle::make(tiny(true));
  arrays.points[3] = arrays.T_world_body[1] * gslam::Vec3d{0.1, 0.1, 0.02};  // steps go too far
  OptimizerOptions options;
  options.initial_damping = 1e-12;
  options.max_iterations = 30;
  const OptimizerSummary summary = solve(arrays, options);
  std::size_t rejected = 0;
  for (std::size_t i = 1; i < summary.iterations.size(); ++i) {
    if (summary.iterations[i].is_successful) continue;
    ++rejected;
    EXPECT_EQ(summary.iterations[i].cost, summary.iterations[i - 1].cost);
  }
  EXPECT_GT(rejected, 0U);
  EXPECT_NEAR(summary.final_cost, double(cost(arrays.problem())), 1e-11 * summary.final_cost);
}

// A step of conjugate gradients is cheap beside the equations it solves, so few of these are
// wanted.
TEST(fast_corners, two_steps_are_enough_for_a_tenth_of_a_percent) {
  Arrays arrays = synthetic_bundle::make(synthetic_bundle::ladybug());
  OptimizerOptions options;
  options.linear_solver = LinearSolverKind::Iterative;
  const OptimizerSummary summary = solve(arrays, options);
  ASSERT_GT(summary.iterations.size(), 3U);
  EXPECT_LT(summary.iterations[2].cost, 1.001 * summary.final_cost);
}

}  // namespace
}  // namespace fast_reference
