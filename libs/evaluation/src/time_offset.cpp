#include <gslam/evaluation/align.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/geometry/vec.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "time_units.h"

namespace gslam {
inline namespace v1 {
namespace {

constexpr double kRange = 10;  // seconds about zero
constexpr double kCell = 0.2;  // seconds over which a speed is taken
constexpr double kLeastCorrelation = 0.3;
constexpr double kFarthest = 4e9;     // seconds; beyond, a sum of stamps may not fit
constexpr double kMostCells = 20000;  // bounds what a search takes, however long a sequence is

// As a difference of stamps: seconds since 1970 would lose digits.
double secondsFrom(std::int64_t begin, std::int64_t stamp) {
  const bool is_later = stamp >= begin;
  const std::uint64_t apart = is_later ? std::uint64_t(stamp) - std::uint64_t(begin)
                                       : std::uint64_t(begin) - std::uint64_t(stamp);
  return (is_later ? 1e-9 : -1e-9) * double(apart);
}

// Poses at any time between the first and the last. How far apart two of them are, a fifth of a
// second and more from one another, says how fast something goes; the way from pose to pose would
// say how much the poses tremble.
class Way {
 public:
  explicit Way(const Trajectory& trajectory) : trajectory_(trajectory) {
    times_.reserve(trajectory.size());
    for (const StampedPose& pose : trajectory) {
      times_.push_back(secondsFrom(trajectory.front().stamp, pose.stamp));
    }
  }

  double first() const { return times_.front(); }
  double last() const { return times_.back(); }

  struct Place {
    Vec3d position;
    Vec<double, 4> rotation;  // of length 1 nearly
  };

  // At ascending times, all inside; from the pose on that the last call left.
  Place at(double time, std::size_t& i) const {
    while (i + 2 < times_.size() && times_[i + 1] < time) ++i;
    const double part = (time - times_[i]) / (times_[i + 1] - times_[i]);
    const SE3d &a = trajectory_[i].pose, &b = trajectory_[i + 1].pose;
    const Vec<double, 4>&p = a.rotation().quaternion(), &q = b.rotation().quaternion();
    const double sign = p.dot(q) < 0 ? -1 : 1;
    return {(1 - part) * a.translation() + part * b.translation(),
            ((1 - part) * p + (sign * part) * q).normalized()};
  }

  std::size_t placeOf(double time) const {
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    const std::ptrdiff_t i = std::max<std::ptrdiff_t>(after - times_.begin() - 1, 0);
    return std::min(std::size_t(i), times_.size() - 2);
  }

 private:
  const Trajectory& trajectory_;
  std::vector<double> times_;
};

double moved(const Way::Place& a, const Way::Place& b) {
  return (b.position - a.position).norm();
}

// Twice the sine of half the angle.
double turned(const Way::Place& a, const Way::Place& b) {
  const double cosine = a.rotation.dot(b.rotation);
  return 2 * std::sqrt(std::max(0.0, 1 - cosine * cosine));
}

// Pearson's correlation of two lists, one number at a time.
struct Correlation {
  double count = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  void add(double x, double y) {
    ++count;
    a += x;
    b += y;
    aa += x * x;
    bb += y * y;
    ab += x * y;
  }
  // Whether both vary by more than rounding does.
  bool varies() const {
    return aa * count - a * a > 1e-9 * aa * count && bb * count - b * b > 1e-9 * bb * count;
  }
  double value() const {
    if (!varies()) return 0;
    return (count * ab - a * b) / std::sqrt((count * aa - a * a) * (count * bb - b * b));
  }
};

class OffsetSearch {
 public:
  OffsetSearch(const Way& reference, const Way& estimate)
      : reference_(reference), estimate_(estimate) {}

  // Mean of the correlations of the speeds that vary, where the two overlap by half of the shorter;
  // -1 where they do not.
  double correlation(double offset, double cell) const {
    const double begin = std::max(reference_.first(), estimate_.first() + offset);
    const double end = std::min(reference_.last(), estimate_.last() + offset);
    const double shorter =
        std::min(reference_.last() - reference_.first(), estimate_.last() - estimate_.first());
    const auto cells = static_cast<std::size_t>(std::max(0.0, (end - begin) / cell));
    if (end - begin < 0.5 * shorter || cells < 8) return -1;
    Correlation moving, turning;
    std::size_t i = reference_.placeOf(begin), j = estimate_.placeOf(begin - offset);
    Way::Place a = reference_.at(begin, i), b = estimate_.at(begin - offset, j);
    for (std::size_t k = 1; k <= cells; ++k) {
      const double time = begin + double(k) * cell;
      const Way::Place next_a = reference_.at(time, i), next_b = estimate_.at(time - offset, j);
      moving.add(moved(a, next_a), moved(b, next_b));
      turning.add(turned(a, next_a), turned(b, next_b));
      a = next_a;
      b = next_b;
    }
    const int varying = int(moving.varies()) + int(turning.varies());
    return varying == 0 ? -1 : (moving.value() + turning.value()) / varying;
  }

  double best(double from, double to, double step, double cell) const {
    double result = 0, most = -2;
    const auto steps = static_cast<std::size_t>((to - from) / step);
    for (std::size_t i = 0; i <= steps; ++i) {
      const double offset = from + double(i) * step;
      const double value = correlation(offset, cell);
      if (value > most) most = value, result = offset;
    }
    return result;
  }

 private:
  const Way& reference_;
  const Way& estimate_;
};

// The place of the least value, by golden section; there should be one valley.
template <class Function>
double leastPlace(double from, double to, const Function& function) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double x = to - golden * (to - from), y = from + golden * (to - from);
  double fx = function(x), fy = function(y);
  while (to - from > 1e-6) {
    if (fx <= fy) {
      to = y, y = x, fy = fx;
      x = to - golden * (to - from), fx = function(x);
    } else {
      from = x, x = y, fx = fy;
      y = from + golden * (to - from), fy = function(y);
    }
  }
  return 0.5 * (from + to);
}

// How well positions fit at an offset: the mean squared distance after a similarity over those that
// are inside of the reference. Speeds tell offsets apart over minutes, positions tell milliseconds:
// the noise of poses counts once there, not divided by a small step.
class PositionFit {
 public:
  PositionFit(const Trajectory& reference, const Trajectory& estimate)
      : reference_(reference), estimate_(estimate), stride_(1 + estimate.size() / kMostPositions) {}

  // Infinite where nothing can be said.
  double at(std::int64_t offset) const {
    std::vector<Vec3d> world, map;
    for (std::size_t i = 0; i < estimate_.size(); i += stride_) {
      Vec3d position{};
      if (!positionAt(estimate_[i].stamp + offset, position)) continue;
      world.push_back(position);
      map.push_back(estimate_[i].pose.translation());
    }
    constexpr double kNothing = std::numeric_limits<double>::infinity();
    if (world.size() < 10 || 2 * stride_ * world.size() < estimate_.size()) return kNothing;
    AlignmentOptions how;
    how.method = AlignmentMethod::sim3;
    const Alignment alignment = alignPositions(world, map, how);
    if (!alignment.is_valid) return kNothing;
    double sum = 0;
    for (std::size_t i = 0; i < world.size(); ++i) {
      sum += (alignment.S_world_map * map[i] - world[i]).squaredNorm();
    }
    return sum / double(world.size());
  }

 private:
  static constexpr std::size_t kMostPositions = 4000;

  bool positionAt(std::int64_t stamp, Vec3d& position) const {
    const auto after = reference_.lowerBound(stamp);
    if (after == reference_.end() || after == reference_.begin()) return false;
    const auto before = after - 1;
    const double part = double(stamp - before->stamp) / double(after->stamp - before->stamp);
    position = (1 - part) * before->pose.translation() + part * after->pose.translation();
    return true;
  }

  const Trajectory& reference_;
  const Trajectory& estimate_;
  std::size_t stride_;
};

// The offset within a range (seconds) about a found one at which positions fit best; the found one
// where they do not tell.
std::int64_t refinedByPositions(const Trajectory& reference, const Trajectory& estimate,
                                std::int64_t found, double range) {
  const PositionFit fit(reference, estimate);
  const auto offsetAt = [found](double s) { return found + std::int64_t(std::llround(1e9 * s)); };
  const std::int64_t best =
      offsetAt(leastPlace(-range, range, [&](double s) { return fit.at(offsetAt(s)); }));
  return fit.at(best) < fit.at(found) ? best : found;
}

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

}  // namespace

TimeOffset estimateTimeOffset(const Trajectory& reference, const Trajectory& estimate) {
  TimeOffset result;
  if (reference.size() < 10 || estimate.size() < 10) {
    result.reason = "a trajectory has fewer than 10 poses";
    return result;
  }
  // Times count from the begin of each.
  const Way a(reference), b(estimate);
  const double apart = secondsFrom(estimate.front().stamp, reference.front().stamp);
  if (std::fabs(apart) > kFarthest || a.last() > kFarthest || b.last() > kFarthest) {
    result.reason = "the two reach over centuries";
    return result;
  }
  const bool overlaps = apart <= b.last() && -apart <= a.last();
  const double centre = overlaps ? -apart : 0.5 * (a.last() - b.last());
  const double range = overlaps ? kRange : 0.5 * (a.last() + b.last());
  const double shorter = std::min(a.last(), b.last());
  const double step =
      1e-9 * std::max(evaluation::medianStep(reference), evaluation::medianStep(estimate));
  const double cell =
      std::max({std::min(kCell, shorter / 32), 2 * step, shorter / kMostCells, range / 4000});
  const OffsetSearch search(a, b);
  double offset = search.best(centre - range, centre + range, 0.25 * cell, cell);
  offset = leastPlace(offset - 0.5 * cell, offset + 0.5 * cell,
                      [&](double at) { return -search.correlation(at, cell); });
  result.correlation = search.correlation(offset, cell);
  if (result.correlation < kLeastCorrelation) {
    result.reason = result.correlation <= -1
                        ? "the speeds do not vary, or the two overlap by less than half"
                        : "the speeds of the two do not go together (correlation " +
                              numberText(result.correlation) + ")";
    return result;
  }
  result.is_valid = true;
  // From the begins of both to their clocks.
  const std::int64_t found =
      (reference.front().stamp - estimate.front().stamp) + std::int64_t(std::llround(offset * 1e9));
  result.offset = refinedByPositions(reference, estimate, found, cell);
  return result;
}

}  // namespace v1
}  // namespace gslam
