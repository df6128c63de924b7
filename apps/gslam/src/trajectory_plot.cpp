#include "trajectory_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <locale>
#include <sstream>

namespace app {
namespace {

constexpr double kFarthest = 1e12;  // metres; sums and products of these are exact enough

bool canBeDrawn(const gslam::Vec3d& position) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::abs(position[i]) <= kFarthest)) return false;  // also NaN
  }
  return true;
}

// How far poses go along each axis.
struct Box {
  std::array<double, 3> least, most;

  Box() {
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const std::vector<PlottedPose>& poses) {
    for (const PlottedPose& pose : poses) {
      if (!canBeDrawn(pose.position)) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        least[i] = std::min(least[i], pose.position[i]);
        most[i] = std::max(most[i], pose.position[i]);
      }
    }
  }
  bool isEmpty() const { return least[0] > most[0]; }
  double extent(std::size_t axis) const { return most[axis] - least[axis]; }
};

// The axis that is left out: the one along which there is least, of equals the last.
int shortestAxis(const Box& box) {
  int shortest = 2;
  for (const int axis : {1, 0}) {
    if (box.extent(std::size_t(axis)) < box.extent(std::size_t(shortest))) shortest = axis;
  }
  return shortest;
}

std::int64_t fiveMedianSteps(const std::vector<PlottedPose>& poses) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    steps.push_back(poses[i].stamp - poses[i - 1].stamp);
  }
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle > INT64_MAX / 5 ? INT64_MAX : 5 * *middle;
}

}  // namespace

PlotView viewOf(const TrajectoryPlot& plot) {
  PlotView view;
  Box box;
  box.add(plot.truth);
  if (box.isEmpty()) box.add(plot.estimate);
  if (box.isEmpty()) return view;
  const int left_out = shortestAxis(box);
  view.is_empty = false;
  view.right = left_out == 0 ? 1 : 0;
  view.up = left_out == 2 ? 1 : 2;
  box.add(plot.estimate);
  const std::size_t right = std::size_t(view.right), up = std::size_t(view.up);
  view.left = box.least[right];
  view.width = box.extent(right);
  view.bottom = box.least[up];
  view.height = box.extent(up);
  // All at one place, or so near that the numbers beside the grid could not tell: a metre around.
  const double size = std::max(std::abs(view.left), std::abs(view.bottom));
  if (std::max(view.width, view.height) < std::max(1e-9, 1e-9 * size)) {
    const double around = std::max(1.0, 1e-6 * size);
    view.left -= around / 2;
    view.bottom -= around / 2;
    view.width = view.height = around;
  }
  return view;
}

std::vector<PlotStroke> strokesOf(const std::vector<PlottedPose>& poses, const PlotView& view,
                                  std::int64_t longest_step) {
  if (longest_step <= 0) longest_step = fiveMedianSteps(poses);
  std::vector<PlotStroke> strokes;
  bool is_gap = true;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const PlottedPose& pose = poses[i];
    if (!canBeDrawn(pose.position)) {
      is_gap = true;
      continue;
    }
    if (is_gap || pose.stamp - poses[i - 1].stamp > longest_step) strokes.emplace_back();
    strokes.back().push_back(
        {pose.position[std::size_t(view.right)], pose.position[std::size_t(view.up)], pose.error});
    is_gap = false;
  }
  return strokes;
}

char axisName(int axis) {
  return "xyz"[axis];
}

double roundStep(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

std::string numberText(double value, double step) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  const double decimals = std::ceil(-std::log10(step) - 1e-9);
  out.precision(std::clamp(int(decimals), 0, 12));
  out << std::fixed << (std::abs(value) < step / 2 ? 0.0 : value);  // no -0
  return out.str();
}

std::string lengthText(double metres) {
  struct Unit {
    double metres;
    const char* name;
  };
  Unit unit = {1, " m"};
  if (metres < 1) unit = {0.01, " cm"};
  if (metres < 0.01) unit = {0.001, " mm"};
  if (metres >= 1000) unit = {1000, " km"};
  const double value = metres / unit.metres;
  const double digit = value < 1e-3 ? 1e-2 : std::pow(10, std::floor(std::log10(value)) - 2);
  return numberText(value, digit) + unit.name;
}

}  // namespace app
