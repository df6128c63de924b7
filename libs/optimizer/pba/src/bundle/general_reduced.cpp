#include "bundle/general_reduced.h"

#include <Eigen/Cholesky>
#include <utility>

#include "bundle/general_matrix.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

// Limits of the automatic choice.
constexpr std::size_t kSmall = 300;    // dense, whatever the density
constexpr std::size_t kMedium = 1500;  // dense where at least that part is not zero:
constexpr double kDense = 0.3;
constexpr double kMostSparseWork = 2e9;  // multiplications

using ConstVector = Eigen::Map<const Eigen::VectorXd>;

ConstVector asVector(const std::vector<double>& values) {
  return ConstVector(values.data(), static_cast<Eigen::Index>(values.size()));
}

class DenseReducedSolver : public ReducedSolver {
 public:
  explicit DenseReducedSolver(const GeneralStructure& structure) : structure_(structure) {}
  std::string name() const override { return "explicit Schur, double, dense Cholesky"; }

  void solve(GeneralEquations& equations, double damping, ReducedSolution& solution) override {
    equations.eliminate(damping, false);
    setDense(structure_, equations.reduced(), matrix_);
    factor_.compute(matrix_.triangularView<Eigen::Upper>().transpose());
    solution.is_solved = factor_.info() == Eigen::Success;
    if (!solution.is_solved) return;
    const Eigen::VectorXd x = factor_.solve(asVector(equations.rightSide()));
    solution.x.assign(x.data(), x.data() + x.size());
  }

 private:
  const GeneralStructure& structure_;
  Eigen::MatrixXd matrix_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

class SparseReducedSolver : public ReducedSolver {
 public:
  explicit SparseReducedSolver(const GeneralStructure& structure) : reduced_(structure) {
    factor_.analyzePattern(reduced_.matrix());
  }
  std::string name() const override { return "explicit Schur, double, sparse Cholesky (AMD)"; }
  double work() const { return factor_.work(); }

  void solve(GeneralEquations& equations, double damping, ReducedSolution& solution) override {
    equations.eliminate(damping, false);
    reduced_.set(equations.reduced());
    factor_.factorize(reduced_.matrix());
    solution.is_solved = factor_.info() == Eigen::Success && (factor_.vectorD().array() > 0).all();
    if (!solution.is_solved) return;
    const Eigen::VectorXd x = factor_.solve(asVector(equations.rightSide()));
    solution.x.assign(x.data(), x.data() + x.size());
  }

 private:
  SparseReduced reduced_;
  SparseFactor factor_;
};

}  // namespace

GeneralFill neededFill(const OptimizerOptions& options) {
  const bool is_direct = options.linear_solver == LinearSolverKind::Dense ||
                         options.linear_solver == LinearSolverKind::Sparse;
  return options.schur == SchurKind::Implicit && !is_direct ? GeneralFill::Unreduced
                                                            : GeneralFill::Reduced;
}

std::unique_ptr<ReducedSolver> makeReducedSolver(const GeneralStructure& structure,
                                                 const OptimizerOptions& options) {
  using Kind = LinearSolverKind;
  const std::size_t n = structure.blocks.tangentSize();
  if (options.linear_solver == Kind::Dense) return std::make_unique<DenseReducedSolver>(structure);
  if (options.linear_solver == Kind::Sparse) {
    return std::make_unique<SparseReducedSolver>(structure);
  }
  if (options.linear_solver == Kind::Automatic && options.schur != SchurKind::Implicit) {
    const double part = 2 * double(structure.pattern.offset.back()) / (double(n) * double(n) + 1);
    if (n <= kSmall || (n <= kMedium && part >= kDense)) {
      return std::make_unique<DenseReducedSolver>(structure);
    }
    if (part < kDense) {
      auto sparse = std::make_unique<SparseReducedSolver>(structure);
      if (sparse->work() <= kMostSparseWork) return sparse;
    }
  }
  return makeIterativeSolver(structure, options);
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
