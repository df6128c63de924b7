#include "matching/matcher.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace visual {

using gslam::Feature;
using gslam::Image;
using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::PointId;
using gslam::SE3d;
using gslam::Span;
using gslam::Vec2d;
using gslam::Vec3d;

namespace {

constexpr double kPi = 3.14159265358979323846;

std::vector<std::uint32_t> allRows(std::size_t count) {
  std::vector<std::uint32_t> rows(count);
  for (std::size_t i = 0; i < count; ++i) rows[i] = std::uint32_t(i);
  return rows;
}

}  // namespace

std::vector<FeaturePair> matchDescriptors(const Image& first, Span<const std::uint32_t> first_rows,
                                          const Image& second,
                                          Span<const std::uint32_t> second_rows,
                                          const MatchRules& rules) {
  struct Back {
    std::uint32_t first = 0;
    float distance = 2;
  };
  std::vector<Back> back(second_rows.size());  // who of the first comes nearest
  std::vector<std::uint32_t> chosen(first_rows.size(), Nearest::kNone);
  std::vector<float> distances;
  for (std::size_t i = 0; i < first_rows.size(); ++i) {
    distancesTo(first.bytes(int(first_rows[i])), second, second_rows, distances);
    Nearest nearest;
    for (std::size_t j = 0; j < distances.size(); ++j) {
      nearest.offer(std::uint32_t(j), distances[j]);
      if (distances[j] < back[j].distance) back[j] = {std::uint32_t(i), distances[j]};
    }
    if (nearest.distance <= rules.most && nearest.distance < rules.ratio * nearest.second) {
      chosen[i] = nearest.row;
    }
  }
  std::vector<FeaturePair> pairs;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::uint32_t j = chosen[i];
    if (j != Nearest::kNone && back[j].first == i) pairs.push_back({first_rows[i], second_rows[j]});
  }
  return pairs;
}

void keepCommonTurn(const std::vector<Feature>& first, const std::vector<Feature>& second,
                    std::vector<FeaturePair>& pairs) {
  constexpr int kBins = 30;
  std::array<int, kBins> counts{};
  std::vector<int> bins(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    double turn = double(first[pairs[i].first].angle) - double(second[pairs[i].second].angle);
    turn -= 2 * kPi * std::floor(turn / (2 * kPi));
    bins[i] = std::min(int(turn / (2 * kPi) * kBins), kBins - 1);
    ++counts[std::size_t(bins[i])];
  }
  // The fullest bin with its two neighbours.
  int best = 0, most = -1;
  for (int b = 0; b < kBins; ++b) {
    const int sum = counts[std::size_t(b)] + counts[std::size_t((b + 1) % kBins)] +
                    counts[std::size_t((b + kBins - 1) % kBins)];
    if (sum > most) {
      most = sum;
      best = b;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const int off = std::abs(bins[i] - best);
    if (std::min(off, kBins - off) <= 1) pairs[kept++] = pairs[i];
  }
  pairs.resize(kept);
}

std::vector<Match> matchKeyframe(const View& view, const Scene& scene, KeyframeId keyframe,
                                 const MatchRules& rules) {
  const gslam::KeyframeContent& content = *scene.map.at(keyframe).content;
  const Span<const PointId> points = scene.map.pointsSeen(keyframe);
  std::vector<std::uint32_t> rows;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] != kNoPoint) rows.push_back(std::uint32_t(i));
  }
  if (rows.empty() || view.size() == 0) return {};
  std::vector<FeaturePair> pairs =
      matchDescriptors(content.descriptors, rows, view.descriptors(), allRows(view.size()), rules);
  keepCommonTurn(content.features, view.features(), pairs);
  std::vector<Match> matches;
  for (const FeaturePair& pair : pairs) {
    matches.push_back({pair.second, points[pair.first], 0});
  }
  return matches;
}

const std::vector<Match>& ProjectionMatcher::match(const View& view, const Eye& eye,
                                                   const SE3d& T_camera_world,
                                                   Span<const SoughtPoint> points,
                                                   const MatchRules& rules,
                                                   Span<const std::uint8_t> taken) {
  best_of_feature_.assign(view.size(), Match{0, kNoPoint, 2});
  const std::vector<Feature>& features = view.features();
  for (const SoughtPoint& point : points) {
    Vec2d pixel;
    const Vec3d in_camera = T_camera_world * point.position;
    if (!eye.camera.project(in_camera, pixel) || !eye.camera.isInImage(pixel)) continue;
    const double window = point.window * eye.levels.factor(point.level);
    near_.clear();
    view.grid.near(pixel, window, point.level - 1, point.level + 1, near_);
    candidates_.clear();
    double right = 0;
    Vec2d right_pixel;
    const bool has_right =
        eye.hasDepth() &&
        eye.camera.project({in_camera[0] - eye.baseline, in_camera[1], in_camera[2]}, right_pixel);
    if (has_right) right = right_pixel[0];
    for (const std::uint32_t feature : near_) {
      if (!taken.empty() && taken[feature] != 0) continue;
      const double measured = double(view.right_u[feature]);
      if (has_right && view.hasRight(feature) && std::abs(measured - right) > window) continue;
      candidates_.push_back(feature);
    }
    if (candidates_.empty()) continue;
    distancesTo(point.descriptor, view.descriptors(), candidates_, distances_);
    Nearest nearest;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      nearest.offer(candidates_[i], distances_[i]);
    }
    if (nearest.distance > rules.most) continue;
    if (nearest.second_row != Nearest::kNone &&
        features[nearest.second_row].octave == features[nearest.row].octave &&
        nearest.distance > rules.ratio * nearest.second) {
      continue;
    }
    Match& best = best_of_feature_[nearest.row];
    if (nearest.distance < best.distance) best = {nearest.row, point.id, nearest.distance};
  }
  matches_.clear();
  for (const Match& match : best_of_feature_) {
    if (match.point != kNoPoint) matches_.push_back(match);
  }
  return matches_;
}

void findVisible(const Scene& scene, const SE3d& T_camera_world, Span<const PointId> points,
                 double window, std::vector<SoughtPoint>& sought) {
  const Vec3d centre = T_camera_world.inverse().translation();
  for (const PointId id : points) {
    const gslam::MapPoint* const point = scene.map.find(id);
    const Image* const descriptor = scene.map.descriptor(id);
    if (point == nullptr || descriptor == nullptr) continue;
    Vec2d pixel;
    if (!scene.eye.camera.project(T_camera_world * point->position, pixel) ||
        !scene.eye.camera.isInImage(pixel)) {
      continue;
    }
    const Vec3d ray = centre - point->position;
    const double distance = ray.norm();
    const Visibility visible = visibilityOf(scene, id);
    if (!(distance >= visible.nearest && distance <= visible.farthest)) continue;
    const double cosine = (ray[0] * double(point->normal[0]) + ray[1] * double(point->normal[1]) +
                           ray[2] * double(point->normal[2])) /
                          distance;
    if (!(cosine > 0.5)) continue;
    const int level = scene.eye.levels.predicted(visible.octave, distance / visible.seen_at);
    sought.push_back(
        {id, point->position, descriptor->bytes(), level, cosine > 0.998 ? 0.6 * window : window});
  }
}

}  // namespace visual
