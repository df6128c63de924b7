#include <gslam/base/error.h>
#include <gslam/evaluation/rpe.h>
#include <gslam/evaluation/segments.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "motion.h"

namespace gslam {
inline namespace v1 {
namespace {

constexpr double kSlack = 0.2;  // rpg_trajectory_evaluation's max_dist_diff

struct Lists {
  std::vector<double> distance, percent, angle, angle_per_metre, yaw, gravity;
};

void addTo(Lists& lists, const SE3d& error, const SO3d& rotation_world, double length) {
  const double distance = error.translation().norm();
  const double angle = evaluation::kDegrees * error.rotation().angle();
  lists.distance.push_back(distance);
  lists.percent.push_back(100 * distance / length);
  lists.angle.push_back(angle);
  lists.angle_per_metre.push_back(angle / length);
  const Mat3d r = (rotation_world * error.rotation() * rotation_world.inverse()).matrix();
  lists.yaw.push_back(evaluation::kDegrees * std::fabs(std::atan2(r(1, 0), r(0, 0))));
  lists.gravity.push_back(evaluation::kDegrees * std::atan2(std::hypot(r(0, 2), r(1, 2)), r(2, 2)));
}

SegmentErrors errorsOf(const PosePairs& pairs, double length, const SIM3d& S_world_map) {
  RpeOptions options;
  options.delta = length;
  options.unit = DeltaUnit::metres;
  options.all_pairs = true;
  options.tolerance = kSlack;
  Lists lists;
  for (const PairRange& range : rangesOf(pairs, options)) {
    addTo(lists, evaluation::motionError(pairs, range.first, range.last, S_world_map.scale()),
          S_world_map.rotation() * pairs.estimate[range.last].rotation(), length);
  }
  SegmentErrors result;
  result.length = length;
  result.translation = statisticsOf(std::move(lists.distance));
  result.translation_percent = statisticsOf(std::move(lists.percent));
  result.rotation_deg = statisticsOf(std::move(lists.angle));
  result.rotation_deg_per_m = statisticsOf(std::move(lists.angle_per_metre));
  result.yaw_deg = statisticsOf(std::move(lists.yaw));
  result.gravity_deg = statisticsOf(std::move(lists.gravity));
  return result;
}

}  // namespace

std::vector<SegmentErrors> segmentErrors(const PosePairs& pairs, Span<const double> lengths,
                                         const SIM3d& S_world_map) {
  std::vector<SegmentErrors> result;
  for (const double length : lengths) {
    if (!(length > 0) || !std::isfinite(length)) {
      throw ArgumentError(
          "segments", "have a length of " + std::to_string(length) + ", expected metres above 0");
    }
    result.push_back(errorsOf(pairs, length, S_world_map));
  }
  return result;
}

}  // namespace v1
}  // namespace gslam
