#include "solver_options.h"

#include <gslam/optimizer/backend.h>
#include <gslam/svar/error.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace app {
namespace {

using gslam::LossKind;

const std::vector<std::string> kLosses = {"squared", "huber", "cauchy", "tukey", "geman-mcclure"};
const std::vector<std::string> kResiduals = {"logarithm", "quaternion", "chordal"};
const std::vector<std::string> kSolvers = {"automatic", "dense", "sparse", "iterative"};
const std::vector<std::string> kPrecisions = {"automatic", "double", "mixed"};

// The place of an option's value among its choices, which are those of an enum.
template <class Enum>
Enum chosen(const Options& options, const char* name, const std::vector<std::string>& choices) {
  const std::string value = options.get<std::string>(name);
  const auto found = std::find(choices.begin(), choices.end(), value);
  return static_cast<Enum>(found - choices.begin());
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// "huber:2.5", "huber"
gslam::RobustLoss lossOf(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto kind = std::find(kLosses.begin(), kLosses.end(), text.substr(0, colon));
  if (kind == kLosses.end()) {
    throw gslam::ConfigError("--loss", "is '" + text + "', expected one of " + listed(kLosses) +
                                           ", and a colon and a scale behind it or not");
  }
  gslam::RobustLoss loss;
  loss.kind = static_cast<LossKind>(kind - kLosses.begin());
  if (colon == std::string::npos) return loss;
  const std::string scale = text.substr(colon + 1);
  char* end = nullptr;
  loss.scale = std::strtod(scale.c_str(), &end);
  const bool is_number = !scale.empty() && *end == '\0';
  if (is_number && loss.scale > 0 && std::isfinite(loss.scale)) return loss;
  throw gslam::ConfigError("--loss", "has the scale '" + scale + "', expected a number above 0");
}

std::string backendOf(const Options& options) {
  const std::string name = options.get<std::string>("backend");
  const std::vector<std::string> names = gslam::optimizerBackends();
  if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) return name;
  throw gslam::ConfigError(
      "--backend", "is '" + name + "', expected one of those that are here: " + listed(names));
}

}  // namespace

void declareSolver(Options& options) {
  options.arg<std::string>("backend", "", "pba or ceres; none: the first that can").group("Solver");
  options
      .arg<std::string>("loss", "squared",
                        "of observations and edges: " + listed(kLosses) +
                            "; where it bends behind a colon, huber:1")
      .group("Solver");
  options.arg<int>("iterations", 50, "steps tried at most").range(0, 1000000).group("Solver");
  options.arg<double>("seconds", 0, "after which no step is begun; 0: no limit")
      .range(0, 1e9)
      .group("Solver");
  options.arg<double>("tolerance", 1e-6, "ends when the cost falls by less than this part of it")
      .range(0, 1)
      .group("Solver");
  options.arg<int>("threads", 0, "at work; 0: as many as the machine has")
      .range(0, 4096)
      .group("Solver");
  options.arg<std::string>("solver", "automatic", "of the linear equations")
      .choices(kSolvers)
      .group("Solver");
  options.arg<std::string>("precision", "automatic", "of steps")
      .choices(kPrecisions)
      .group("Solver");
  options
      .arg<std::string>("residual", "logarithm",
                        "of pose graphs: logarithm of the error; quaternion, as g2o; chordal, as "
                        "SE-Sync, whose costs are twice ours")
      .choices(kResiduals)
      .group("Problem");
}

gslam::OptimizerOptions solverOf(const Options& options) {
  gslam::OptimizerOptions how;
  how.backend = backendOf(options);
  how.loss = lossOf(options.get<std::string>("loss"));
  how.max_iterations = static_cast<std::size_t>(options.get<int>("iterations"));
  how.max_seconds = options.get<double>("seconds");
  how.function_tolerance = options.get<double>("tolerance");
  how.threads = static_cast<unsigned>(options.get<int>("threads"));
  how.linear_solver = chosen<gslam::LinearSolverKind>(options, "solver", kSolvers);
  how.precision = chosen<gslam::PrecisionKind>(options, "precision", kPrecisions);
  return how;
}

gslam::PoseGraphResidual residualOf(const Options& options) {
  return chosen<gslam::PoseGraphResidual>(options, "residual", kResiduals);
}

}  // namespace app
