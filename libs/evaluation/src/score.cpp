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
struct ScaleRange {
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
    score.levels = options_.has_scale ? atBestScales() : atScaleOne();
    for (const ScoreLevel& level : score.levels) {
      score.value += level.fraction / double(options_.thresholds.size());
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

  // The nearest pair of poses decides for all thresholds.
  std::vector<ScoreLevel> atScaleOne() const {
    std::vector<std::size_t> right(options_.thresholds.size(), 0);
    for (const Part& part : parts_) {
      double least = std::numeric_limits<double>::infinity();
      visitWays(part, [&](const Vec3d& q, const Vec3d& p) {
        least = std::min(least, (p - q).squaredNorm());
      });
      least = std::sqrt(least);
      for (std::size_t k = 0; k < right.size(); ++k) {
        if (least <= options_.thresholds[k] * options_.length) ++right[k];
      }
    }
    std::vector<ScoreLevel> levels;
    for (std::size_t k = 0; k < right.size(); ++k) {
      levels.push_back({options_.thresholds[k], double(right[k]) / double(parts_.size()), 1});
    }
    return levels;
  }

  // |s p - q| <= most is a quadratic inequality in s; this is what it needs of p and q.
  struct Products {
    double pp, pq, qq;
  };

  static bool scalesOf(const Products& m, double most, ScaleRange& scales) {
    const double rest = m.qq - most * most;
    if (!(m.pp > 0)) {
      scales = {0, std::numeric_limits<double>::infinity()};
      return rest <= 0;
    }
    const double discriminant = m.pq * m.pq - m.pp * rest;
    if (discriminant < 0) return false;
    const double root = std::sqrt(discriminant), part = 1 / m.pp;
    scales = {std::max((m.pq - root) * part, 0.0), (m.pq + root) * part};
    return scales.most > 0;
  }

  // Scales at which one part more (-1) or one part less (1) is right.
  using Ends = std::vector<std::pair<double, int>>;

  std::vector<ScoreLevel> atBestScales() const {
    const std::size_t count = options_.thresholds.size();
    std::vector<Ends> ends(count);
    std::vector<Products> products;
    for (const Part& part : parts_) {
      products.clear();
      visitWays(part, [&](const Vec3d& q, const Vec3d& p) {
        products.push_back({p.squaredNorm(), p.dot(q), q.squaredNorm()});
      });
      for (std::size_t k = 0; k < count; ++k) {
        addUnion(products, options_.thresholds[k] * options_.length, ends[k]);
      }
    }
    std::vector<ScoreLevel> levels;
    for (std::size_t k = 0; k < count; ++k) {
      levels.push_back(bestScale(options_.thresholds[k], ends[k]));
    }
    return levels;
  }

  // The scales for which any of the ways is right. Nearly always they are one interval, so those
  // that touch what there is join it at once, and only the others are sorted.
  static void addUnion(const std::vector<Products>& products, double most, Ends& ends) {
    std::vector<ScaleRange> apart;
    ScaleRange joined = {1, 0}, one;
    for (const Products& product : products) {
      if (!scalesOf(product, most, one)) continue;
      if (joined.least > joined.most) joined = one;
      if (one.least <= joined.most && one.most >= joined.least) {
        joined = {std::min(joined.least, one.least), std::max(joined.most, one.most)};
      } else {
        apart.push_back(one);
      }
    }
    if (joined.least > joined.most) return;
    apart.push_back(joined);
    std::sort(apart.begin(), apart.end(),
              [](const ScaleRange& a, const ScaleRange& b) { return a.least < b.least; });
    for (std::size_t i = 0; i < apart.size();) {
      double end = apart[i].most;
      std::size_t j = i + 1;
      for (; j < apart.size() && apart[j].least <= end; ++j) end = std::max(end, apart[j].most);
      ends.emplace_back(apart[i].least, -1);
      ends.emplace_back(end, 1);
      i = j;
    }
  }

  // The scale that the intervals of most parts hold, by a sweep over their ends; at the same scale
  // begins come first.
  ScoreLevel bestScale(double threshold, Ends& ends) const {
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
