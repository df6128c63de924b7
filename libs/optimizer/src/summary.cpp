#include <gslam/optimizer/summary.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

namespace gslam {
inline namespace v1 {
namespace {

// printf into a string.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  const int length = std::snprintf(nullptr, 0, format, values...);
  std::string text(static_cast<std::size_t>(std::max(length, 0)) + 1, '\0');
  std::snprintf(&text[0], text.size(), format, values...);
  text.pop_back();
  return text;
}

// 12.3 us, 4.56 ms, 7.89 s.
std::string durationText(double seconds) {
  if (seconds < 1e-3) return formatted("%.3g us", seconds * 1e6);
  if (seconds < 1) return formatted("%.3g ms", seconds * 1e3);
  return formatted("%.4g s", seconds);
}

std::string countText(std::size_t count, const char* of) {
  return std::to_string(count) + " " + of + (count == 1 ? "" : "s");
}

// Steps that were tried; the start is none.
std::size_t stepsOf(const OptimizerSummary& summary) {
  return summary.iterations.empty() ? 0 : summary.iterations.size() - 1;
}

// Where residuals have no value, there is no cost.
std::string costText(const char* format, double cost) {
  return std::isfinite(cost) ? formatted(format, cost) : "no value";
}

// "1.5e+03 -> 1.2e+01, 99.20 % less"
std::string costsText(const OptimizerSummary& summary) {
  const double before = summary.initial_cost, after = summary.final_cost;
  const std::string text = costText("%.6e", before) + " -> " + costText("%.6e", after);
  // Of a cost that is not positive, as priors may make it, there is no part.
  if (!(before > 0 && std::isfinite(before) && std::isfinite(after))) return text;
  return text + formatted(", %.2f %% less", 100 * (1 - after / before));
}

std::string reportRow(const char* name, const std::string& value) {
  return formatted("%-15s", name) + value + "\n";
}

std::string sizesText(const OptimizerSummary& summary) {
  std::string text = std::to_string(summary.observations) + " used";
  if (summary.left_out != 0) text += ", " + std::to_string(summary.left_out) + " left out";
  return text + ", " + std::to_string(summary.inliers) + " inliers";
}

std::string tableOfIterations(const OptimizerSummary& summary) {
  if (summary.iterations.empty()) return "";
  std::string text = formatted("\n%5s  %13s  %10s  %9s  %9s  %9s  %6s  %8s\n", "iter", "cost",
                               "change", "gradient", "step", "damping", "linear", "time");
  for (const OptimizerIteration& one : summary.iterations) {
    text += formatted("%5zu  %13.6e  %10.2e  %9.2e  %9.2e  %9.2e  %6zu  %8.3g s%s\n", one.number,
                      one.cost, one.cost_change, one.gradient_max, one.step_norm, one.damping,
                      one.linear_iterations, one.seconds, one.is_successful ? "" : "  taken back");
  }
  return text;
}

std::string timesText(const OptimizerTimes& times) {
  const auto row = [&](const char* name, double seconds) {
    const double part = times.total > 0 ? 100 * seconds / times.total : 0;
    return reportRow(name, formatted("%-10s %5.1f %%", durationText(seconds).c_str(), part));
  };
  return "\n" + row("setup", times.setup) + row("linearize", times.linearize) +
         row("solve", times.solve) + row("evaluate", times.evaluate) + row("total", times.total);
}

}  // namespace

const char* nameOf(OptimizerStatus status) noexcept {
  switch (status) {
    case OptimizerStatus::Converged:
      return "Converged";
    case OptimizerStatus::MaxIterations:
      return "MaxIterations";
    case OptimizerStatus::MaxTime:
      return "MaxTime";
    case OptimizerStatus::Cancelled:
      return "Cancelled";
    case OptimizerStatus::Stalled:
      return "Stalled";
    case OptimizerStatus::Failed:
      return "Failed";
  }
  return "unknown";
}

const char* nameOf(LossKind kind) noexcept {
  switch (kind) {
    case LossKind::Squared:
      return "Squared";
    case LossKind::Huber:
      return "Huber";
    case LossKind::Cauchy:
      return "Cauchy";
    case LossKind::Tukey:
      return "Tukey";
    case LossKind::GemanMcClure:
      return "GemanMcClure";
  }
  return "unknown";
}

std::string briefReport(const OptimizerSummary& summary) {
  std::string text = summary.backend.empty() ? "" : summary.backend + ": ";
  text += nameOf(summary.status);
  if (!summary.is_usable) text += ", not usable";
  text += " after " + countText(stepsOf(summary), "iteration") + ", cost " +
          costText("%.6g", summary.initial_cost) + " -> " + costText("%.6g", summary.final_cost) +
          ", " + durationText(summary.times.total);
  const std::size_t warnings = summary.warnings.size();
  return warnings == 0 ? text : text + ", " + countText(warnings, "warning");
}

std::string fullReport(const OptimizerSummary& summary) {
  std::string text = reportRow(
      "status", std::string(nameOf(summary.status)) + (summary.is_usable ? "" : ", not usable"));
  if (!summary.message.empty()) text += reportRow("", summary.message);
  text += reportRow("back end", summary.backend);
  text += reportRow("linear solver", summary.linear_solver);
  text += reportRow("parameters", std::to_string(summary.parameters));
  text += reportRow("residuals", std::to_string(summary.residuals));
  text += reportRow("observations", sizesText(summary));
  text += reportRow("cost", costsText(summary));
  text += tableOfIterations(summary) + timesText(summary.times);
  for (const std::string& warning : summary.warnings) text += "\nwarning: " + warning;
  if (!summary.warnings.empty()) text += "\n";
  return text;
}

}  // namespace v1
}  // namespace gslam
