#include <gslam/base/simd.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "../bench/synthetic_bundle.cpp"
#include "fast_reference.h"

namespace fast_reference {
namespace {

using gslam::LossKind;
using gslam::OptimizerStatus;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

Shape small(bool bal) {
  Shape shape;
  shape.cameras = bal ? 24 : 12;
  shape.points = 600;
  shape.observations = 2600;
  shape.walks = 2;
  shape.reach = 6;
  shape.bal = bal;
  return shape;
}

OptimizerOptions exact() {
  OptimizerOptions options;
  options.function_tolerance = 1e-13;
  options.parameter_tolerance = 0;
  options.max_iterations = 60;
  return options;
}

bool areSame(const Arrays& a, const Arrays& b) {
  return std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(a.points[0])) ==
             0 &&
         std::memcmp(a.T_world_body.data(), b.T_world_body.data(),
                     a.T_world_body.size() * sizeof(a.T_world_body[0])) == 0 &&
         a.cameras == b.cameras;
}

TEST(fast_bundle, final_cost_is_that_of_the_returned_variables) {
  for (const bool bal : {false, true}) {
    Arrays arrays = synthetic_bundle::make(small(bal));
    const auto before = static_cast<double>(cost(arrays.problem()));
    const OptimizerSummary summary = solve(arrays, OptimizerOptions());
    EXPECT_TRUE(summary.hasConverged()) << summary.message;
    EXPECT_NEAR(summary.initial_cost, before, 1e-11 * before);
    EXPECT_NEAR(summary.final_cost, double(cost(arrays.problem())), 1e-11 * summary.final_cost);
    EXPECT_LT(summary.final_cost, 0.05 * before);
    for (std::size_t i = 1; i < summary.iterations.size(); ++i) {
      EXPECT_LE(summary.iterations[i].cost, summary.iterations[i - 1].cost);
    }
  }
}

TEST(fast_bundle, every_solver_reaches_the_same_optimum) {
  using gslam::LinearSolverKind;
  for (const bool bal : {false, true}) {
    const Arrays start = synthetic_bundle::make(small(bal));
    std::vector<double> costs;
    for (const auto precision : {gslam::PrecisionKind::Double, gslam::PrecisionKind::Mixed,
                                 gslam::PrecisionKind::Automatic}) {
      for (const auto kind : {LinearSolverKind::Dense, LinearSolverKind::Sparse,
                              LinearSolverKind::Iterative, LinearSolverKind::Automatic}) {
        for (const auto schur : {gslam::SchurKind::Automatic, gslam::SchurKind::Implicit}) {
          OptimizerOptions options = exact();
          options.precision = precision;
          options.linear_solver = kind;
          options.schur = schur;
          Arrays arrays = start;
          costs.push_back(solve(arrays, options).final_cost);
          EXPECT_NEAR(costs.back(), costs.front(), 1e-9 * costs.front());
        }
      }
    }
  }
}

TEST(fast_bundle, every_loss_reaches_the_same_optimum_in_both_precisions) {
  for (const auto kind :
       {LossKind::Huber, LossKind::Cauchy, LossKind::Tukey, LossKind::GemanMcClure}) {
    Arrays start = synthetic_bundle::make(small(false));
    for (std::size_t k = 0; k < start.pixels.size(); k += 29) start.pixels[k][0] += 40;
    OptimizerOptions options = exact();
    options.loss = {LossKind::Huber, 2};
    options.max_iterations = 100;
    (void)solve(start, options);  // so that all begin in the same valley
    options.loss.kind = kind;
    options.loss.scale = kind == LossKind::Tukey ? 5 : 2;
    Arrays mixed = start, whole = start;
    const OptimizerSummary a = solve(mixed, options);
    options.precision = gslam::PrecisionKind::Double;
    const OptimizerSummary b = solve(whole, options);
    EXPECT_NEAR(a.final_cost, b.final_cost, 1e-8 * b.final_cost) << int(kind);
    EXPECT_NEAR(a.final_cost, double(cost(mixed.problem(), options.loss)), 1e-10 * a.final_cost);
    EXPECT_LT(a.inliers, a.observations);
    EXPECT_GT(a.inliers, a.observations * 9 / 10);
  }
}

TEST(fast_bundle, gives_the_same_bits_for_any_number_of_threads) {
  Shape shape = small(true);
  shape.points = 9000;  // enough for several threads
  shape.observations = 36000;
  const Arrays start = synthetic_bundle::make(shape);
  for (const auto schur : {gslam::SchurKind::Explicit, gslam::SchurKind::Implicit}) {
    OptimizerOptions options;
    options.schur = schur;
    options.linear_solver = gslam::LinearSolverKind::Iterative;
    options.max_iterations = 4;
    Arrays one = start;
    (void)solve(one, options);
    for (const unsigned threads : {1U, 2U, 5U}) {
      options.threads = threads;
      Arrays other = start;
      (void)solve(other, options);
      EXPECT_TRUE(areSame(one, other)) << threads;
    }
  }
}

TEST(fast_bundle, all_simd_variants_agree) {
  for (const bool bal : {false, true}) {
    const Arrays start = synthetic_bundle::make(small(bal));
    double first = 0;
    for (const gslam::Simd variant : gslam::availableSimd()) {
      const gslam::ScopedSimd scoped(variant);
      Arrays arrays = start;
      const double found = solve(arrays, exact()).final_cost;
      if (first == 0) first = found;
      EXPECT_NEAR(found, first, 1e-9 * first) << gslam::simdName(variant);
    }
  }
}

TEST(fast_bundle, does_not_touch_what_is_fixed) {
  const Arrays start = synthetic_bundle::make(small(false));
  Arrays arrays = start;
  std::vector<std::uint8_t> fixed(arrays.points.size(), 0);
  for (std::size_t i = 0; i < fixed.size(); i += 3) fixed[i] = 1;
  BundleProblem problem = arrays.problem();
  problem.point_fixed = fixed;
  const OptimizerSummary summary = gslam::detail::pba::solveFastBundle(problem, OptimizerOptions());
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const bool is_same = arrays.points[i] == start.points[i];
    EXPECT_EQ(is_same, fixed[i] != 0) << i;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(std::memcmp(&arrays.T_world_body[i], &start.T_world_body[i], sizeof(SE3d)), 0);
  }
  EXPECT_NEAR(summary.final_cost, double(cost(arrays.problem())), 1e-10 * summary.final_cost);
}

