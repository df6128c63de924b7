#include <gtest/gtest.h>

#include <string>

#include "bundle/fast_pattern.h"
#include "fast_reference.h"

namespace fast_reference {
namespace {

using gslam::detail::pba::FastSizes;
using gslam::detail::pba::isWorthForming;

bool startsWith(const std::string& text, const char* start) {
  return text.rfind(start, 0) == 0;
}

OptimizerOptions fewSteps() {
  OptimizerOptions options;
  options.max_iterations = 2;
  return options;
}

Shape withTracks(std::size_t observations_of_point, std::size_t points) {
  Shape shape;
  shape.cameras = 60;
  shape.points = points;
  shape.observations = shape.points * observations_of_point;
  shape.reach = 60;
  shape.bal = true;
  return shape;
}

TEST(fast_plan, forms_the_matrix_where_points_are_seen_by_few) {
  Arrays arrays = synthetic_bundle::make(withTracks(5, 3000));
  const OptimizerSummary summary = solve(arrays, fewSteps());
  EXPECT_EQ(summary.linear_solver, "explicit Schur, float, PCG Schur-Jacobi");
}

TEST(fast_plan, does_not_form_the_matrix_where_points_are_seen_by_most_cameras) {
  Arrays arrays = synthetic_bundle::make(withTracks(200, 300));
  ASSERT_GT(arrays.pixels.size(), arrays.points.size() * 40);
  Arrays same = arrays;
  OptimizerOptions options;
  const OptimizerSummary summary = solve(arrays, options);
  EXPECT_EQ(summary.linear_solver, "implicit Schur, float, PCG Schur-Jacobi");
  options.schur = gslam::SchurKind::Explicit;
  const OptimizerSummary formed = solve(same, options);
  EXPECT_TRUE(startsWith(formed.linear_solver, "explicit"));
  EXPECT_NEAR(summary.final_cost, formed.final_cost, 1e-3 * formed.final_cost);
}

TEST(fast_plan, forms_the_matrix_for_direct_solvers_whatever_the_tracks) {
  for (const auto kind : {gslam::LinearSolverKind::Dense, gslam::LinearSolverKind::Sparse}) {
    Arrays arrays = synthetic_bundle::make(withTracks(200, 300));
    OptimizerOptions options = fewSteps();
    options.linear_solver = kind;
    EXPECT_TRUE(startsWith(solve(arrays, options).linear_solver, "explicit"));
  }
}

// Venice, and a set of as many observations whose cameras all see each other.
TEST(fast_plan, forms_no_matrix_beyond_four_gibibytes) {
  FastSizes sizes;
  sizes.observations = 5e6;
  sizes.pairs = 2e7;
  sizes.slots = 2.5e5;
  sizes.block_bytes = 320;
  sizes.is_resident = false;
  EXPECT_TRUE(isWorthForming(sizes));
  sizes.slots = 1.4e7;
  EXPECT_FALSE(isWorthForming(sizes));
}

TEST(fast_plan, takes_cholesky_up_to_three_hundred_variables) {
  for (const std::size_t cameras : {33U, 34U}) {
    Shape shape = withTracks(5, 3000);
    shape.cameras = cameras;
    Arrays arrays = synthetic_bundle::make(shape);
    const OptimizerSummary summary = solve(arrays, fewSteps());
    EXPECT_EQ(summary.linear_solver, cameras == 33 ? "explicit Schur, float, dense Cholesky"
                                                   : "explicit Schur, float, PCG Schur-Jacobi");
  }
}

}  // namespace
}  // namespace fast_reference
