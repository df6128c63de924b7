#include "bundle/general_equations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bundle/general_reduced.h"
#include "bundle_brute_force.h"
#include "factors/bundle_terms.h"

namespace gslam {
namespace {

using bundle_scene::LongSystem;
using bundle_scene::makeEverything;
using bundle_scene::Scene;
using bundle_scene::Variables;

TEST(general_equations, are_those_of_brute_force) {
  Scene scene = makeEverything();
  const BundleProblem problem = scene.problem();
  RobustLoss loss;
  loss.kind = LossKind::Huber;
  loss.scale = 1.5;
  const Variables variables(problem);

  const detail::pba::GeneralStructure structure = detail::pba::generalStructure(problem);
  ASSERT_EQ(structure.blocks.tangentSize(), std::size_t(variables.camera_size));
  const detail::BundleValues values = detail::bundleValues(problem, structure.blocks);
  detail::pba::GeneralEquations equations(problem, structure, loss, 1);
  equations.linearize(values);
  equations.eliminate(0, false);
  // Points gone: another basis of a point (direction and inverse distance) leaves the same.
  const int n = variables.camera_size;
  LongSystem system = variables.equations(loss);
  system.eliminate(n, variables.size - n);
  const LongSystem s = system;
  double scale = 0;
  for (int k = 0; k < n; ++k) scale = std::max(scale, s(k, k));
  std::vector<double> unit(std::size_t(n), 0), column(unit);
  for (int k = 0; k < n; ++k) {
    const double size = std::sqrt(s(k, k));
    unit[std::size_t(k)] = 1;
    equations.multiply(unit.data(), column.data());
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(column[std::size_t(i)], s(i, k), 1e-6 * (size + 1e-3) * std::sqrt(scale))
          << i << " " << k;
    }
    unit[std::size_t(k)] = 0;
    EXPECT_NEAR(equations.rightSide()[std::size_t(k)], -s(k, s.size()), 1e-5 * (1 + size));
  }

  // Every solver gives the step of the whole dense system.
  system.eliminate(0, n);
  double length = 0;  // of the step, squared, in units of S
  for (int k = 0; k < n; ++k) length += s(k, s.size()) * system.solution(k);
  for (const auto kind :
       {LinearSolverKind::Dense, LinearSolverKind::Sparse, LinearSolverKind::Iterative}) {
    for (const auto schur : {SchurKind::Explicit, SchurKind::Implicit}) {
      for (const auto preconditioner :
           {PreconditionerKind::BlockJacobi, PreconditionerKind::SchurJacobi,
            PreconditionerKind::PowerSeries}) {
        OptimizerOptions options;
        options.linear_solver = kind;
        options.schur = schur;
        options.preconditioner = preconditioner;
        options.linear_tolerance = 1e-14;
        options.max_linear_iterations = 2000;
        const auto solver = detail::pba::makeReducedSolver(structure, options);
        detail::pba::ReducedSolution solution;
        solver->solve(equations, 0, solution);
        ASSERT_TRUE(solution.is_solved);
        double worst = 0;
        for (int i = 0; i < n; ++i) {
          const double error = solution.x[std::size_t(i)] + system.solution(i);
          worst = std::max(worst, std::fabs(error) * std::sqrt(s(i, i)));
        }
        EXPECT_LT(worst, 1e-3 * std::sqrt(length)) << solver->name();
      }
    }
  }
}

TEST(general_equations, give_a_step_along_which_the_cost_falls_as_the_gradient_says) {
  Scene scene = makeEverything();
  const BundleProblem problem = scene.problem();
  const detail::pba::GeneralStructure structure = detail::pba::generalStructure(problem);
  detail::BundleValues values = detail::bundleValues(problem, structure.blocks);
  detail::pba::GeneralEquations equations(problem, structure, RobustLoss(), 1);
  const double cost = equations.linearize(values);
  const auto solver = detail::pba::makeReducedSolver(structure, OptimizerOptions());
  detail::pba::ReducedSolution solution;
  solver->solve(equations, 1e-8, solution);
  ASSERT_TRUE(solution.is_solved);
  std::vector<double> point_step(3 * problem.points.size());
  equations.substitute(solution.x.data(), point_step.data());
  // Along a short part of the step the cost falls as the gradient says.
  const double part = 1e-6;
  double slope = 0;
  for (std::size_t i = 0; i < solution.x.size(); ++i) {
    slope += equations.gradient()[i] * solution.x[i];
    solution.x[i] *= part;
  }
  for (std::size_t g = 0; g < structure.groups.count(); ++g) {
    if (structure.groups.point[g] == detail::kNoBlock) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      slope += equations.pointGradient(g)[i] * point_step[3 * structure.groups.point[g] + i];
    }
  }
  for (double& s : point_step) s *= part;
  detail::BundleValues next = values;
  ASSERT_TRUE(
      detail::stepValues(structure.blocks, values, solution.x.data(), point_step.data(), next));
  EXPECT_NEAR((equations.cost(next) - cost) / part, slope, 1e-3 * std::fabs(slope));
  EXPECT_LT(slope, 0);
  EXPECT_EQ(equations.cost(values), cost);
}

