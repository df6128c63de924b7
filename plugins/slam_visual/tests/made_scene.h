// Scenes whose truth is known: a camera that looks around in a room full of points with random
// descriptors, and a map of it that drifts as that of a SLAM system does.
#ifndef GSLAM_PLUGINS_SLAM_VISUAL_TESTS_MADE_SCENE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_TESTS_MADE_SCENE_H

#include <gslam/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "scene/world.h"

namespace made {

using gslam::KeyframeId;
using gslam::PointId;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec2d;
using gslam::Vec3d;

constexpr double kPi = 3.14159265358979323846;

/// Random numbers that are the same everywhere (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() noexcept {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }
  double uniform(double low, double high) noexcept {
    return low + (high - low) * double(bits() >> 11) / 9007199254740992.0;
  }
  std::size_t below(std::size_t count) noexcept { return std::size_t(bits() % count); }
  double normal() noexcept {
    const double radius = std::sqrt(-2 * std::log(uniform(1e-300, 1)));
    return radius * std::cos(2 * kPi * uniform(0, 1));
  }

 private:
  std::uint64_t state_;
};

using Descriptor = std::array<std::uint8_t, 32>;

/// What there is to see: points on the walls of a room, and before them.
struct Room {
  std::vector<Vec3d> points;
  std::vector<Descriptor> descriptors;

  void drawDescriptor(std::size_t i, Random& random) {
    for (std::uint8_t& byte : descriptors[i]) byte = std::uint8_t(random.bits());
  }
};

/// @param half  from the middle to a wall, metres
inline Room makeRoom(std::uint64_t seed, std::size_t count = 3000, double half = 5) {
  Random random(seed);
  Room room;
  room.descriptors.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double along = random.uniform(-half, half), depth = half - random.uniform(0, 1.5);
    const double height = random.uniform(-2, 2);
    const std::array<Vec3d, 4> walls = {Vec3d{depth, along, height}, Vec3d{-depth, along, height},
                                        Vec3d{along, depth, height}, Vec3d{along, -depth, height}};
    room.points.push_back(walls[random.below(4)]);
    room.drawDescriptor(i, random);
  }
  return room;
}

/// A camera that is not where the body is, and looks along another axis.
inline visual::Eye makeEye(visual::SensorKind kind) {
  visual::Eye eye;
  eye.kind = kind;
  eye.camera = gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5});
  eye.T_body_camera =
      SE3d(SO3d::exp({-kPi / 2, 0, 0}) * SO3d::exp({0, 0.1, 0}), {0.1, 0.05, -0.03});
  eye.focal = 500;
  if (kind != visual::SensorKind::mono) {
    eye.baseline = 0.1;
    eye.far = 8;
  }
  return eye;
}

constexpr double kStep = kPi / 30;  ///< of a circle of 60 views

/// The camera at an angle of a circle about the middle of the room, looking outward.
inline SE3d cameraOnCircle(double angle, double radius = 1.5) {
  const double c = std::cos(angle), s = std::sin(angle);
  // Columns: right, down, forward.
  const gslam::Mat3d R{s, 0, c, -c, 0, s, 0, -1, 0};
  return SE3d(SO3d::fromMatrix(R), {radius * c, radius * s, 0.2 * std::sin(3 * angle)});
}

/// How exactly things are seen.
struct Noise {
  double pixel = 0.5;    ///< pixels of the level of the feature
  double depth = 0.005;  ///< of it
  int flips = 10;        ///< bits of a descriptor, of 256
};

/// What a camera sees, and which point of the room each feature is.
struct Seen {
  std::shared_ptr<const visual::View> view;
  std::vector<std::size_t> points;
};

inline Seen look(const Room& room, const visual::Eye& eye, const SE3d& T_world_camera,
                 const Noise& noise, Random& random, std::uint64_t frame = 0) {
  Seen seen;
  const auto view = std::make_shared<visual::View>();
  const auto content = std::make_shared<gslam::KeyframeContent>();
  std::vector<Descriptor> rows;
  const SE3d T_camera_world = T_world_camera.inverse();
  for (std::size_t i = 0; i < room.points.size(); ++i) {
    const Vec3d p = T_camera_world * room.points[i];
    Vec2d pixel;
    if (p[2] < 0.3 || !eye.camera.project(p, pixel) || !eye.camera.isInImage(pixel)) continue;
    gslam::Feature feature;
    feature.octave = std::int16_t(eye.levels.predicted(0, p.norm() / 8));
    const double sigma = noise.pixel * eye.levels.factor(feature.octave);
    pixel = pixel + sigma * Vec2d{random.normal(), random.normal()};
    if (!eye.camera.isInImage(pixel)) continue;
    feature.pixel = {float(pixel[0]), float(pixel[1])};
    content->features.push_back(feature);
    const double depth = p[2] * (1 + noise.depth * random.normal());
    view->depth.push_back(eye.hasDepth() ? float(depth) : 0);
    view->right_u.push_back(eye.hasDepth() ? float(eye.rightOf(pixel, depth))
                                           : std::numeric_limits<float>::quiet_NaN());
    rows.push_back(room.descriptors[i]);
    for (int flip = 0; flip < noise.flips; ++flip) {
      rows.back()[random.below(32)] ^= std::uint8_t(1 << random.below(8));
    }
    seen.points.push_back(i);
  }
  if (!rows.empty()) {
    content->descriptors = gslam::Image(32, int(rows.size()), gslam::PixelType::u8);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::copy(rows[i].begin(), rows[i].end(), content->descriptors.bytes(int(i)));
    }
  }
  view->frame = frame;
  view->stamp = std::int64_t(frame) * 100000000;
  view->content = content;
  view->grid = visual::FeatureGrid(content->features, eye.camera.width(), eye.camera.height());
  seen.view = view;
  return seen;
}

