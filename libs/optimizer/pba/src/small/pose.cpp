#include <algorithm>
#include <cmath>
#include <limits>

#include "small/pose_cost.h"
#include "solvers.h"
#include "trust_region.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr double kFirstDamping = 1e-6;
constexpr double kDampingAfterFailure = 1e-3;  // at least
constexpr int kMostPoseFailures = 20;          // in a row
// Parts of the cost. Where the model promises less, rounding hides it.
constexpr double kRounding = 1e-15;
// Below the tolerance steps go on until they promise less than a tenth of its square, 1e-13: near
// the minimum each one squares the distance, so that it is one step more where residuals are small.
constexpr int kMostPolishing = 12;
// Where a step promises less, the loss is taken with its second derivative.
constexpr double kNearMinimum = 0.1;

// The loop of Levenberg and Marquardt in registers and on the stack: costs and normal equations
// come from the same pass, since nearly all steps are kept.
class PoseSolver {
 public:
  PoseSolver(const PoseProblem& problem, const SE3d& start, const OptimizerOptions& options)
      : options_(options),
        problem_(problem),
        cost_(problem, start, options.loss),
        T_(start),
        damping_(options.initial_damping > 0 ? options.initial_damping : kFirstDamping),
        is_robust_(options.loss.kind != LossKind::Squared) {
    result_.T_world_body = start;
    if (options.max_seconds > 0 || options.progress) began_ = Clock::now();
  }

  OptimizedPose solve() {
    now_ = cost_.at(T_, PoseCurvature::Weights);
    result_.initial_cost = result_.final_cost =
        std::isfinite(now_.cost) ? now_.cost : std::numeric_limits<double>::infinity();
    result_.observations = now_.seen;
    if (std::isfinite(now_.cost) && (now_.seen > 0 || problem_.prior != nullptr)) {
      report(OptimizerIteration());
      while (!is_over_ && !isOver()) iterate();
      finish();
    }
    if (!result_.is_usable) forget();
    return result_;
  }

 private:
  void end(OptimizerStatus status) {
    if (!is_over_) result_.status = status;
    is_over_ = true;
  }

  bool isOver() {
    if (now_.equations.gradientMax() <= options_.gradient_tolerance) {
      end(OptimizerStatus::Converged);
    } else if (result_.iterations >= options_.max_iterations) {
      end(polishing_ > 0 ? OptimizerStatus::Converged : OptimizerStatus::MaxIterations);
    } else if (options_.max_seconds > 0 && secondsSince(began_) >= options_.max_seconds) {
      end(polishing_ > 0 ? OptimizerStatus::Converged : OptimizerStatus::MaxTime);
    }
    return is_over_;
  }

  void iterate() {
    SE3d::Tangent step{};
    if (!solveDamped(now_.equations, damping_, step)) {
      if (is_full_) {  // indefinite
        linearize(PoseCurvature::Weights);
      } else {
        fail();
      }
      return;
    }
    const double promised = now_.equations.decrease(step);
    const double norm = step.norm();
    if (isSmall(promised, norm)) return end(OptimizerStatus::Converged);
    ++result_.iterations;
    OptimizerIteration iteration;
    iteration.damping = damping_;
    iteration.step_norm = norm;
    const SE3d T = T_ * SE3d::exp(step);
    const bool is_last = isLast(promised);
    const bool is_full = is_robust_ && promised < kNearMinimum * now_.cost && !is_last;
    const PoseValue next =
        cost_.at(T, is_full ? PoseCurvature::Full : PoseCurvature::Weights, is_last);
    iteration.cost_change = now_.cost - next.cost;
    iteration.is_successful = next.cost <= now_.cost;
    is_complete_ = iteration.is_successful && is_last;  // flags are those of the last evaluation
    if (iteration.is_successful) {
      T_ = T;
      is_full_ = is_full;
      keep(next, promised);
    } else if (promised < options_.function_tolerance * now_.cost) {
      end(OptimizerStatus::Converged);
    } else {
      fail();
    }
    report(iteration);
  }

  double polished() const {
    return std::max(0.1 * options_.function_tolerance * options_.function_tolerance, kRounding);
  }

  bool isSmall(double promised, double norm) const {
    if (promised <= (polishing_ > 0 ? polished() : kRounding) * now_.cost) return true;
    return norm <= options_.parameter_tolerance * std::sqrt(1 + T_.translation().squaredNorm());
  }

  // Whether the next step is likely to promise next to nothing: promises fall at least as they did.
  bool isLast(double promised) const {
    return promised < options_.function_tolerance * now_.cost &&
           promised * promised <= polished() * now_.cost * last_promised_;
  }

  void keep(const PoseValue& next, double promised) {
    const double change = now_.cost - next.cost;
    if (change < options_.function_tolerance * now_.cost && polishing_++ >= kMostPolishing) {
      end(OptimizerStatus::Converged);
    }
    now_ = next;
    last_promised_ = promised;
    const double gain = change / promised;
    if (gain > 0.75) damping_ *= 0.1;
    if (gain < 0.25) damping_ *= 4;
    growth_ = 4;
    failures_ = 0;
  }

  void fail() {
    damping_ = std::max(damping_ * growth_, kDampingAfterFailure);
    growth_ *= 2;
    if (++failures_ >= kMostPoseFailures) end(OptimizerStatus::Stalled);
  }

  void linearize(PoseCurvature curvature) {
    now_ = cost_.at(T_, curvature);
    is_full_ = curvature == PoseCurvature::Full;
  }

  void finish() {
    if (!is_complete_ && (is_full_ || !problem_.inliers.empty())) {
      now_ = cost_.at(T_, PoseCurvature::Weights, true);
    }
    result_.final_cost = now_.cost;
    result_.inliers = now_.inliers;
    result_.is_usable = invertSmall(now_.equations.hessian, result_.covariance) &&
                        now_.cost <= result_.initial_cost;
    if (result_.is_usable) {
      result_.T_world_body = T_;
    } else {
      result_.status = OptimizerStatus::Failed;
    }
  }

  void forget() {
    result_.final_cost = result_.initial_cost;
    result_.inliers = 0;
    result_.covariance = {};
    std::fill(problem_.inliers.begin(), problem_.inliers.end(), std::uint8_t(0));
  }

  void report(OptimizerIteration iteration) {
    if (!options_.progress) return;
    iteration.number = result_.iterations;
    iteration.cost = now_.cost;
    iteration.gradient_max = now_.equations.gradientMax();
    iteration.seconds = secondsSince(began_);
    if (!options_.progress(iteration)) end(OptimizerStatus::Cancelled);
  }

  const OptimizerOptions& options_;
  const PoseProblem& problem_;
  PoseCost cost_;
  Clock::time_point began_;
  OptimizedPose result_;
  SE3d T_;
  PoseValue now_;
  double damping_;
  double growth_ = 4;
  double last_promised_ = std::numeric_limits<double>::infinity();
  int failures_ = 0;
  int polishing_ = 0;
  const bool is_robust_;
  bool is_full_ = false;      // whether now_ has PoseCurvature::Full
  bool is_complete_ = false;  // whether it has the curvature and flags that are returned
  bool is_over_ = false;
};

}  // namespace

OptimizedPose solvePose(const PoseProblem& problem, const SE3d& T_world_body,
                        const OptimizerOptions& options) {
  return PoseSolver(problem, T_world_body, options).solve();
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
