#ifndef GSLAM_OPTIMIZER_PBA_SRC_TRUST_REGION_H
#define GSLAM_OPTIMIZER_PBA_SRC_TRUST_REGION_H

#include <gslam/optimizer/options.h>
#include <gslam/optimizer/summary.h>

#include <chrono>
#include <cstddef>

// The loop of Levenberg and Marquardt, for problems of every kind.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// A step that was computed but not yet taken.
struct LinearStep {
  bool is_solved = false;
  double model_decrease = 0;  // by how much the quadratic model of the cost falls; positive
  double step_norm = 0;       // length of the step in tangents
  double variable_norm = 0;   // length of the variables, for the parameter tolerance
  std::size_t linear_iterations = 0;
};

// What the loop asks of a problem. The problem holds variables and a step.
class TrustRegionProblem {
 public:
  virtual ~TrustRegionProblem() = default;
  // The damping that the next solve() will most likely have; comes before linearize(), for those
  // that form damped equations at once.
  virtual void expectDamping(double damping) { (void)damping; }
  // Residuals, derivatives, gradient and normal equations at the variables. The cost, half the sum
  // of rho; not finite where it has no value.
  virtual double linearize() = 0;
  virtual double gradientMax() const = 0;
  // Solves (H + damping D) step = -gradient, D the diagonal of H, from below and above bounded.
  virtual LinearStep solve(double damping) = 0;
  // The cost at the variables with the step; not finite where it has no value.
  virtual double evaluateStep() = 0;
  // The variables with the step become the variables. The next call is linearize().
  virtual void acceptStep() = 0;
};

using Clock = std::chrono::steady_clock;

// Seconds since `start`.
inline double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Runs the loop and fills status, message, costs, iterations and times.linearize/solve/evaluate of
// the summary. The problem then holds the best variables; the caller writes them back where
// summary.is_usable says so, and also where progress() throws, which passes through.
// `start` is when the solver was called: times.setup is what has passed since.
void runTrustRegion(TrustRegionProblem& problem, const OptimizerOptions& options,
                    double default_damping, Clock::time_point start, OptimizerSummary& summary);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_TRUST_REGION_H