/// By how much a motion from one keyframe to the next is measured wrongly.
struct Drift {
  Vec3d shift{};     ///< metres, in the camera
  Vec3d turn{};      ///< radians, in the camera
  double scale = 1;  ///< lengths shrink or grow by it with each keyframe
};

/// A shift to the side or ahead would make a circle of another size of a circle: no loop shows it.
inline Drift driftOf(visual::SensorKind kind) {
  return {{0, 0.001, 0}, {0.0002, 0.001, 0.0001}, kind == visual::SensorKind::mono ? 0.998 : 1};
}

/// A world that grows as that of a SLAM system does: a point lives as long as it is in sight, and
/// what comes back into sight is taken for another one.
class Journey {
 public:
  Journey(visual::SensorKind kind, const Drift& drift, std::uint64_t seed, const Noise& noise = {})
      : world(makeEye(kind)), drift_(drift), noise_(noise), random_(seed) {}

  /// Adds a keyframe.
  KeyframeId visit(const Room& room, const SE3d& T_world_camera) {
    const visual::Eye& eye = world.eye();
    const SE3d T_camera_body = eye.T_body_camera.inverse();
    SE3d believed = T_world_camera;
    if (!truth.empty()) {
      const SE3d step = (truth.back() * eye.T_body_camera).inverse() * T_world_camera;
      const Vec3d moved = scale_ * (step.translation() + drift_.shift);
      believed = believed_ * SE3d(step.rotation() * SO3d::exp(drift_.turn), moved);
      scale_ *= drift_.scale;
    }
    const Seen seen = look(room, eye, T_world_camera, noise_, random_, truth.size());
    const KeyframeId id = world.addKeyframe(seen.view, believed * T_camera_body);
    if (!truth.empty()) world.setParent(id, KeyframeId(std::uint32_t(id) - 1));
    truth.push_back(T_world_camera * T_camera_body);
    believed_ = believed;
    addPoints(room, seen, id, T_world_camera);
    return id;
  }
  /// Adds keyframes on the circle.
  void visitCircle(const Room& room, double from, double step, int count) {
    for (int i = 0; i < count; ++i) visit(room, cameraOnCircle(from + step * i));
  }

  /// A view from a place that is no keyframe.
  Seen lookFrom(const Room& room, const SE3d& T_world_camera, std::uint64_t seed) const {
    Random random(seed);
    return look(room, world.eye(), T_world_camera, noise_, random, 1000000 + seed);
  }

  /// Root of the mean squared distance of keyframes from where they are in truth, metres.
  double error() const {
    double sum = 0;
    std::size_t count = 0;
    for (const auto& keyframe : world.map().keyframes()) {
      sum += (keyframe.value.T_world_body.translation() -
              truth[std::uint32_t(keyframe.id)].translation())
                 .squaredNorm();
      ++count;
    }
    return std::sqrt(sum / double(count));
  }

  visual::World world;
  std::vector<SE3d> truth;  ///< T_world_body, by the number of the keyframe

 private:
  void addPoints(const Room& room, const Seen& seen, KeyframeId id, const SE3d& T_world_camera) {
    const visual::Eye& eye = world.eye();
    std::vector<PointId> now(room.points.size(), gslam::kNoPoint);
    in_sight_.resize(room.points.size(), gslam::kNoPoint);
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
      const std::uint32_t feature = std::uint32_t(i);
      Vec3d p = T_world_camera.inverse() * room.points[seen.points[i]];
      if (eye.hasDepth()) {
        if (!eye.pointOf(seen.view->pixel(i), double(seen.view->depth[i]), p)) continue;
      } else {
        p = (scale_ * (1 + noise_.depth * random_.normal())) * p;
      }
      p = world.scene().T_world_camera(id) * p;
      PointId& point = now[seen.points[i]];
      point = in_sight_[seen.points[i]];
      if (point == gslam::kNoPoint) {
        point = world.addPoint(p, id, feature);
        continue;
      }
      // Where all that see it say together.
      world.observe(point, id, feature);
      const double count = double(world.map().observations(point).size());
      const Vec3d before = world.map().at(point).position;
      world.movePoint(point, before + (1 / count) * (p - before));
      world.refresh(point);
    }
    in_sight_ = now;
    for (const gslam::Covisible& near : covisibleKeyframes(world.map(), id, 15)) {
      world.refreshNeighbours(near.keyframe);
    }
    world.refreshNeighbours(id);
  }

  Drift drift_;
  Noise noise_;
  Random random_;
  double scale_ = 1;
  SE3d believed_;                  // T_world_camera
  std::vector<PointId> in_sight_;  // by the point of the room
};

}  // namespace made

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_TESTS_MADE_SCENE_H
