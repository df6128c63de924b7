#ifndef GSLAM_OPTIMIZER_PBA_SRC_GRAPH_GRAPH_PROBLEM_H
#define GSLAM_OPTIMIZER_PBA_SRC_GRAPH_GRAPH_PROBLEM_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "graph/block_gradients.h"
#include "graph/graph_equations.h"
#include "sparse/block_cholesky.h"
#include "trust_region.h"

// A pose graph as the loop sees it.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

template <class Group>
class GraphProblem : public TrustRegionProblem {
 public:
  static constexpr std::size_t n = Group::kFreedom;

  GraphProblem(const PoseGraphProblem<Group>& problem, const GraphLayout& layout,
               const OptimizerOptions& options)
      : layout_(layout),
        options_(options),
        equations_(problem, layout, options),
        poses_(problem.T_world_body.begin(), problem.T_world_body.end()),
        candidates_(poses_),
        scale_(layout.pose.size() * n),
        step_(layout.pose.size() * n) {
    if (options.linear_solver == LinearSolverKind::Iterative) {
      gradients_ = std::make_unique<BlockGradients<n>>(layout, options);
    } else {
      cholesky_ = BlockCholesky(layout.pose.size(), n, layout.pairs);
    }
  }

  const std::vector<Group>& poses() const { return poses_; }
  const GraphEquations<Group>& equations() const { return equations_; }

  // Without damping. Whether the equations have an inverse, as far as digits tell.
  bool decompose() {
    return cholesky_.factorize(diagonalData(equations_.diagonal), besideData(), options_.threads) &&
           cholesky_.leastPivot() > kSingularPivot;
  }
  void inverseBlock(std::size_t variable, typename Group::Jacobian& block) const {
    cholesky_.inverseBlock(variable, block.data());
  }

  double linearize() override {
    const double cost = equations_.linearize(poses_);
    is_new_point_ = true;
    double largest = 0;
    for (const auto& block : equations_.diagonal) {
      for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, block(k, k));
    }
    const double least = std::max(kLeastScale * largest, std::numeric_limits<double>::min());
    for (std::size_t i = 0; i < scale_.size(); ++i) {
      scale_[i] = std::max(least, equations_.diagonal[i / n](i % n, i % n));
    }
    return cost;
  }

  double gradientMax() const override {
    double largest = 0;
    for (const auto& g : equations_.gradient) {
      for (std::size_t k = 0; k < n; ++k) {
        if (!(std::fabs(g[k]) <= largest)) largest = std::fabs(g[k]);  // NaN is handed on
      }
    }
    return largest;
  }

  // By the exact second derivatives where they are known and positive; where their step did not
  // lower the cost, by those of Gauss and Newton.
  LinearStep solve(double damping) override {
    LinearStep result;
    if (is_new_point_ && !equations_.curvature.empty() && gradients_ == nullptr) {
      result = solveWith(damping, true);
    }
    is_new_point_ = false;
    return result.is_solved ? result : solveWith(damping, false);
  }

  double evaluateStep() override {
    for (std::size_t v = 0; v < layout_.pose.size(); ++v) {
      typename Group::Tangent step;
      for (std::size_t k = 0; k < n; ++k) {
        step[k] = step_[v * n + k];
        if (!(std::fabs(step[k]) <= (k < Group::Point::size() ? kMostMove : kMostTurn))) {
          return std::numeric_limits<double>::infinity();
        }
      }
      const std::size_t pose = layout_.pose[v];
      candidates_[pose] = (poses_[pose] * Group::exp(step)).normalized();
    }
    return equations_.cost(candidates_);
  }

  void acceptStep() override { poses_.swap(candidates_); }

 private:
  static const double* diagonalData(const std::vector<typename Group::Jacobian>& blocks) {
    return blocks.empty() ? nullptr : blocks.data()->data();
  }
  const double* besideData() const {
    return equations_.beside.empty() ? nullptr : equations_.beside.data()->data();
  }

  LinearStep solveWith(double damping, bool is_exact) {
    damped_ = equations_.diagonal;
    for (std::size_t v = 0; is_exact && v < damped_.size(); ++v) {
      damped_[v] += equations_.curvature[v];
    }
    for (std::size_t i = 0; i < scale_.size(); ++i) {
      damped_[i / n](i % n, i % n) += damping * scale_[i];
      step_[i] = -equations_.gradient[i / n][i % n];
    }
    LinearStep result;
    double open = 0;  // the product of the step with what is left of the right side
    if (gradients_ != nullptr) {
      result.linear_iterations = gradients_->solve(damped_, equations_.beside, step_, open);
      result.is_solved = true;
    } else {
      result.is_solved = cholesky_.factorize(diagonalData(damped_), besideData(), options_.threads);
      if (result.is_solved) cholesky_.solve(step_.data());
    }
    if (result.is_solved) measure(damping, open, result);
    return result;
  }

  void measure(double damping, double open, LinearStep& result) const {
    double along = open, damped = 0, squared = 0, size = 0;
    for (std::size_t i = 0; i < step_.size(); ++i) {
      along -= step_[i] * equations_.gradient[i / n][i % n];
      damped += step_[i] * step_[i] * scale_[i];
      squared += step_[i] * step_[i];
    }
    for (const std::uint32_t p : layout_.pose) size += 1 + poses_[p].translation().squaredNorm();
    result.model_decrease = 0.5 * (along + damping * damped);
    result.step_norm = std::sqrt(squared);
    result.variable_norm = std::sqrt(size);
    result.is_solved = std::isfinite(result.model_decrease) && std::isfinite(squared);
  }

  static constexpr double kLeastScale = 1e-9;      // of the largest element of the diagonal
  static constexpr double kSingularPivot = 1e-13;  // part of a diagonal element
  static constexpr double kMostMove = 1e150;       // what exp() takes, and squares survive
  static constexpr double kMostTurn = 300;

  const GraphLayout& layout_;
  const OptimizerOptions& options_;
  GraphEquations<Group> equations_;
  BlockCholesky cholesky_;
  std::unique_ptr<BlockGradients<n>> gradients_;
  std::vector<Group> poses_;
  std::vector<Group> candidates_;  // those with the step; the others never differ
  std::vector<typename Group::Jacobian> damped_;
  std::vector<double> scale_;  // diagonal of the normal equations, bounded
  std::vector<double> step_;
  bool is_new_point_ = true;  // no step was tried from it
};

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_GRAPH_GRAPH_PROBLEM_H
