// Jacobians against numeric derivatives.
#ifndef GSLAM_OPTIMIZER_CERES_TESTS_DERIVATIVES_H
#define GSLAM_OPTIMIZER_CERES_TESTS_DERIVATIVES_H

#include <ceres/crs_matrix.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace derivatives {

// Row by row.
inline std::vector<double> dense(const ceres::CRSMatrix& from) {
  const auto columns = static_cast<std::size_t>(from.num_cols);
  std::vector<double> to(static_cast<std::size_t>(from.num_rows) * columns, 0.0);
  for (std::size_t r = 0; r < static_cast<std::size_t>(from.num_rows); ++r) {
    for (int i = from.rows[r]; i < from.rows[r + 1]; ++i) {
      const auto at = static_cast<std::size_t>(i);
      to[r * columns + static_cast<std::size_t>(from.cols[at])] = from.values[at];
    }
  }
  return to;
}

// The residuals after a step along direction i of the tangent of a block.
inline std::vector<double> residualsAfter(ceres::Problem& problem,
                                          const ceres::Problem::EvaluateOptions& options,
                                          double* block, std::size_t i, double step) {
  const auto size = static_cast<std::size_t>(problem.ParameterBlockSize(block));
  const ceres::Manifold* const manifold = problem.GetManifold(block);
  const std::vector<double> before(block, block + size);
  if (manifold == nullptr) {
    block[i] += step;
  } else {
    std::vector<double> delta(static_cast<std::size_t>(manifold->TangentSize()), 0.0);
    delta[i] = step;
    EXPECT_TRUE(manifold->Plus(before.data(), delta.data(), block));
  }
  std::vector<double> residuals;
  EXPECT_TRUE(problem.Evaluate(options, nullptr, &residuals, nullptr, nullptr));
  std::copy(before.begin(), before.end(), block);
  return residuals;
}

// Every residual by every number of every tangent, through cost functions and manifolds. Errors are
// measured by the largest derivative of their column.
inline void expectRight(ceres::Problem& problem, double step = 1e-5, double tolerance = 1e-6) {
  ceres::Problem::EvaluateOptions options;
  options.apply_loss_function = false;
  problem.GetParameterBlocks(&options.parameter_blocks);
  std::vector<double> residuals;
  ceres::CRSMatrix sparse;
  ASSERT_TRUE(problem.Evaluate(options, nullptr, &residuals, nullptr, &sparse));
  ASSERT_FALSE(residuals.empty());
  const std::vector<double> jacobian = dense(sparse);
  const auto columns = static_cast<std::size_t>(sparse.num_cols);
  std::size_t column = 0;
  for (double* const block : options.parameter_blocks) {
    const auto size = static_cast<std::size_t>(problem.ParameterBlockTangentSize(block));
    for (std::size_t i = 0; i < size; ++i, ++column) {
      const std::vector<double> up = residualsAfter(problem, options, block, i, step);
      const std::vector<double> down = residualsAfter(problem, options, block, i, -step);
      double largest = 0;
      for (std::size_t r = 0; r < up.size(); ++r) {
        largest = std::max(largest, std::fabs(jacobian[r * columns + column]));
      }
      EXPECT_GT(largest, 0) << "nothing depends on column " << column;
      for (std::size_t r = 0; r < up.size(); ++r) {
        ASSERT_NEAR((up[r] - down[r]) / (2 * step), jacobian[r * columns + column],
                    tolerance * largest)
            << "row " << r << ", column " << column << ": number " << i << " of " << size;
      }
    }
  }
  EXPECT_EQ(columns, column);
}

}  // namespace derivatives

#endif  // GSLAM_OPTIMIZER_CERES_TESTS_DERIVATIVES_H
