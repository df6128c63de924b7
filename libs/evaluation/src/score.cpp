#include <gslam/base/error.h>
#include <gslam/evaluation/score.h>
#include <gslam/geometry/interpolate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "time_units.h"

namespace gslam {
inline namespace v1 {
namespace {

// A pose of the estimate and that of the reference at its stamp.
struct Meeting {
  std::size_t slot;
  SE3d reference, estimate;
};

// Slots in which a part of the way begins and ends.
struct Part {
  std::size_t first, last;
};

// Scales for which something is right.
struct Interval {
  double least, most;
};

class Scorer {
 public:
  Scorer(const Trajectory& reference, const Trajectory& estimate, const ScoreOptions& options)
      : reference_(reference), options_(options) {
    if (options.is_numbered) options_.slot = 1;
    measureWay();
    options_.length = options.length > 0 ? options.length : 0.1 * ways_.back();
    findParts();
    findMeetings(estimate);
  }

  Score run() const {
    Score score;
    score.length = options_.length;
    score.parts = parts_.size();
    if (parts_.empty()) {
      score.reason = ways_.back() > 0 ? "the way of the reference is shorter than a part"
                                      : "the reference does not move";
      return score;
    }
    score.is_valid = true;
    for (const double threshold : options_.thresholds) {
      score.levels.push_back(options_.has_scale ? bestScale(threshold) : atScaleOne(threshold));
      score.value += score.levels.back().fraction / double(options_.thresholds.size());
    }
    return score;
  }

 private:
  std::size_t slotOf(std::int64_t stamp) const {
    const std::uint64_t since = std::uint64_t(stamp) - std::uint64_t(reference_.front().stamp);
    return std::size_t(since / std::uint64_t(options_.slot));
  }

  // How far the reference has gone, up to each of its poses.
  void measureWay() {
    ways_.reserve(reference_.size());
    double way = 0;
    for (std::size_t i = 0; i < reference_.size(); ++i) {
      if (i > 0) {
        way += (reference_[i].pose.translation() - reference_[i - 1].pose.translation()).norm();
      }
      ways_.push_back(way);
    }
  }

  // A part from each slot that has a pose of the reference. Two marks, because both only move on.
  void findParts() {
    if (!(options_.length > 0)) return;
    std::size_t j = 0;
    for (std::size_t i = 0; i < reference_.size(); ++i) {
      const std::size_t slot = slotOf(reference_[i].stamp);
      if (i > 0 && slot == slotOf(reference_[i - 1].stamp)) continue;
      while (j < ways_.size() && ways_[j] - ways_[i] < options_.length * (1 - 1e-9)) ++j;
      if (j == ways_.size()) return;
      parts_.push_back({slot, slotOf(reference_[j].stamp)});
    }
  }

  // Each pose of the estimate for itself, whatever others there are.
  void findMeetings(const Trajectory& estimate) {
    const double gap = std::max(1e9, 5 * evaluation::medianStep(reference_));
    for (const StampedPose& pose : estimate) {
      const std::int64_t offset = options_.time_offset;
      const bool overflows =
          offset > 0 ? pose.stamp > INT64_MAX - offset : pose.stamp < INT64_MIN - offset;
      if (overflows) continue;
      const std::int64_t stamp = pose.stamp + offset;
      const auto after = reference_.lowerBound(stamp);
      if (after == reference_.end()) continue;
      if (after->stamp == stamp) {
        meetings_.push_back({slotOf(stamp), after->pose, pose.pose});
        continue;
      }
      if (after == reference_.begin() || options_.is_numbered) continue;
      const auto before = after - 1;
      const double left = double(std::uint64_t(stamp) - std::uint64_t(before->stamp));
      const double right = double(std::uint64_t(after->stamp) - std::uint64_t(stamp));
      if (left + right > gap) continue;
      meetings_.push_back({slotOf(stamp),
                           interpolate(before->pose, after->pose, left / (left + right)),
                           pose.pose});
    }
  }

  std::pair<const Meeting*, const Meeting*> inSlot(std::size_t slot) const {
    const auto isBefore = [](const Meeting& m, std::size_t s) { return m.slot < s; };
    const auto first = std::lower_bound(meetings_.begin(), meetings_.end(), slot, isBefore);
    const auto last = std::lower_bound(first, meetings_.end(), slot + 1, isBefore);
    return {meetings_.data() + (first - meetings_.begin()),
            meetings_.data() + (last - meetings_.begin())};
  }

  // Calls visit(way of the reference, way of the estimate), both as seen from the first pose.
  template <class Visit>
  void visitWays(const Part& part, const Visit& visit) const {
    const auto begins = inSlot(part.first), ends = inSlot(part.last);
    for (const Meeting* a = begins.first; a != begins.second; ++a) {
      const SE3d reference_back = a->reference.inverse(), estimate_back = a->estimate.inverse();
      for (const Meeting* b = ends.first; b != ends.second; ++b) {
        if (a == b) continue;
        visit(reference_back * b->reference.translation(),
              estimate_back * b->estimate.translation());
      }
    }
  }

  ScoreLevel atScaleOne(double threshold) const {
    const double most = threshold * options_.length;
    std::size_t right = 0;
    for (const Part& part : parts_) {
      bool is_right = false;
      visitWays(part, [&](const Vec3d& q, const Vec3d& p) {
        is_right = is_right || (p - q).norm() <= most;
      });
      if (is_right) ++right;
    }
    return {threshold, double(right) / double(parts_.size()), 1};
  }

  // |s p - q| <= most is a quadratic inequality in s.
  static bool scalesOf(const Vec3d& q, const Vec3d& p, double most, Interval& scales) {
    const double pp = p.squaredNorm(), pq = p.dot(q), rest = q.squaredNorm() - most * most;
    if (!(pp > 0)) {
      scales = {0, std::numeric_limits<double>::infinity()};
      return rest <= 0;
    }
    const double discriminant = pq * pq - pp * rest;
    if (discriminant < 0) return false;
    const double root = std::sqrt(discriminant);
    scales = {std::max((pq - root) / pp, 0.0), (pq + root) / pp};
    return scales.most > 0;
  }

  // The scale that the intervals of most parts hold, by a sweep over their ends.
  ScoreLevel bestScale(double threshold) const {
    const double most = threshold * options_.length;
    std::vector<std::pair<double, int>> ends;  // -1 begins: before ends at the same scale
    std::vector<Interval> scales;
    for (const Part& part : parts_) {
      scales.clear();
      visitWays(part, [&](const Vec3d& q, const Vec3d& p) {
        Interval one;
        if (scalesOf(q, p, most, one)) scales.push_back(one);
      });
      addUnion(scales, ends);
    }
    std::sort(ends.begin(), ends.end());
    ScoreLevel level = {threshold, 0, 1};
    int right = 0, best = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      right -= ends[i].second;
      if (right <= best) continue;
      best = right;
      // Between this begin and the next end.
      const double next = i + 1 < ends.size() ? ends[i + 1].first : ends[i].first;
      level.scale = std::isfinite(next) ? 0.5 * (ends[i].first + next) : ends[i].first + 1;
    }
    level.fraction = double(best) / double(parts_.size());
    return level;
  }

  static void addUnion(std::vector<Interval>& scales, std::vector<std::pair<double, int>>& ends) {
    std::sort(scales.begin(), scales.end(),
              [](const Interval& a, const Interval& b) { return a.least < b.least; });
    for (std::size_t i = 0; i < scales.size();) {
      double most = scales[i].most;
      std::size_t j = i + 1;
      for (; j < scales.size() && scales[j].least <= most; ++j) {
        most = std::max(most, scales[j].most);
      }
      ends.emplace_back(scales[i].least, -1);
      ends.emplace_back(most, 1);
      i = j;
    }
  }

  const Trajectory& reference_;
  ScoreOptions options_;
  std::vector<double> ways_;
  std::vector<Part> parts_;
  std::vector<Meeting> meetings_;  // by slot
};

void checkOptions(const ScoreOptions& options) {
  if (!(options.length >= 0) || !std::isfinite(options.length)) {
    throw ArgumentError("length", "is " + std::to_string(options.length) +
                                      ", expected metres, or 0 for a tenth of the reference's");
  }
  if (options.slot <= 0) {
    throw ArgumentError("slot", "is " + std::to_string(options.slot) + " ns, expected 1 or more");
  }
  for (const double threshold : options.thresholds) {
    if (threshold > 0 && std::isfinite(threshold)) continue;
    throw ArgumentError("thresholds",
                        "have " + std::to_string(threshold) + ", expected all above 0");
  }
  if (options.thresholds.empty()) throw ArgumentError("thresholds", "are none, expected one");
}

}  // namespace

Score scoreOf(const Trajectory& reference, const Trajectory& estimate,
              const ScoreOptions& options) {
  if (reference.empty()) throw ArgumentError("reference", "has no pose, expected one at least");
  checkOptions(options);
  return Scorer(reference, estimate, options).run();
}

}  // namespace v1
}  // namespace gslam
