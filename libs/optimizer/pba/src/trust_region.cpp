#include "trust_region.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr double kLeastDamping = 1e-18;
constexpr double kMostDamping = 1e20;
constexpr std::size_t kMostFailures = 20;  // in a row: the damping has grown beyond all bounds

// Damping after H. B. Nielsen, "Damping parameter in Marquardt's method", 1999.
class Damping {
 public:
  explicit Damping(double initial) : value_(initial) {}
  double value() const { return value_; }
  void afterSuccess(double gain_ratio) {
    const double t = 2 * gain_ratio - 1;
    value_ = std::max(kLeastDamping, value_ * std::max(1.0 / 3, 1 - t * t * t));
    growth_ = 2;
  }
  void afterFailure() {
    value_ *= growth_;
    growth_ *= 2;
  }

 private:
  double value_;
  double growth_ = 2;
};

class Timer {
 public:
  explicit Timer(double& sum) : sum_(sum), start_(Clock::now()) {}
  ~Timer() { sum_ += secondsSince(start_); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

 private:
  double& sum_;
  Clock::time_point start_;
};

class Loop {
 public:
  Loop(TrustRegionProblem& problem, const OptimizerOptions& options, double damping,
       Clock::time_point start, OptimizerSummary& summary)
      : problem_(problem), options_(options), damping_(damping), start_(start), summary_(summary) {}

  void run() {
    summary_.times.setup = secondsSince(start_);
    if (!begin()) return;
    while (!isOver()) iterate();
    summary_.final_cost = cost_;
    summary_.is_usable = true;
  }

 private:
  bool begin() {
    linearize();
    if (!std::isfinite(cost_)) cost_ = std::numeric_limits<double>::infinity();
    summary_.initial_cost = summary_.final_cost = cost_;
    if (!std::isfinite(cost_)) {
      end(OptimizerStatus::Failed, "the cost has no finite value at the start");
      return false;
    }
    report(OptimizerIteration());
    if (!is_over_ && options_.max_iterations == 0) {
      end(OptimizerStatus::MaxIterations, "only the cost was asked for (max_iterations is 0)");
    }
    if (!is_over_) testGradient();
    return true;
  }

  void linearize() {
    const Timer timer(summary_.times.linearize);
    problem_.expectDamping(damping_.value());
    cost_ = problem_.linearize();
    gradient_max_ = problem_.gradientMax();
  }

  bool isOver() {
    if (is_over_) return true;
    if (tried_ >= options_.max_iterations) {
      end(OptimizerStatus::MaxIterations,
          "the last of " + std::to_string(options_.max_iterations) +
              " iterations reached no tolerance: allow more, or loosen the tolerances");
    } else if (options_.max_seconds > 0 && secondsSince(start_) >= options_.max_seconds) {
      end(OptimizerStatus::MaxTime, "the time was over before a tolerance was reached");
    }
    return is_over_;
  }

  void iterate() {
    ++tried_;
    OptimizerIteration iteration;
    iteration.damping = damping_.value();
    const LinearStep step = solve();
    iteration.step_norm = step.step_norm;
    iteration.linear_iterations = step.linear_iterations;
    const double old_cost = cost_;
    candidate_change_ = 0;
    const bool is_kept = step.is_solved && tryStep(step);
    iteration.is_successful = is_kept;
    iteration.cost_change = is_kept ? old_cost - cost_ : candidate_change_;
    if (is_kept) {
      testKeptStep(step, old_cost - cost_);
    } else {
      testFailedStep(step);
    }
    report(iteration);
  }

  LinearStep solve() {
    const Timer timer(summary_.times.solve);
    return problem_.solve(damping_.value());
  }

  bool tryStep(const LinearStep& step) {
    double candidate;
    {
      const Timer timer(summary_.times.evaluate);
      candidate = problem_.evaluateStep();
    }
    const double change = cost_ - candidate;
    candidate_change_ = std::isfinite(candidate) ? change : 0;
    if (!(std::isfinite(candidate) && change > 0 && step.model_decrease > 0)) return false;
    const double gain_ratio = change / step.model_decrease;
    if (gain_ratio < kLeastGain) return false;
    problem_.acceptStep();
    damping_.afterSuccess(gain_ratio);
    linearize();
    failures_ = 0;
    return true;
  }

  void testKeptStep(const LinearStep& step, double change) {
    testGradient();
    if (is_over_) return;
    if (change < options_.function_tolerance * std::fabs(cost_ + change)) {
      end(OptimizerStatus::Converged, "the last step lowered the cost by less than " +
                                          text(options_.function_tolerance) + " of it");
    } else {
      testStepLength(step);
    }
  }

  void testFailedStep(const LinearStep& step) {
    damping_.afterFailure();
    ++failures_;
    // At the minimum rounding decides whether a step lowers the cost.
    const bool promises_little =
        step.is_solved && step.model_decrease >= 0 &&
        step.model_decrease < std::max(options_.function_tolerance, kRounding) * std::fabs(cost_);
    if (promises_little) {
      end(OptimizerStatus::Converged, "the next step promised to lower the cost by less than " +
                                          text(options_.function_tolerance) + " of it");
    } else if (step.is_solved) {
      testStepLength(step);
    }
    if (!is_over_ && (failures_ >= kMostFailures || damping_.value() > kMostDamping)) {
      end(OptimizerStatus::Stalled, step.is_solved ? "no step lowers the cost, however short"
                                                   : "the equations of a step cannot be solved");
    }
  }

  void testGradient() {
    if (gradient_max_ <= options_.gradient_tolerance) {
      end(OptimizerStatus::Converged,
          "no element of the gradient is above " + text(options_.gradient_tolerance));
    }
  }

  void testStepLength(const LinearStep& step) {
    if (step.step_norm < options_.parameter_tolerance * (step.variable_norm + 1e-12)) {
      end(OptimizerStatus::Converged,
          "the step was shorter than " + text(options_.parameter_tolerance) + " of the variables");
    }
  }

  void report(OptimizerIteration iteration) {
    iteration.number = tried_;
    iteration.cost = cost_;
    iteration.gradient_max = gradient_max_;
    iteration.seconds = secondsSince(start_);
    summary_.iterations.push_back(iteration);
    if (options_.progress && !options_.progress(iteration) && !is_over_) {
      end(OptimizerStatus::Cancelled, "the progress function ended it");
    }
  }

  void end(OptimizerStatus status, const std::string& message) {
    is_over_ = true;
    summary_.status = status;
    summary_.message = message;
  }

  static std::string text(double number) {
    std::string digits(32, '\0');
    digits.resize(static_cast<std::size_t>(std::snprintf(&digits[0], digits.size(), "%g", number)));
    return digits;
  }

  static constexpr double kLeastGain = 1e-3;  // of what the model promised
  static constexpr double kRounding = 1e-15;  // of the cost

  TrustRegionProblem& problem_;
  const OptimizerOptions& options_;
  Damping damping_;
  Clock::time_point start_;
  OptimizerSummary& summary_;
  double cost_ = 0;
  double candidate_change_ = 0;
  double gradient_max_ = 0;
  std::size_t tried_ = 0;
  std::size_t failures_ = 0;
  bool is_over_ = false;
};

}  // namespace

void runTrustRegion(TrustRegionProblem& problem, const OptimizerOptions& options,
                    double default_damping, Clock::time_point start, OptimizerSummary& summary) {
  const double damping = options.initial_damping > 0 ? options.initial_damping : default_damping;
  Loop(problem, options, damping, start, summary).run();
  summary.times.total = secondsSince(start);
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
