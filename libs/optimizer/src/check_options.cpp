#include <gslam/base/error.h>
#include <gslam/optimizer/options.h>

#include <cmath>
#include <sstream>
#include <string>

#include "check_input.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

[[noreturn]] void refuseNumber(const char* name, double value, const char* expected) {
  std::ostringstream text;
  text << "is " << value << ", expected " << expected;
  throw ArgumentError(name, text.str());
}

void checkNotNegative(const char* name, double value) {
  // Written so that NaN fails.
  if (!(value >= 0 && std::isfinite(value))) {
    refuseNumber(name, value, "0 or more, and finite");
  }
}

template <class Enum>
void checkEnum(const char* name, Enum value, Enum last) {
  if (static_cast<int>(value) < 0 || value > last) {
    throw ArgumentError(name, "is " + std::to_string(static_cast<int>(value)) +
                                  ", expected one of the enumerators");
  }
}

}  // namespace

void checkLoss(const RobustLoss& loss, const char* name) {
  checkEnum(name, loss.kind, LossKind::GemanMcClure);
  if (!(loss.scale > 0 && std::isfinite(loss.scale))) {
    refuseNumber((std::string(name) + ".scale").c_str(), loss.scale, "above 0, and finite");
  }
}

void checkOptions(const OptimizerOptions& options) {
  checkNotNegative("options.function_tolerance", options.function_tolerance);
  checkNotNegative("options.gradient_tolerance", options.gradient_tolerance);
  checkNotNegative("options.parameter_tolerance", options.parameter_tolerance);
  checkNotNegative("options.max_seconds", options.max_seconds);
  checkNotNegative("options.initial_damping", options.initial_damping);
  checkLoss(options.loss, "options.loss");
  checkEnum("options.linear_solver", options.linear_solver, LinearSolverKind::Iterative);
  checkEnum("options.preconditioner", options.preconditioner, PreconditionerKind::PowerSeries);
  checkEnum("options.schur", options.schur, SchurKind::Implicit);
  checkEnum("options.precision", options.precision, PrecisionKind::Mixed);
  if (options.max_linear_iterations == 0) {
    throw ArgumentError("options.max_linear_iterations", "is 0, expected 1 or more");
  }
  if (!(options.linear_tolerance >= 0 && options.linear_tolerance < 1)) {
    refuseNumber("options.linear_tolerance", options.linear_tolerance, "0 or more and below 1");
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