TEST(fast_bundle, moves_points_alone_where_all_poses_are_fixed) {
  Arrays arrays = synthetic_bundle::make(small(false));
  arrays.pose_fixed.assign(arrays.pose_fixed.size(), 1);
  const OptimizerSummary summary = solve(arrays, exact());
  EXPECT_TRUE(summary.is_usable);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
  EXPECT_NEAR(summary.final_cost, double(cost(arrays.problem())), 1e-10 * summary.final_cost);
}

TEST(fast_bundle, weighs_by_the_information) {
  Arrays start = synthetic_bundle::make(tiny(false));
  std::vector<gslam::Vec3d> information;
  for (std::size_t k = 0; k < start.pixels.size(); ++k) {
    information.push_back({1.0 + double(k % 3), 0.5, 0.5 + double(k % 2)});
  }
  Arrays found = start, expected = start;
  BundleProblem problem = found.problem();
  problem.information = information;
  OptimizerOptions options;
  options.max_iterations = 1;
  options.initial_damping = 1e-2;
  options.precision = gslam::PrecisionKind::Double;
  const OptimizerSummary summary = gslam::detail::pba::solveFastBundle(problem, options);
  EXPECT_NEAR(summary.final_cost, double(cost(problem)), 1e-11 * summary.final_cost);
  BundleProblem reference = expected.problem();
  reference.information = information;
  takeStep(reference, 1e-2);
  EXPECT_NEAR(summary.final_cost, double(cost(reference)), 1e-6 * summary.final_cost);
}

// Two cameras on each body, which often see the same point.
Arrays makeRig() {
  Arrays arrays = synthetic_bundle::make(tiny(false));
  arrays.cameras.push_back(gslam::Camera::fromParameters("kannala_brandt", 1000, 1000,
                                                         {400, 400, 500, 500, 0, 0, 0, 0}));
  return arrays;
}

