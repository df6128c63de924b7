#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "bundle/general_reduced.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

using BlockMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

double dotOf(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// The inverses of the diagonal blocks of a matrix.
class BlockDiagonal {
 public:
  explicit BlockDiagonal(const GeneralStructure& structure) : structure_(structure) {
    first_.push_back(0);
    for (std::size_t b = 0; b < structure.blocks.count(); ++b) {
      const std::size_t size = structure.blocks.size(b);
      first_.push_back(first_.back() + size * size);
    }
    values_.resize(first_.back());
  }

  // Of `matrix`, with damping times `diagonal` added.
  bool invert(const std::vector<double>& matrix, double damping,
              const GeneralEquations& equations) {
    for (std::size_t b = 0; b < structure_.blocks.count(); ++b) {
      const std::size_t size = structure_.blocks.size(b), top = structure_.blocks.offset[b];
      const auto n = static_cast<Eigen::Index>(size);
      const double* const from = &matrix[structure_.pattern.offset[structure_.pattern.first[b]]];
      BlockMatrix block = Eigen::Map<const BlockMatrix>(from, n, n);
      for (std::size_t i = 0; i < size; ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        block(k, k) += damping * equations.diagonal(top + i);
      }
      const Eigen::LLT<BlockMatrix, Eigen::Upper> factor(block);
      if (factor.info() != Eigen::Success) return false;
      Eigen::Map<BlockMatrix>(&values_[first_[b]], n, n) =
          factor.solve(BlockMatrix::Identity(n, n));
    }
    return true;
  }

  void multiply(const std::vector<double>& x, std::vector<double>& y) const {
    for (std::size_t b = 0; b < structure_.blocks.count(); ++b) {
      const std::size_t size = structure_.blocks.size(b), top = structure_.blocks.offset[b];
      for (std::size_t i = 0; i < size; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < size; ++j)
          sum += values_[first_[b] + i * size + j] * x[top + j];
        y[top + i] = sum;
      }
    }
  }

 private:
  const GeneralStructure& structure_;
  std::vector<std::size_t> first_;
  std::vector<double> values_;
};

// Preconditioned conjugate gradients on the Schur complement.
class IterativeSolver : public ReducedSolver {
 public:
  IterativeSolver(const GeneralStructure& structure, const OptimizerOptions& options)
      : options_(options),
        is_explicit_(options.schur != SchurKind::Implicit),
        kind_(options.preconditioner == PreconditionerKind::Automatic
                  ? PreconditionerKind::SchurJacobi
                  : options.preconditioner),
        diagonal_(structure) {}

  std::string name() const override {
    const std::string schur = is_explicit_ ? "explicit Schur" : "implicit Schur";
    switch (kind_) {
      case PreconditionerKind::BlockJacobi:
        return schur + ", double, PCG block Jacobi";
      case PreconditionerKind::PowerSeries:
        return schur + ", double, PCG power series";
      case PreconditionerKind::Automatic:
      case PreconditionerKind::SchurJacobi:
        break;
    }
    return schur + ", double, PCG Schur-Jacobi";
  }

  void solve(GeneralEquations& equations, double damping, ReducedSolution& solution) override {
    equations.eliminate(damping, !is_explicit_);
    const bool is_schur_jacobi = kind_ == PreconditionerKind::SchurJacobi;
    solution.is_solved = is_schur_jacobi
                             ? diagonal_.invert(equations.reduced(), 0, equations)
                             : diagonal_.invert(equations.hessian(), damping, equations);
    if (solution.is_solved) iterate(equations, solution);
  }

 private:
  void multiply(GeneralEquations& equations, const std::vector<double>& x, std::vector<double>& y) {
    if (is_explicit_) {
      equations.multiplyReduced(x.data(), y.data());
    } else {
      equations.multiply(x.data(), y.data());
    }
  }

  // With U the block diagonal and S = U - E: the sum of (U^-1 E)^i U^-1. An even number of terms
  // after the first keeps it positive definite, whatever E is.
  void precondition(GeneralEquations& equations, const std::vector<double>& r,
                    std::vector<double>& z) {
    diagonal_.multiply(r, z);
    if (kind_ != PreconditionerKind::PowerSeries) return;
    constexpr int kTerms = 4;
    std::vector<double> term = z, image(r.size()), back(r.size());
    for (int i = 0; i < kTerms; ++i) {
      multiply(equations, term, image);
      diagonal_.multiply(image, back);
      for (std::size_t k = 0; k < term.size(); ++k) {
        term[k] -= back[k];
        z[k] += term[k];
      }
    }
  }

  void iterate(GeneralEquations& equations, ReducedSolution& solution) {
    const std::vector<double>& right = equations.rightSide();
    const std::size_t n = right.size();
    std::vector<double>& x = solution.x;
    std::vector<double>& r = solution.residual;
    x.assign(n, 0);
    r = right;
    std::vector<double> z(n), p(n), q(n);
    const double target = options_.linear_tolerance * std::sqrt(dotOf(r, r));
    double along = 0, model = 0;
    solution.iterations = 0;
    while (solution.iterations < options_.max_linear_iterations && dotOf(r, r) > 0) {
      precondition(equations, r, z);
      const double now = dotOf(r, z);
      const double beta = solution.iterations == 0 ? 0 : now / along;
      along = now;
      for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
      multiply(equations, p, q);
      const double curvature = dotOf(p, q);
      if (!(curvature > 0) || !std::isfinite(curvature)) break;  // rounding: x is what there is
      const double alpha = along / curvature;
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += alpha * p[i];
        r[i] -= alpha * q[i];
      }
      ++solution.iterations;
      // The model of the cost, x S x / 2 - right x, after S. Nash and A. Sofer, "Assessing a
      // search direction within a truncated-Newton method", 1990.
      double next_model = 0;
      for (std::size_t i = 0; i < n; ++i) next_model -= 0.5 * x[i] * (right[i] + r[i]);
      const double fall = double(solution.iterations) * (model - next_model);
      model = next_model;
      if (std::sqrt(dotOf(r, r)) <= target) break;
      if (fall < options_.linear_tolerance * std::fabs(model)) break;
    }
    solution.is_solved = solution.iterations > 0 || !(dotOf(r, r) > 0);
  }

  const OptimizerOptions& options_;
  const bool is_explicit_;
  const PreconditionerKind kind_;
  BlockDiagonal diagonal_;
};

}  // namespace

std::unique_ptr<ReducedSolver> makeIterativeSolver(const GeneralStructure& structure,
                                                   const OptimizerOptions& options) {
  return std::make_unique<IterativeSolver>(structure, options);
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
