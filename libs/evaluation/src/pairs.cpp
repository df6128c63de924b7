#include <gslam/base/error.h>
#include <gslam/core/associate.h>
#include <gslam/core/stamp.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/geometry/interpolate.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "time_units.h"

namespace gslam {
inline namespace v1 {
namespace {

constexpr const char* kAssociationNames[] = {"one-to-one", "interpolate", "evo"};

using Stamps = std::vector<std::int64_t>;

void checkTrajectory(const char* name, const Trajectory& trajectory) {
  if (trajectory.empty()) throw ArgumentError(name, "has no pose, expected one at least");
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const double* const numbers = trajectory[i].pose.data();
    for (std::size_t k = 0; k < 7; ++k) {
      if (std::isfinite(numbers[k])) continue;
      throw ArgumentError(name, "has pose number " + std::to_string(i) + ", of " +
                                    secondsText(trajectory[i].stamp) +
                                    " s, with an element that is not finite");
    }
  }
}

Stamps stampsOf(const Trajectory& trajectory, std::int64_t offset) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  if ((offset > 0 && trajectory.back().stamp > kMost - offset) ||
      (offset < 0 && trajectory.front().stamp < kLeast - offset)) {
    throw ArgumentError("time offset", "of " + std::to_string(offset) +
                                           " ns takes stamps out of the range of 64 bits");
  }
  Stamps stamps;
  stamps.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) stamps.push_back(pose.stamp + offset);
  return stamps;
}

std::uint64_t distance(std::int64_t a, std::int64_t b) {
  return a < b ? std::uint64_t(b) - std::uint64_t(a) : std::uint64_t(a) - std::uint64_t(b);
}

// What is left of a difference that a signed number cannot hold.
std::int64_t clamped(std::uint64_t nanoseconds) {
  constexpr auto kMost = std::uint64_t(std::numeric_limits<std::int64_t>::max());
  return std::int64_t(std::min(nanoseconds, kMost));
}

class Pairer {
 public:
  Pairer(const Trajectory& reference, const Trajectory& estimate, const AssociationOptions& how,
         std::int64_t offset)
      : reference_(reference),
        estimate_(estimate),
        reference_stamps_(stampsOf(reference, 0)),
        estimate_stamps_(stampsOf(estimate, offset)),
        max_dt_(how.is_numbered ? 0 : how.max_dt),
        is_reference_used_(reference.size()),
        is_estimate_used_(estimate.size()) {
    pairs_.time_offset = offset;
    pairs_.is_numbered = how.is_numbered;
  }

  PosePairs run(AssociationMethod method) {
    if (method == AssociationMethod::one_to_one) pairOneToOne();
    if (method == AssociationMethod::interpolate) pairInterpolated();
    if (method == AssociationMethod::evo) pairAsEvo();
    pairs_.dropped_reference = countUnused(is_reference_used_);
    pairs_.dropped_estimate = countUnused(is_estimate_used_);
    measureGap();
    return std::move(pairs_);
  }

 private:
  // A stamp in the other list between two of its poses, or at one of them.
  struct Place {
    std::size_t before, after;
    double part;
  };

  static std::size_t countUnused(const std::vector<bool>& used) {
    return std::size_t(std::count(used.begin(), used.end(), false));
  }

  void add(std::int64_t stamp, std::size_t i, std::size_t j, const SE3d& reference,
           const SE3d& estimate, std::uint64_t apart) {
    pairs_.stamps.push_back(stamp);
    pairs_.reference.push_back(reference);
    pairs_.estimate.push_back(estimate);
    pairs_.reference_places.push_back(i);
    pairs_.estimate_places.push_back(j);
    pairs_.max_apart = std::max(pairs_.max_apart, clamped(apart));
    is_reference_used_[i] = true;
    is_estimate_used_[j] = true;
  }

  void addOriginals(std::size_t i, std::size_t j) {
    add(reference_stamps_[i], i, j, reference_[i].pose, estimate_[j].pose,
        distance(reference_stamps_[i], estimate_stamps_[j]));
  }

  void pairOneToOne() {
    for (const StampPair& pair : associate(reference_stamps_, estimate_stamps_, max_dt_)) {
      addOriginals(pair.a, pair.b);
    }
  }

  // evo's matching_time_indices(): seconds as double, the first of those that are as near.
  void pairAsEvo() {
    const bool reference_drives = estimate_.size() > reference_.size();
    const std::vector<double> drivers = secondsOf(reference_drives ? reference_ : estimate_);
    std::vector<double> others = secondsOf(reference_drives ? estimate_ : reference_);
    const double offset = double(pairs_.time_offset) * 1e-9;
    for (double& other : others) other += reference_drives ? offset : -offset;
    const double max_dt = double(max_dt_) * 1e-9;
    for (std::size_t i = 0; i < drivers.size(); ++i) {
      const std::size_t j = nearest(others, drivers[i]);
      if (std::fabs(others[j] - drivers[i]) > max_dt) continue;
      if (reference_drives) addOriginals(i, j);
      if (!reference_drives) addOriginals(j, i);
    }
  }

  // As the text of the file gives when it is read as a double: divided with more digits, rounded.
  static std::vector<double> secondsOf(const Trajectory& trajectory) {
    std::vector<double> seconds;
    seconds.reserve(trajectory.size());
    for (const StampedPose& pose : trajectory) {
      seconds.push_back(double(static_cast<long double>(pose.stamp) / 1e9L));
    }
    return seconds;
  }

  static std::size_t nearest(const std::vector<double>& ascending, double value) {
    const auto after = std::lower_bound(ascending.begin(), ascending.end(), value);
    std::size_t best = std::size_t(after - ascending.begin());
    if (best == ascending.size() ||
        (best > 0 && value - ascending[best - 1] <= ascending[best] - value)) {
      --best;
    }
    while (best > 0 && ascending[best - 1] == ascending[best]) --best;
    return best;
  }

