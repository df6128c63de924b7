#include <gslam/base/error.h>
#include <gslam/evaluation/coverage.h>

#include <algorithm>
#include <string>

#include "time_units.h"

namespace gslam {
inline namespace v1 {
namespace {

// In nanoseconds or frames, from the begin of the reference on; as double, because sums of stamps
// may leave the range.
struct Interval {
  double begin, end;
};

double between(std::int64_t a, std::int64_t b) {
  return double(std::uint64_t(b) - std::uint64_t(a));
}

Coverage coverageOfNumbers(const Trajectory& reference, const Trajectory& estimate) {
  std::vector<TrackedFrame> frames;
  frames.reserve(reference.size());
  for (const StampedPose& pose : reference) {
    const auto same = estimate.lowerBound(pose.stamp);
    frames.push_back({pose.stamp, same != estimate.end() && same->stamp == pose.stamp});
  }
  return coverageOf(frames, true);
}

// Times of the estimate's poses that are inside of the reference's time, from its begin on.
std::vector<double> timesInside(const Trajectory& reference, const Trajectory& estimate,
                                std::int64_t offset, double slack) {
  const double end = between(reference.front().stamp, reference.back().stamp);
  std::vector<double> times;
  for (const StampedPose& pose : estimate) {
    const bool is_later = pose.stamp >= reference.front().stamp;
    const double apart = is_later ? between(reference.front().stamp, pose.stamp)
                                  : -between(pose.stamp, reference.front().stamp);
    const double time = apart + double(offset);
    if (time >= -slack && time <= end + slack) times.push_back(time);
  }
  return times;
}

// What is tracked; steps that are losses stand in the result.
std::vector<Interval> intervalsOf(const std::vector<double>& times, double half_step,
                                  double lost_after, double end, Coverage& result) {
  std::vector<Interval> intervals;
  const auto lose = [&](double from, double to) {
    ++result.losses;
    result.longest_loss = std::max(result.longest_loss, 1e-9 * (to - from));
  };
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double begin = std::max(0.0, times[i] - half_step);
    const double until = std::min(end, times[i] + half_step);
    if (i > 0 && times[i] - times[i - 1] <= lost_after) {
      intervals.back().end = until;
      continue;
    }
    if (i > 0) lose(times[i - 1], times[i]);
    intervals.push_back({begin, until});
  }
  if (!times.empty() && end - times.back() > lost_after) lose(times.back(), end);
  return intervals;
}

void countFrames(const Trajectory& reference, const std::vector<Interval>& intervals,
                 Coverage& result) {
  std::size_t i = 0;
  for (const StampedPose& pose : reference) {
    const double time = between(reference.front().stamp, pose.stamp);
    while (i < intervals.size() && intervals[i].end < time) ++i;
    if (i < intervals.size() && intervals[i].begin <= time) ++result.tracked_frames;
  }
  result.total_frames = reference.size();
  result.frames = double(result.tracked_frames) / double(result.total_frames);
}

}  // namespace

Coverage coverageOf(Span<const TrackedFrame> frames, bool is_numbered) {
  if (frames.empty()) throw ArgumentError("frames", "are none, expected one at least");
  const double unit = is_numbered ? 1 : 1e-9;
  Coverage result;
  result.is_numbered = is_numbered;
  result.total_frames = frames.size();
  double tracked = 0;
  std::size_t last = 0;  // the last tracked one
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i > 0 && frames[i].stamp <= frames[i - 1].stamp) {
      throw ArgumentError("frames", "are not ascending, at number " + std::to_string(i));
    }
    const bool was_tracked = i > 0 && frames[i - 1].is_tracked;
    if (was_tracked && !frames[i].is_tracked) ++result.losses;
    if (!frames[i].is_tracked) continue;
    if (!result.is_initialised) {
      result.is_initialised = true;
      result.time_to_initialise = unit * between(frames[0].stamp, frames[i].stamp);
    } else if (was_tracked) {
      tracked += between(frames[i - 1].stamp, frames[i].stamp);
    } else {
      result.longest_loss =
          std::max(result.longest_loss, unit * between(frames[last].stamp, frames[i].stamp));
    }
    last = i;
    ++result.tracked_frames;
  }
  if (result.is_initialised) {
    result.longest_loss =
        std::max(result.longest_loss, unit * between(frames[last].stamp, frames.back().stamp));
  }
  result.frames = double(result.tracked_frames) / double(frames.size());
  const double all = between(frames[0].stamp, frames.back().stamp);
  result.time = all > 0 ? tracked / all : result.frames;
  return result;
}

Coverage coverageOf(const Trajectory& reference, const Trajectory& estimate,
                    const CoverageOptions& options) {
  if (reference.empty()) throw ArgumentError("reference", "has no pose, expected one at least");
  if (options.lost_after < 0) {
    throw ArgumentError("lost_after",
                        "is " + std::to_string(options.lost_after) + " ns, expected 0 or more");
  }
  if (options.is_numbered) return coverageOfNumbers(reference, estimate);
  Coverage result;
  const double step = evaluation::medianStep(estimate);
  const double half_step = 0.5 * step;
  const double lost_after =
      options.lost_after > 0 ? double(options.lost_after) : std::max(5e8, 5 * step);
  result.lost_after = 1e-9 * lost_after;
  const double end = between(reference.front().stamp, reference.back().stamp);
  const std::vector<double> times =
      timesInside(reference, estimate, options.time_offset, half_step);
  const std::vector<Interval> intervals = intervalsOf(times, half_step, lost_after, end, result);
  result.is_initialised = !times.empty();
  if (result.is_initialised) result.time_to_initialise = 1e-9 * std::max(0.0, times.front());
  double tracked = 0;
  for (const Interval& interval : intervals)
    tracked += std::max(0.0, interval.end - interval.begin);
  countFrames(reference, intervals, result);
  result.time = end > 0 ? std::min(1.0, tracked / end) : result.frames;
  return result;
}

}  // namespace v1
}  // namespace gslam
