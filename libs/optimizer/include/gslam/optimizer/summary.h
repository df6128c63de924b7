#ifndef GSLAM_OPTIMIZER_SUMMARY_H
#define GSLAM_OPTIMIZER_SUMMARY_H

#include <gslam/optimizer/export.h>
#include <gslam/optimizer/options.h>

#include <cstddef>
#include <string>
#include <vector>

/// @file
/// What solving a problem gave.

namespace gslam {
inline namespace v1 {

/// Why a search ended.
enum class OptimizerStatus {
  Converged,      ///< one of the tolerances was reached
  MaxIterations,  ///< the last iteration that was allowed did not reach one
  MaxTime,        ///< the time was over
  Cancelled,      ///< the progress function said so
  Stalled,        ///< no step lowers the cost, and no tolerance was reached
  Failed          ///< the cost has no value at the start, or the equations cannot be solved
};

/// Where the time went, in seconds.
struct OptimizerTimes {
  double setup = 0;      ///< checks, orderings, memory
  double linearize = 0;  ///< residuals with derivatives
  double solve = 0;      ///< elimination and linear equations
  double evaluate = 0;   ///< residuals of steps that were tried
  double total = 0;      ///< all of it
};

/// What solving a problem gave. The variables stand in the problem; where is_usable is false they
/// are what they were.
struct OptimizerSummary {
  OptimizerStatus status = OptimizerStatus::Failed;  ///< why it ended
  std::string message;        ///< a sentence for people: what ended it, and what to do about it
  std::string backend;        ///< name of the back end
  std::string linear_solver;  ///< what it used, such as "explicit Schur, float, PCG block Jacobi"
  bool is_usable = false;     ///< whether the variables were written, and cost no more than before
  /// Half the sum of rho over all residuals, at the start; infinite where it has no value.
  double initial_cost = 0;
  double final_cost = 0;         ///< the same of the returned variables
  std::size_t residuals = 0;     ///< numbers in the residual vector, priors included
  std::size_t parameters = 0;    ///< degrees of freedom of all free variables
  std::size_t observations = 0;  ///< observations (or edges) that were used
  /// Observations that the camera model does not see at the start. They stay out to the end, also
  /// where it would see them then; those that are used must be seen after every step.
  std::size_t left_out = 0;
  /// Observations whose weight under the loss is at least a half, with the returned variables; all
  /// that are used without a loss.
  std::size_t inliers = 0;
  std::vector<OptimizerIteration> iterations;  ///< one by one, from the start on
  std::vector<std::string> warnings;           ///< sentences: what of the problem is suspect
  OptimizerTimes times;                        ///< where the time went

  /// Whether a tolerance was reached.
  bool hasConverged() const noexcept { return status == OptimizerStatus::Converged; }
};

/// Name of a status, such as "Converged".
GSLAM_OPTIMIZER_EXPORT const char* nameOf(OptimizerStatus status) noexcept;
/// Name of a loss, such as "Huber".
GSLAM_OPTIMIZER_EXPORT const char* nameOf(LossKind kind) noexcept;
/// A line for people: back end, status, iterations, costs, time.
GSLAM_OPTIMIZER_EXPORT std::string briefReport(const OptimizerSummary& summary);
/// A page for people: the same with sizes, the table of iterations, times and warnings.
GSLAM_OPTIMIZER_EXPORT std::string fullReport(const OptimizerSummary& summary);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SUMMARY_H
