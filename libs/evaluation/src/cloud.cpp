#include <gslam/base/error.h>
#include <gslam/core/map.h>
#include <gslam/core/point_index.h>
#include <gslam/evaluation/align.h>
#include <gslam/evaluation/cloud.h>

#include <algorithm>
#include <cmath>

namespace gslam {
inline namespace v1 {
namespace {

constexpr double kConverged = 1e-6;

bool isFinite(const Vec3d& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

// Points that can be asked for the nearest one.
class Surface {
 public:
  Surface(Span<const MapPoint> points, const SIM3d& S_world_points)
      : map_(mapOf(points, S_world_points)), index_(map_) {}

  const MapPoint& nearest(const Vec3d& place) const {
    return map_.at(index_.nearest(place, 1).front().id);
  }

 private:
  static Map mapOf(Span<const MapPoint> points, const SIM3d& S_world_points) {
    Map map;
    for (MapPoint point : points) {
      point.position = S_world_points * point.position;
      if (isFinite(point.position)) map.add(point);
    }
    return map;
  }

  Map map_;
  PointIndex index_;
};

std::vector<Vec3d> finitePositions(const char* name, Span<const MapPoint> points) {
  std::vector<Vec3d> positions;
  for (const MapPoint& point : points) {
    if (isFinite(point.position)) positions.push_back(point.position);
  }
  if (positions.empty()) throw ArgumentError(name, "has no finite point, expected one at least");
  return positions;
}

double extentOf(const std::vector<Vec3d>& points) {
  Vec3d least = points[0], most = points[0];
  for (const Vec3d& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], p[k]);
      most[k] = std::max(most[k], p[k]);
    }
  }
  return (most - least).norm();
}

// One round of ICP: the alignment over the partners that the last one gives.
Alignment round(const Surface& surface, const std::vector<Vec3d>& points,
                const CloudOptions& options, const SIM3d& S_world_cloud) {
  std::vector<Vec3d> partners, moved;
  for (const Vec3d& p : points) {
    const Vec3d place = S_world_cloud * p;
    const Vec3d partner = surface.nearest(place).position;
    if ((partner - place).norm() > options.max_distance) continue;
    partners.push_back(partner);
    moved.push_back(p);
  }
  AlignmentOptions how;
  how.method = options.icp_has_scale ? AlignmentMethod::sim3 : AlignmentMethod::se3;
  Alignment result;
  if (partners.empty()) {
    result.reason = "no point is within the largest distance";
    return result;
  }
  if (options.icp_has_scale) return alignPositions(partners, moved, how);
  // The scale stays what it is.
  const double scale = S_world_cloud.scale();
  for (Vec3d& p : moved) p *= scale;
  result = alignPositions(partners, moved, how);
  result.S_world_map = SIM3d(result.S_world_map.rigid(), scale);
  return result;
}

void refine(const Surface& surface, const std::vector<Vec3d>& points, const CloudOptions& options,
            CloudErrors& result) {
  const double slack = kConverged * extentOf(points) * result.S_world_cloud.scale();
  for (std::size_t i = 0; i < options.icp_rounds; ++i) {
    const Alignment next = round(surface, points, options, result.S_world_cloud);
    if (!next.is_valid) {
      result.reason = next.reason;
      return;
    }
    double moved = 0;
    for (const Vec3d& p : points) {
      moved = std::max(moved, (next.S_world_map * p - result.S_world_cloud * p).norm());
    }
    result.S_world_cloud = next.S_world_map;
    result.icp_rounds = i + 1;
    if (moved <= slack) return;
  }
  if (options.icp_rounds > 0) result.reason = "refining took all its rounds";
}

double harmonicMean(double a, double b) {
  return a + b > 0 ? 2 * a * b / (a + b) : 0;
}

void checkOptions(const CloudOptions& options) {
  if (!(options.max_distance > 0)) throw ArgumentError("max_distance", "is not above 0");
  if (!(options.threshold > 0)) throw ArgumentError("threshold", "is not above 0");
}

}  // namespace

CloudErrors cloudErrors(Span<const MapPoint> reference, Span<const MapPoint> cloud,
                        const CloudOptions& options) {
  checkOptions(options);
  const std::vector<Vec3d> targets = finitePositions("reference", reference);
  const std::vector<Vec3d> points = finitePositions("cloud", cloud);
  CloudErrors result;
  result.S_world_cloud = options.S_world_cloud;
  const Surface surface(reference, SIM3d());
  refine(surface, points, options, result);
  std::vector<double> distances;
  std::size_t near = 0, complete = 0;
  for (const Vec3d& p : points) {
    const Vec3d place = result.S_world_cloud * p;
    const double distance = (surface.nearest(place).position - place).norm();
    if (distance <= options.threshold) ++near;
    if (distance <= options.max_distance) distances.push_back(distance);
  }
  const Surface covered(cloud, result.S_world_cloud);
  for (const Vec3d& p : targets) {
    if ((covered.nearest(p).position - p).norm() <= options.threshold) ++complete;
  }
  result.outliers = cloud.size() - distances.size();
  result.distance = statisticsOf(std::move(distances));
  result.accuracy = double(near) / double(cloud.size());
  result.completeness = double(complete) / double(targets.size());
  result.f_score = harmonicMean(result.accuracy, result.completeness);
  return result;
}

}  // namespace v1
}  // namespace gslam
