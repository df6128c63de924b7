#include "mapping/triangulator.h"

#include <gslam/estimator/solvers/triangulate_optimal.h>

#include <algorithm>
#include <cmath>

#include "matching/pose_fitter.h"

namespace visual {

using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::PointId;
using gslam::SE3d;
using gslam::Vec3d;

namespace {

// Rays that cross at a smaller angle say little: 0.9998, about 1.15 degrees.
constexpr double kMostCosine = 0.9998;

// Of two views of a point with their rays, the cosine of the angle between them.
double cosineBetween(const Vec3d& a, const Vec3d& b) {
  return a.dot(b) / (a.norm() * b.norm());
}

// The angle that a measured depth spans, seen from both cameras of the pair.
double stereoCosine(const Eye& eye, const View& view, std::uint32_t feature) {
  if (!view.isClose(feature, eye)) return 2;  // none
  return std::cos(2 * std::atan2(eye.baseline / 2, double(view.depth[feature])));
}

// What a pair of features says of a point.
class PairOfViews {
 public:
  PairOfViews(const Scene& scene, KeyframeId first, KeyframeId second)
      : eye_(scene.eye),
        first_(scene.view(first)),
        second_(scene.view(second)),
        T_world_first_(scene.T_world_camera(first)),
        T_world_second_(scene.T_world_camera(second)),
        T_second_first_(T_world_second_.inverse() * T_world_first_) {}

  const SE3d& T_second_first() const noexcept { return T_second_first_; }

  // From the rays where they cross at an angle, or from the depth of the one that is sure of it.
  bool locate(std::uint32_t i, std::uint32_t j, const Vec3d& ray_i, const Vec3d& ray_j,
              Vec3d& point) const {
    const double parallax = cosineBetween(T_second_first_.rotation() * ray_i, ray_j);
    const double stereo_i = stereoCosine(eye_, first_, i),
                 stereo_j = stereoCosine(eye_, second_, j);
    const double stereo = std::min(stereo_i, stereo_j);
    Vec3d in_first;
    if (parallax > 0 && parallax < stereo && (stereo < 2 || parallax < kMostCosine)) {
      if (triangulateOptimal(T_second_first_, ray_i, ray_j, in_first) != 1) return false;
      point = T_world_first_ * in_first;
      return true;
    }
    if (stereo > 1) return false;
    const bool by_first = stereo_i <= stereo_j;
    const View& view = by_first ? first_ : second_;
    const std::uint32_t feature = by_first ? i : j;
    if (!eye_.pointOf(view.pixel(feature), double(view.depth[feature]), in_first)) return false;
    point = (by_first ? T_world_first_ : T_world_second_) * in_first;
    return true;
  }

  // Whether both see it there, in the size they see it.
  bool isConfirmed(std::uint32_t i, std::uint32_t j, const Vec3d& point) const {
    const Vec3d in_first = T_world_first_.inverse() * point;
    const Vec3d in_second = T_world_second_.inverse() * point;
    if (!fits(eye_, first_, i, in_first) || !fits(eye_, second_, j, in_second)) return false;
    const double distances = in_second.norm() / in_first.norm();
    const double sizes = eye_.levels.factor(first_.features()[i].octave) /
                         eye_.levels.factor(second_.features()[j].octave);
    const double most = 1.5 * eye_.levels.factor(1);
    return distances < sizes * most && distances * most > sizes;
  }

 private:
  const Eye& eye_;
  const View& first_;
  const View& second_;
  SE3d T_world_first_, T_world_second_, T_second_first_;
};

// Sines of the angles between directions and a plane with that normal, all at once.
void offPlane(const std::vector<float>& x, const std::vector<float>& y, const std::vector<float>& z,
              const float (&n)[3], std::vector<float>& off) {
  const std::size_t count = x.size();
  off.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    off[i] = std::fabs(n[0] * x[i] + n[1] * y[i] + n[2] * z[i]);
  }
}

}  // namespace

void Triangulator::collect(const Scene& scene, KeyframeId id, Free& free) {
  free = Free{};
  const View& view = scene.view(id);
  const gslam::Span<const PointId> points = scene.map.pointsSeen(id);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    Vec3d bearing;
    if (points[i] != kNoPoint || !scene.eye.camera.unproject(view.pixel(i), bearing)) continue;
    free.features.push_back(i);
    free.bearings.push_back(bearing);
    free.x.push_back(float(bearing[0]));
    free.y.push_back(float(bearing[1]));
    free.z.push_back(float(bearing[2]));
    const double pixels = 1.96 * scene.eye.levels.factor(view.features()[i].octave);
    free.slack.push_back(float(pixels / scene.eye.focal));
  }
}

void Triangulator::match(const Scene& scene, KeyframeId first, KeyframeId second) {
  const View& view = scene.view(first);
  const gslam::Image& descriptors = scene.view(second).descriptors();
  const SE3d T_second_first = scene.T_world_camera(second).inverse() * scene.T_world_camera(first);
  const Vec3d t = T_second_first.translation();
  pairs_.clear();
  if (!(t.norm() > 0)) return;  // no lines to look along
  const Vec3d epipole = t.normalized();
  std::vector<Pair> best(second_.features.size(), Pair{0, 0, 2});
  for (std::size_t i = 0; i < first_.features.size(); ++i) {
    const Vec3d turned = T_second_first.rotation() * first_.bearings[i];
    const Vec3d normal = t.cross(turned);
    const double length = normal.norm();
    if (!(length > 1e-9 * t.norm())) continue;
    const float n[3] = {float(normal[0] / length), float(normal[1] / length),
                        float(normal[2] / length)};
    offPlane(second_.x, second_.y, second_.z, n, off_);
    near_.clear();
    rows_.clear();
    for (std::size_t j = 0; j < off_.size(); ++j) {
      if (off_[j] > second_.slack[j]) continue;
      // Near the epipole every direction is near the plane.
      const double along = std::fabs(epipole.dot(second_.bearings[j]));
      if (along > 0.9994 && !scene.eye.hasDepth()) continue;
      near_.push_back(std::uint32_t(j));
      rows_.push_back(second_.features[j]);
    }
    if (near_.empty()) continue;
    distancesTo(view.descriptors().bytes(int(first_.features[i])), descriptors, rows_, distances_);
    Nearest nearest;
    for (std::size_t k = 0; k < near_.size(); ++k) nearest.offer(near_[k], distances_[k]);
    if (nearest.distance > kStrictDistance) continue;
    Pair& kept = best[nearest.row];
    if (nearest.distance < kept.distance) {
      kept = {std::uint32_t(i), nearest.row, nearest.distance};
    }
  }
  for (const Pair& pair : best) {
    if (pair.distance <= kStrictDistance) pairs_.push_back(pair);
  }
}

void Triangulator::addPoints(World& world, KeyframeId first, KeyframeId second,
                             std::vector<PointId>& added) {
  const Scene& scene = world.scene();
  collect(scene, first, first_);
  collect(scene, second, second_);
  if (first_.features.empty() || second_.features.empty()) return;
  match(scene, first, second);
  const PairOfViews views(scene, first, second);
  for (const Pair& pair : pairs_) {
    const std::uint32_t i = first_.features[pair.first], j = second_.features[pair.second];
    Vec3d point;
    if (!views.locate(i, j, first_.bearings[pair.first], second_.bearings[pair.second], point) ||
        !views.isConfirmed(i, j, point)) {
      continue;
    }
    const PointId id = world.addPoint(point, first, i);
    world.observe(id, second, j);
    world.refresh(id);
    added.push_back(id);
  }
}

}  // namespace visual