TEST(general_equations, need_no_room_for_a_reduced_matrix_that_is_not_formed) {
  using detail::pba::GeneralEquations;
  Scene scene = makeEverything();
  const BundleProblem problem = scene.problem();
  const auto whole = detail::pba::generalStructure(problem);
  const auto slim = detail::pba::generalStructure(problem, detail::pba::GeneralFill::Unreduced);
  EXPECT_LT(slim.pattern.offset.back(), whole.pattern.offset.back());
  const detail::BundleValues values = detail::bundleValues(problem, whole.blocks);
  GeneralEquations a(problem, whole, RobustLoss(), 1), b(problem, slim, RobustLoss(), 1);
  EXPECT_EQ(a.linearize(values), b.linearize(values));
  a.eliminate(1e-3, false);
  b.eliminate(1e-3, true);
  EXPECT_EQ(a.gradient(), b.gradient());
  EXPECT_EQ(a.rightSide(), b.rightSide());
  for (std::size_t block = 0; block < whole.blocks.count(); ++block) {
    const std::size_t size = whole.blocks.size(block);
    const double* const expected = &a.reduced()[whole.pattern.offset[whole.pattern.first[block]]];
    const double* const found = &b.reduced()[slim.pattern.offset[slim.pattern.first[block]]];
    for (std::size_t i = 0; i < size * size; ++i) {
      if (i / size > i % size) continue;
      EXPECT_EQ(found[i], expected[i]) << block;
    }
  }
  std::vector<double> x, y(a.gradient().size()), z(y);
  for (std::size_t i = 0; i < y.size(); ++i) x.push_back(std::sin(double(i)));
  a.multiply(x.data(), y.data());
  b.multiply(x.data(), z.data());
  for (std::size_t i = 0; i < y.size(); ++i) {
    EXPECT_NEAR(z[i], y[i], 1e-9 * (1 + std::fabs(y[i])));
  }
  a.multiplyReduced(x.data(), z.data());
  for (std::size_t i = 0; i < y.size(); ++i) {
    EXPECT_NEAR(z[i], y[i], 1e-9 * (1 + std::fabs(y[i])));
  }
}

TEST(bundle_blocks, keep_far_points_where_they_are_and_before_infinity) {
  const double still[] = {0, 0, 0}, beyond[] = {0, 0, -1};
  for (const double inverse : {1.0, 1e-6, 1e-13}) {
    const Vec4d point = {0, 0, 1, inverse};
    EXPECT_EQ(detail::steppedAnchored(point, still), point);
    EXPECT_GT(detail::steppedAnchored(point, beyond)[3], 0);
    EXPECT_LT(detail::steppedAnchored(point, beyond)[3], inverse * (inverse > 1e-12 ? 0.11 : 1.1));
  }
}

}  // namespace
}  // namespace gslam