TEST(fast_bundle, takes_rigs_and_any_camera_model) {
  Arrays arrays = makeRig();
  const std::vector<SE3d> rig = {SE3d(),
                                 SE3d(gslam::SO3d::exp({0.05, -0.1, 0.02}), {0.3, 0.05, -0.1})};
  std::vector<SE3d> extrinsics = rig;
  const Arrays truth = [] {
    Shape shape = tiny(false);
    shape.start_noise = 0;
    return synthetic_bundle::make(shape);
  }();
  const std::size_t n = arrays.pixels.size();
  for (std::size_t k = 0; k < n; k += 2) {
    Vec2d pixel{};
    const Vec3d local = (truth.T_world_body[truth.observation_pose[k]] * rig[1]).inverse() *
                        truth.points[truth.observation_point[k]];
    if (!arrays.cameras[1].project(local, pixel)) continue;
    arrays.observation_pose.push_back(truth.observation_pose[k]);
    arrays.observation_point.push_back(truth.observation_point[k]);
    arrays.observation_camera.push_back(1);
    arrays.pixels.push_back({pixel[0] + 0.3 * double(k % 3) - 0.3, pixel[1]});
  }
  ASSERT_GT(arrays.pixels.size(), n + n / 3);
  for (const auto kind : {gslam::LinearSolverKind::Dense, gslam::LinearSolverKind::Iterative}) {
    for (const auto schur : {gslam::SchurKind::Explicit, gslam::SchurKind::Implicit}) {
      Arrays found = arrays, expected = arrays;
      OptimizerOptions options;
      options.max_iterations = 1;
      options.initial_damping = 1e-2;
      options.linear_tolerance = 1e-13;
      options.linear_solver = kind;
      options.schur = schur;
      options.precision = gslam::PrecisionKind::Double;
      BundleProblem problem = found.problem();
      problem.T_body_camera = extrinsics;
      ASSERT_TRUE(gslam::detail::pba::isFastBundle(problem, options));
      const OptimizerSummary step = gslam::detail::pba::solveFastBundle(problem, options);
      BundleProblem reference = expected.problem();
      reference.T_body_camera = extrinsics;
      takeStep(reference, 1e-2);
      EXPECT_NEAR(step.final_cost, double(cost(reference)), 1e-7 * step.final_cost);
      EXPECT_NEAR(step.final_cost, double(cost(problem)), 1e-10 * step.final_cost);
    }
  }
}

TEST(fast_bundle, survives_points_behind_cameras_and_in_their_planes) {
  Arrays arrays = synthetic_bundle::make(small(true));
  arrays.points[3][2] = -5;
  const std::uint32_t pose = arrays.observation_pose[0], point = arrays.observation_point[0];
  arrays.points[point] = arrays.T_world_body[pose] * Vec3d{0.3, 0.1, 0};
  const OptimizerSummary summary = solve(arrays, OptimizerOptions());
  EXPECT_TRUE(std::isfinite(summary.final_cost));
  EXPECT_LE(summary.final_cost, summary.initial_cost);
  for (const gslam::Vec3d& p : arrays.points) EXPECT_TRUE(std::isfinite(p.norm()));
}

TEST(fast_bundle, fails_without_touching_anything_where_the_cost_has_no_value) {
  const Arrays start = synthetic_bundle::make(small(true));
  Arrays arrays = start;
  arrays.pixels[7][0] = std::numeric_limits<double>::infinity();
  const OptimizerSummary summary = solve(arrays, OptimizerOptions());
  EXPECT_EQ(summary.status, OptimizerStatus::Failed);
  EXPECT_FALSE(summary.is_usable);
  EXPECT_TRUE(areSame(arrays, start));
}

TEST(fast_bundle, knows_what_it_can_do) {
  const OptimizerOptions options;
  Arrays arrays = synthetic_bundle::make(small(true));
  const auto is_fast = [&](const BundleProblem& problem) {
    return gslam::detail::pba::isFastBundle(problem, options);
  };
  EXPECT_TRUE(is_fast(arrays.problem()));
  Arrays shared = arrays;
  shared.observation_camera[0] = (shared.observation_camera[0] + 1) % 24;
  EXPECT_FALSE(is_fast(shared.problem()));
  Arrays other = arrays;
  other.camera_freedom[0].parameters = 1;
  EXPECT_FALSE(is_fast(other.problem()));
  BundleProblem prior = arrays.problem();
  const gslam::PositionPrior position;
  prior.position_priors = gslam::Span<const gslam::PositionPrior>(&position, 1);
  EXPECT_FALSE(is_fast(prior));
  const std::vector<double> right(arrays.pixels.size(), 1.0);
  BundleProblem stereo = arrays.problem();
  stereo.right_u = right;
  EXPECT_FALSE(is_fast(stereo));
}

TEST(fast_bundle, fixes_some_poses_and_some_cameras_of_nine_variables) {
  Arrays start = synthetic_bundle::make(tiny(true));
  start.pose_fixed.assign(start.T_world_body.size(), 0);
  start.pose_fixed[0] = start.pose_fixed[1] = 1;
  start.camera_freedom[1].parameters = 0;
  start.camera_freedom[2].parameters = 0;
  Arrays found = start, expected = start;
  OptimizerOptions options;
  options.max_iterations = 1;
  options.initial_damping = 1e-2;
  options.precision = gslam::PrecisionKind::Double;
  const OptimizerSummary summary = solve(found, options);
  takeStep(expected.problem(), 1e-2);
  EXPECT_NEAR(summary.final_cost, double(cost(expected.problem())), 1e-7 * summary.final_cost);
  EXPECT_EQ(std::memcmp(&found.T_world_body[0], &start.T_world_body[0], 2 * sizeof(SE3d)), 0);
  EXPECT_EQ(found.cameras[1], start.cameras[1]);
  EXPECT_FALSE(found.cameras[0] == start.cameras[0]);
}

}  // namespace
}  // namespace fast_reference