  void pairInterpolated() {
    const double reference_step = evaluation::medianStep(reference_);
    const double estimate_step = evaluation::medianStep(estimate_);
    // One pose alone cannot be between others, so the other is what is interpolated.
    const bool estimate_drives =
        estimate_.size() < 2 || (reference_.size() >= 2 && reference_step <= estimate_step);
    if (estimate_drives) {
      interpolateAt(estimate_stamps_, reference_stamps_, reference_,
                    [this](std::size_t i, const Place& p, const SE3d& pose, std::uint64_t apart) {
                      add(estimate_stamps_[i], p.before, i, pose, estimate_[i].pose, apart);
                      is_reference_used_[p.after] = true;
                    });
    } else {
      interpolateAt(reference_stamps_, estimate_stamps_, estimate_,
                    [this](std::size_t i, const Place& p, const SE3d& pose, std::uint64_t apart) {
                      add(reference_stamps_[i], i, p.before, reference_[i].pose, pose, apart);
                      is_estimate_used_[p.after] = true;
                    });
    }
  }

  template <class Add>
  void interpolateAt(const Stamps& drivers, const Stamps& others, const Trajectory& poses,
                     const Add& add_pair) {
    for (std::size_t i = 0; i < drivers.size(); ++i) {
      Place place;
      std::uint64_t apart;
      if (!findPlace(others, drivers[i], place, apart)) continue;
      const SE3d& before = poses[place.before].pose;
      const SE3d pose = place.before == place.after
                            ? before
                            : gslam::interpolate(before, poses[place.after].pose, place.part);
      add_pair(i, place, pose, apart);
    }
  }

  bool findPlace(const Stamps& stamps, std::int64_t stamp, Place& place,
                 std::uint64_t& apart) const {
    const auto after = std::lower_bound(stamps.begin(), stamps.end(), stamp);
    if (after == stamps.end()) return false;
    const std::size_t j = std::size_t(after - stamps.begin());
    place = {j, j, 0};
    apart = 0;
    if (*after == stamp) return true;
    if (j == 0) return false;
    const std::uint64_t left = distance(stamps[j - 1], stamp), right = distance(stamps[j], stamp);
    place = {j - 1, j, double(left) / (double(left) + double(right))};
    apart = std::min(left, right);
    return apart <= std::uint64_t(max_dt_);
  }

  void measureGap() {
    std::uint64_t gap = 0;
    std::int64_t last = reference_stamps_.front();
    for (const std::int64_t stamp : pairs_.stamps) {
      if (stamp > last) gap = std::max(gap, distance(last, stamp));
      last = std::max(last, stamp);
    }
    if (reference_stamps_.back() > last) {
      gap = std::max(gap, distance(last, reference_stamps_.back()));
    }
    pairs_.max_gap = clamped(gap);
  }

  const Trajectory& reference_;
  const Trajectory& estimate_;
  Stamps reference_stamps_;
  Stamps estimate_stamps_;
  std::int64_t max_dt_;
  std::vector<bool> is_reference_used_;
  std::vector<bool> is_estimate_used_;
  PosePairs pairs_;
};

void checkOptions(const AssociationOptions& options) {
  if (options.max_dt < 0) {
    throw ArgumentError("max_dt",
                        "is " + std::to_string(options.max_dt) + " ns, expected 0 or more");
  }
  if (!options.is_numbered) return;
  if (options.method == AssociationMethod::interpolate) {
    throw ArgumentError("association",
                        "by interpolation needs times, but the stamps number "
                        "frames; expected one-to-one or evo, or the frames' times");
  }
  if (options.finds_offset || options.time_offset != 0) {
    throw ArgumentError("time offset", "needs times, but the stamps number frames");
  }
}

TimeOffset offsetOf(const Trajectory& reference, const Trajectory& estimate,
                    const AssociationOptions& options) {
  TimeOffset result;
  result.offset = options.time_offset;
  if (!options.finds_offset) return result;
  result = estimateTimeOffset(reference, estimate);
  if (result.is_valid) return result;
  throw ArgumentError("time offset",
                      "cannot be found: " + result.reason + ". Say what it is: --time-offset");
}

}  // namespace

const char* associationMethodName(AssociationMethod method) noexcept {
  const auto i = static_cast<std::size_t>(method);
  return i < 3 ? kAssociationNames[i] : "unknown";
}

AssociationMethod associationMethod(const std::string& name) {
  for (std::uint8_t i = 0; i < 3; ++i) {
    if (name == kAssociationNames[i]) return static_cast<AssociationMethod>(i);
  }
  throw ArgumentError("association", "is '" + name + "', expected one-to-one, interpolate or evo");
}

PosePairs pairPoses(const Trajectory& reference, const Trajectory& estimate,
                    const AssociationOptions& options) {
  checkTrajectory("reference", reference);
  checkTrajectory("estimate", estimate);
  checkOptions(options);
  if (!options.is_numbered) evaluation::checkUnits(reference, estimate, options.time_offset);
  const TimeOffset offset = offsetOf(reference, estimate, options);
  PosePairs pairs = Pairer(reference, estimate, options, offset.offset).run(options.method);
  pairs.offset_correlation = offset.correlation;
  if (pairs.size() > 0) return pairs;
  if (options.is_numbered) {
    throw ArgumentError("frames", "of the two have no number in common");
  }
  throw ArgumentError(
      "stamps",
      "do not meet: " + evaluation::whyNoPair(reference, estimate, offset.offset, options.max_dt));
}

}  // namespace v1
}  // namespace gslam
