#include "graph/block_gradients.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace gslam {
namespace {

using detail::pba::BlockGradients;
using detail::pba::GraphLayout;

// Springs of very different strength in a row, held at both ends: conjugate gradients lose their
// orthogonality, and so the solution is not at right angles to what is left of the right side.
struct Chain {
  explicit Chain(std::size_t count) : layout(), diagonal(count), right(count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-2, 2);
    std::normal_distribution<double> normal;
    double strength = std::pow(10, exponent(random));
    for (std::size_t i = 0; i < count; ++i) {
      const double next = std::pow(10, exponent(random));
      diagonal[i] = {strength + next};
      right[i] = normal(random);
      layout.pose.push_back(static_cast<std::uint32_t>(i));
      if (i > 0) {
        layout.pairs.emplace_back(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i - 1));
        beside.push_back({-strength});
      }
      strength = next;
    }
  }

  // The right side less the product with x.
  std::vector<double> rest(const std::vector<double>& x) const {
    std::vector<double> r = right;
    for (std::size_t i = 0; i < x.size(); ++i) {
      r[i] -= diagonal[i].values[0] * x[i];
      if (i > 0) r[i] -= beside[i - 1].values[0] * x[i - 1];
      if (i + 1 < x.size()) r[i] -= beside[i].values[0] * x[i + 1];
    }
    return r;
  }

  GraphLayout layout;
  std::vector<Mat<double, 1, 1>> diagonal, beside;
  std::vector<double> right;
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

TEST(block_gradients, say_what_they_left_open) {
  const Chain chain(60);
  OptimizerOptions options;
  options.linear_tolerance = 0.01;
  BlockGradients<1> gradients(chain.layout, options);
  std::vector<double> x = chain.right;
  double open = 0;
  const std::size_t iterations = gradients.solve(chain.diagonal, chain.beside, x, open);
  EXPECT_GT(iterations, 10u);
  EXPECT_LT(iterations, options.max_linear_iterations);
  const double exact = dot(x, chain.rest(x));
  ASSERT_GT(std::fabs(exact), 1e-9 * dot(x, chain.right));  // more than rounding
  EXPECT_NEAR(open, exact, 1e-3 * std::fabs(exact));
}

}  // namespace
}  // namespace gslam
