#include <gslam/base/error.h>
#include <gslam/evaluation/kitti.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "motion.h"

namespace gslam {
inline namespace v1 {
namespace {

struct Segment {
  double length;       // nominal, metres
  double speed;        // metres a second
  double translation;  // part of the length
  double rotation;     // radians a metre
};

void checkOptions(const KittiOptions& options) {
  if (options.lengths.empty()) throw ArgumentError("lengths", "are none, expected one at least");
  for (const double length : options.lengths) {
    if (length > 0 && std::isfinite(length)) continue;
    throw ArgumentError("lengths", "have " + std::to_string(length) + ", expected metres above 0");
  }
  if (options.step == 0) throw ArgumentError("step", "is 0, expected 1 or more");
}

std::vector<Segment> segmentsOf(const PosePairs& pairs, const std::vector<double>& way,
                                const KittiOptions& options, double scale) {
  std::vector<Segment> segments;
  for (const double length : options.lengths) {
    std::size_t last = 0;
    for (std::size_t first = 0; first < pairs.size(); first += options.step) {
      while (last < pairs.size() && !(way[last] > way[first] + length)) ++last;
      if (last == pairs.size()) break;
      const SE3d error = evaluation::motionError(pairs, first, last, scale);
      const double frames = double(last - first + 1);
      segments.push_back({length, length / (options.frame_period * frames),
                          error.translation().norm() / length, error.rotation().angle() / length});
    }
  }
  return segments;
}

template <class Belongs>
KittiBin meanOf(const std::vector<Segment>& segments, double at, const Belongs& belongs) {
  KittiBin bin;
  bin.at = at;
  for (const Segment& segment : segments) {
    if (!belongs(segment)) continue;
    ++bin.count;
    bin.t_err_percent += segment.translation;
    bin.r_err_deg_per_m += segment.rotation;
  }
  if (bin.count == 0) return bin;
  bin.t_err_percent *= 100 / double(bin.count);
  bin.r_err_deg_per_m *= evaluation::kDegrees / double(bin.count);
  return bin;
}

std::string whyNone(double way, const KittiOptions& options) {
  const double least = *std::min_element(options.lengths.begin(), options.lengths.end());
  char text[120];
  std::snprintf(
      text, sizeof(text),
      "the way of the pairs is %.4g m long, no longer than the shortest segment of %.4g m", way,
      least);
  return text;
}

}  // namespace

KittiErrors kittiErrors(const PosePairs& pairs, const KittiOptions& options, double scale) {
  checkOptions(options);
  KittiErrors result;
  const std::vector<double> way = evaluation::lengthsOf(pairs);
  const std::vector<Segment> segments = segmentsOf(pairs, way, options, scale);
  if (segments.empty()) {
    result.reason = whyNone(way.empty() ? 0 : way.back(), options);
    return result;
  }
  const KittiBin all = meanOf(segments, 0, [](const Segment&) { return true; });
  result.count = all.count;
  result.t_err_percent = all.t_err_percent;
  result.r_err_deg_per_m = all.r_err_deg_per_m;
  for (const double length : options.lengths) {
    const KittiBin bin =
        meanOf(segments, length, [length](const Segment& s) { return s.length == length; });
    if (bin.count > 0) result.lengths.push_back(bin);
  }
  for (int even = 2; even < 25; even += 2) {
    const double speed = even;
    const KittiBin bin = meanOf(
        segments, speed, [speed](const Segment& s) { return std::fabs(s.speed - speed) < 2; });
    if (bin.count > 2) result.speeds.push_back(bin);
  }
  return result;
}

}  // namespace v1
}  // namespace gslam
