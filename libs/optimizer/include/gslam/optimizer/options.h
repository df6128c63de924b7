#ifndef GSLAM_OPTIMIZER_OPTIONS_H
#define GSLAM_OPTIMIZER_OPTIONS_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

/// @file
/// How problems are solved: what every back end understands.

namespace gslam {
inline namespace v1 {

/// What a residual costs. With s the squared norm of a whitened residual (one that was multiplied
/// by the root of its information), and a = RobustLoss::scale, the cost is rho(s) / 2.
enum class LossKind {
  Squared,      ///< s
  Huber,        ///< s below a^2, then 2 a sqrt(s) - a^2
  Cauchy,       ///< a^2 log(1 + s / a^2)
  Tukey,        ///< a^2 / 3 (1 - (1 - s / a^2)^3) below a^2, then a^2 / 3
  GemanMcClure  ///< a^2 s / (a^2 + s). It is what remains of a switchable constraint (Suenderhauf,
                ///< Protzel, IROS 2012) with the prior a^2 once its switch has its best value
};

/// A robust loss.
struct RobustLoss {
  LossKind kind = LossKind::Squared;  ///< its form
  double scale = 1;  ///< a: where it begins to bend, in standard deviations where there is an
                     ///< information, else in the unit of the residual; positive
};

/// How the linear equations of a step are solved.
///
/// What a back end lacks it refuses, or replaces with a warning in the summary. For pose graphs pba
/// has no Dense, and takes Sparse, which is as exact; the equations of a pose, of an alignment and
/// of two views are so small that pba has one way for them. OptimizerSummary::linear_solver says
/// what was used.
enum class LinearSolverKind {
  Automatic,  ///< by size and density. Bundles with pinhole or BAL cameras in `pba`: Dense up to
              ///< 300 variables of poses and cameras, Iterative beyond
  Dense,      ///< Cholesky of the full (reduced) matrix; not for pose graphs with pba
  Sparse,     ///< Cholesky of the sparse (reduced) matrix
  Iterative   ///< preconditioned conjugate gradients
};

/// What makes conjugate gradients fast. Pose graphs have BlockJacobi alone.
enum class PreconditionerKind {
  Automatic,    ///< the back end's choice
  BlockJacobi,  ///< the diagonal blocks of the matrix before points are eliminated
  SchurJacobi,  ///< the diagonal blocks of the reduced matrix
  PowerSeries   ///< a truncated power series of the inverse (Weber, Demmel et al., "Power Bundle
                ///< Adjustment", CVPR 2023)
};

/// Whether points are eliminated into a matrix, or only in products with it.
enum class SchurKind {
  Automatic,  ///< by size and density. Bundles with pinhole or BAL cameras in `pba`: Implicit, with
              ///< iterative solvers, where points are seen by more than about 30 cameras, where the
              ///< matrix has more than 2 blocks an observation, and where it needs over 4 GiB
  Explicit,   ///< the reduced matrix is formed
  Implicit    ///< it is not: less memory, slower where many iterations are needed
};

/// With which numbers a step is computed. Costs, gradients and variables are double always.
enum class PrecisionKind {
  Automatic,  ///< the back end's choice
  Double,     ///< double throughout
  Mixed       ///< derivatives and conjugate gradients in float, their sums in double. Double where
              ///< pba has nothing else (its README says for which bundles it has); ceres refuses it
};

/// What happened in one iteration.
struct OptimizerIteration {
  std::size_t number = 0;   ///< from 0, which is the start
  double cost = 0;          ///< after it; see OptimizerSummary::final_cost
  double cost_change = 0;   ///< by how much it fell; negative for a step that was taken back
  double gradient_max = 0;  ///< largest element of the gradient
  double step_norm = 0;     ///< length of the step, in tangents
  double damping = 0;       ///< of Levenberg and Marquardt, relative to the diagonal
  std::size_t linear_iterations = 0;  ///< of conjugate gradients; 0 with a direct solver
  bool is_successful = true;          ///< whether the step was kept
  double seconds = 0;                 ///< since the start
};

/// How problems are solved. The defaults suit all problems of this library.
///
/// Thread-safety: plain data.
struct OptimizerOptions {
  /// Name of the back end, such as "pba" or "ceres"; empty: the first of these two that is there
  /// and can solve the problem.
  std::string backend;
  std::size_t max_iterations = 50;  ///< steps tried at most; 0: only the cost is computed
  /// Ends when a kept step lowers the cost by less than this part of it; 0: never.
  double function_tolerance = 1e-6;
  double gradient_tolerance = 1e-10;  ///< ends when no element of the gradient is larger
  /// Ends when a step is shorter than this part of the variables' own length; 0: never.
  double parameter_tolerance = 1e-8;
  /// Seconds after which no further step is begun; 0: no limit. With a limit results may differ
  /// from one call to the next.
  double max_seconds = 0;
  RobustLoss loss;  ///< of observations (not of priors); for pose graphs see PoseGraphProblem
  /// Damping of the first step, relative to the diagonal of the normal equations; 0: the back end's
  /// own.
  double initial_damping = 0;
  LinearSolverKind linear_solver = LinearSolverKind::Automatic;  ///< how steps are computed
  PreconditionerKind preconditioner =
      PreconditionerKind::Automatic;                   ///< of LinearSolverKind::Iterative
  SchurKind schur = SchurKind::Automatic;              ///< how points are eliminated
  PrecisionKind precision = PrecisionKind::Automatic;  ///< of steps
  std::size_t max_linear_iterations = 200;             ///< of conjugate gradients in a step
  /// Conjugate gradients end when the residual is this part of the right side, or less where the
  /// model of the cost changes by less than this part in an iteration. The fast bundles of `pba`
  /// divide it by the root of how many iterations the equations of a step cost, so that the fewer
  /// steps are the more exact the more a step costs.
  double linear_tolerance = 0.05;
  /// At work, the caller's among them; 0: as many as the machine has. The pba back end gives the
  /// same bits for any number.
  unsigned threads = 1;
  std::uint64_t seed = 1;  ///< of whatever is drawn at random
  /// Called after every iteration, by the thread that called; false ends the search, and what was
  /// found so far is kept. What it throws passes through; the variables are then those of the last
  /// kept step.
  std::function<bool(const OptimizerIteration&)> progress;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_OPTIONS_H
