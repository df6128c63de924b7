#include "solver_report.h"

#include <cmath>
#include <cstdio>
#include <iostream>

namespace app {
namespace {

using gslam::OptimizerIteration;
using gslam::OptimizerSummary;
using gslam::Svar;

// JSON has no infinities.
Svar numberOrNull(double value) {
  return std::isfinite(value) ? Svar(value) : Svar();
}

const char* graphKind(const gslam::AnyPoseGraph& graph) {
  static const char* const names[] = {"SE2", "SE3", "SIM3"};
  return names[graph.index()];
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

Svar describeIteration(const OptimizerIteration& iteration) {
  return Svar::object({{"number", iteration.number},
                       {"cost", numberOrNull(iteration.cost)},
                       {"cost_change", numberOrNull(iteration.cost_change)},
                       {"gradient_max", numberOrNull(iteration.gradient_max)},
                       {"step_norm", numberOrNull(iteration.step_norm)},
                       {"damping", numberOrNull(iteration.damping)},
                       {"linear_iterations", iteration.linear_iterations},
                       {"is_successful", iteration.is_successful},
                       {"seconds", iteration.seconds}});
}

}  // namespace

std::string contentText(const Problem& problem) {
  if (std::holds_alternative<gslam::Bundle>(problem)) {
    const gslam::Bundle& bundle = std::get<gslam::Bundle>(problem);
    return formatted("bundle of %zu poses, %zu cameras, %zu points, %zu observations",
                     bundle.T_world_body.size(), bundle.cameras.size(), bundle.points.size(),
                     bundle.pixels.size());
  }
  const gslam::AnyPoseGraph& any = std::get<1>(problem);
  return std::visit(
      [&](const auto& graph) {
        return formatted("pose graph in %s of %zu poses, %zu edges", graphKind(any),
                         graph.T_world_body.size(), graph.from.size());
      },
      any);
}

Svar describe(const Problem& problem) {
  if (std::holds_alternative<gslam::Bundle>(problem)) {
    const gslam::Bundle& bundle = std::get<gslam::Bundle>(problem);
    return Svar::object({{"kind", "bundle"},
                         {"poses", bundle.T_world_body.size()},
                         {"cameras", bundle.cameras.size()},
                         {"points", bundle.points.size()},
                         {"observations", bundle.pixels.size()}});
  }
  const gslam::AnyPoseGraph& any = std::get<1>(problem);
  return std::visit(
      [&](const auto& graph) {
        return Svar::object({{"kind", "pose graph"},
                             {"group", graphKind(any)},
                             {"poses", graph.T_world_body.size()},
                             {"edges", graph.from.size()}});
      },
      any);
}

std::string costsText(const OptimizerSummary& summary) {
  const auto text = [](double cost) {
    return std::isfinite(cost) ? formatted("%.9g", cost) : std::string("no value");
  };
  return text(summary.initial_cost) + " to " + text(summary.final_cost);
}

void printIterationHead() {
  std::cout << formatted("%9s %15s %11s %10s %10s %9s %6s %8s\n", "iteration", "cost", "change",
                         "gradient", "step", "damping", "linear", "time");
}

void printIteration(const OptimizerIteration& iteration) {
  std::cout << formatted("%9zu %15.9g %11.3g %10.2e %10.2e %9.1e %6zu %7.3fs%s\n", iteration.number,
                         iteration.cost, iteration.cost_change, iteration.gradient_max,
                         iteration.step_norm, iteration.damping, iteration.linear_iterations,
                         iteration.seconds, iteration.is_successful ? "" : " (taken back)")
            << std::flush;
}

void print(const OptimizerSummary& summary) {
  std::cout << "end          " << nameOf(summary.status) << ": " << summary.message
            << "\ncost         " << costsText(summary)
            << formatted(", of %zu residuals and %zu parameters", summary.residuals,
                         summary.parameters)
            << "\nobservations "
            << formatted("%zu used, %zu left out, %zu inliers", summary.observations,
                         summary.left_out, summary.inliers)
            << "\nsolver       " << summary.backend << ", " << summary.linear_solver
            << formatted(
                   "\ntime         %.3f s: setup %.3f, derivatives %.3f, equations %.3f, "
                   "costs %.3f\n",
                   summary.times.total, summary.times.setup, summary.times.linearize,
                   summary.times.solve, summary.times.evaluate);
  for (const std::string& warning : summary.warnings) std::cout << "warning: " << warning << '\n';
}

Svar describe(const OptimizerSummary& summary) {
  Svar iterations = Svar::array({}), warnings = Svar::array({});
  for (const OptimizerIteration& iteration : summary.iterations) {
    iterations.push_back(describeIteration(iteration));
  }
  for (const std::string& warning : summary.warnings) warnings.push_back(warning);
  return Svar::object({{"status", nameOf(summary.status)},
                       {"message", summary.message},
                       {"is_usable", summary.is_usable},
                       {"backend", summary.backend},
                       {"linear_solver", summary.linear_solver},
                       {"initial_cost", numberOrNull(summary.initial_cost)},
                       {"final_cost", numberOrNull(summary.final_cost)},
                       {"residuals", summary.residuals},
                       {"parameters", summary.parameters},
                       {"observations", summary.observations},
                       {"left_out", summary.left_out},
                       {"inliers", summary.inliers},
                       {"iterations", iterations},
                       {"warnings", warnings},
                       {"times", Svar::object({{"setup", summary.times.setup},
                                               {"linearize", summary.times.linearize},
                                               {"solve", summary.times.solve},
                                               {"evaluate", summary.times.evaluate},
                                               {"total", summary.times.total}})}});
}

}  // namespace app
