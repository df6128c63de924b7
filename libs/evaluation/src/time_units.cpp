#include "time_units.h"

#include <gslam/base/error.h>
#include <gslam/core/stamp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace evaluation {
namespace {

// As double: sums of stamps never leave the range.
struct Range {
  double first, last;

  double duration() const { return last - first; }
  bool overlaps(const Range& other) const { return first <= other.last && other.first <= last; }
};

Range rangeOf(const Trajectory& trajectory, double offset = 0) {
  return {double(trajectory.front().stamp) + offset, double(trajectory.back().stamp) + offset};
}

bool isNear(double ratio, double factor, double slack) {
  return ratio > factor / slack && ratio < factor * slack;
}

// Whether the estimate's stamps would fit when multiplied by the factor: it lasts as long, with
// steps like the other's; or, where the two share no time, it would begin in the other's time.
bool wouldFit(const Range& reference, const Range& estimate, double step_ratio, double factor) {
  const double duration_ratio = reference.duration() / estimate.duration();
  if (isNear(duration_ratio, factor, 3) && isNear(step_ratio, factor, 100)) return true;
  const double slack = std::max(0.1 * std::fabs(reference.last), reference.duration());
  return !reference.overlaps(estimate) && estimate.first != 0 &&
         std::fabs(estimate.first * factor - reference.first) <= slack &&
         isNear(step_ratio, factor, 1000);
}

const char* unitOf(int power) {
  return power == 9 ? "seconds" : (power == 6 ? "milliseconds" : "microseconds");
}

[[noreturn]] void failUnits(int power, bool is_small) {
  const std::string times = "1e" + std::to_string(power) + " times ";
  const std::string unit = unitOf(power);
  throw ArgumentError(
      "stamps", "of the estimate are " + times + (is_small ? "smaller" : "larger") +
                    " than those of the reference: one file counts nanoseconds where the other "
                    "counts " +
                    unit + ". Say what the " + (is_small ? "reference" : "estimate") +
                    "'s count (--" + (is_small ? "ref" : "est") +
                    "-stamps nanoseconds, or the unit it has), or mend the file");
}

}  // namespace

double medianStep(const Trajectory& trajectory) {
  if (trajectory.size() < 2) return 0;
  std::vector<double> steps;
  steps.reserve(trajectory.size() - 1);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    steps.push_back(double(trajectory[i].stamp) - double(trajectory[i - 1].stamp));
  }
  const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

std::string secondsOf(double nanoseconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g s", nanoseconds * 1e-9);
  return text;
}

void checkUnits(const Trajectory& reference, const Trajectory& estimate, std::int64_t offset) {
  if (reference.size() < 2 || estimate.size() < 2) return;
  const Range a = rangeOf(reference), b = rangeOf(estimate, double(offset));
  const double step_ratio = medianStep(reference) / medianStep(estimate);
  double factor = 1;
  for (int power = 3; power <= 9; power += 3) {
    factor *= 1000;
    if (wouldFit(a, b, step_ratio, factor)) failUnits(power, true);
    if (wouldFit(a, b, step_ratio, 1 / factor)) failUnits(power, false);
  }
}

std::string whyNoPair(const Trajectory& reference, const Trajectory& estimate, std::int64_t offset,
                      std::int64_t max_dt) {
  const Range a = rangeOf(reference), b = rangeOf(estimate, double(offset));
  if (!a.overlaps(b)) {
    const double gap = b.first > a.last ? b.first - a.last : a.first - b.last;
    return "no pose of the estimate is in the time of the reference: the reference is from " +
           secondsOf(a.first) + " to " + secondsOf(a.last) + ", the estimate " + secondsOf(gap) +
           (b.first > a.last ? " later" : " earlier") +
           ". If it is of another clock, --time-offset auto looks for the offset";
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const StampedPose& pose : estimate) {
    const double at = double(pose.stamp) + double(offset);
    const auto after = std::lower_bound(
        reference.begin(), reference.end(), at,
        [](const StampedPose& one, double stamp) { return double(one.stamp) < stamp; });
    if (after != reference.end()) nearest = std::min(nearest, double(after->stamp) - at);
    if (after != reference.begin()) nearest = std::min(nearest, at - double((after - 1)->stamp));
  }
  return "no two poses are within " + secondsOf(double(max_dt)) + ": the nearest two are " +
         secondsOf(nearest) +
         " apart. A larger --max-dt, or --association interpolate with it, "
         "pairs them";
}

}  // namespace evaluation
}  // namespace v1
}  // namespace gslam
