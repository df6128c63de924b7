#ifndef GSLAM_CORE_TESTS_RANDOM_MAP_H
#define GSLAM_CORE_TESTS_RANDOM_MAP_H

#include <gslam/core/map.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace gslam_test {

/// Numbers for maps that have everything a map can have.
class RandomMap {
 public:
  explicit RandomMap(unsigned seed) : generator_(seed) {}

  double number(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(generator_);
  }
  std::uint32_t below(std::size_t end) {
    return static_cast<std::uint32_t>(
        std::uniform_int_distribution<std::size_t>(0, end - 1)(generator_));
  }
  gslam::Vec3d vector(double size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
  }
  gslam::SE3d pose() { return gslam::SE3d(gslam::SO3d::exp(vector(1.8)), vector(10)); }

  gslam::Image image(int width, int height, gslam::PixelType type, int channels) {
    gslam::Image image(width, height, type, channels);
    for (int y = 0; y < height; ++y) {
      for (std::size_t i = 0; i < image.rowBytes(); ++i) {
        image.bytes(y)[i] = static_cast<std::uint8_t>(below(256));
      }
    }
    return image;
  }

  gslam::SensorRig rig() {
    gslam::SensorRig rig;
    rig.cameras.resize(2);
    rig.cameras[0].name = "left";
    rig.cameras[0].camera = gslam::Camera::fromParameters(
        "radtan", 752, 480, {458.654, 457.296, 367.215, 248.375, -0.28, 0.07, 0.0002, 1e-05});
    rig.cameras[0].T_body_camera = gslam::SE3d(gslam::SO3d::exp({0.01, 0.02, 0.01}), {0.1, 0, 0});
    rig.cameras[0].rate = 20;
    rig.cameras[1].name = "right";
    rig.cameras[1].kind = gslam::ImageKind::depth;
    rig.cameras[1].depth_scale = 0.001;
    rig.cameras[1].camera =
        gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5});
    rig.has_imu = true;
    rig.imu.rate = 200;
    rig.imu.T_body_imu = pose();
    rig.has_gnss = true;
    rig.gnss_antenna = vector(1);
    return rig;
  }

  gslam::Keyframe keyframe(std::size_t features, bool has_images) {
    auto content = std::make_shared<gslam::KeyframeContent>();
    for (std::size_t i = 0; i < features; ++i) {
      gslam::Feature feature;
      feature.pixel = {float(number(0, 640)), float(number(0, 480))};
      feature.size = float(number(1, 31));
      feature.angle = float(number(-3, 3));
      feature.response = float(number(0, 100));
      feature.octave = std::int16_t(int(below(9)) - 1);
      feature.camera = std::uint16_t(below(2));
      content->features.push_back(feature);
    }
    if (features != 0) {
      content->descriptors = image(4, static_cast<int>(features), gslam::PixelType::u8, 1);
    }
    if (has_images) content->images = images();
    gslam::Keyframe keyframe;
    keyframe.frame = below(1000000);
    keyframe.stamp = std::int64_t(below(1000000)) * 1000000007;
    keyframe.T_world_body = pose();
    keyframe.content = std::move(content);
    return keyframe;
  }

  std::vector<gslam::CameraImage> images() {
    std::vector<gslam::CameraImage> images(2);
    images[0].name = "left";
    images[0].image = image(3, 2, gslam::PixelType::u8, 3);
    images[0].kind = gslam::ImageKind::bgr;
    images[0].exposure = 12345678;
    images[0].T_body_camera = pose();
    images[1].name = "right";
    images[1].image = image(2, 2, gslam::PixelType::u16, 1);
    images[1].kind = gslam::ImageKind::depth;
    images[1].depth_scale = 0.0002;
    images[1].camera = gslam::Camera::fromParameters("fov", 640, 480, {318, 321, 319, 239, 0.9});
    return images;
  }

  gslam::MapPoint point() {
    gslam::MapPoint point;
    point.position = vector(10);
    if (below(2) == 0) {
      const gslam::Vec3d normal = vector(1).normalized();
      point.normal = {float(normal[0]), float(normal[1]), float(normal[2])};
    }
    point.color = gslam::Color{std::uint8_t(below(256)), 7, std::uint8_t(below(256)), 255};
    point.label = below(5);
    point.kind = static_cast<gslam::PointKind>(below(5));
    return point;
  }

  gslam::Shape shape() {
    gslam::Shape shape;
    shape.R_world_shape = gslam::SO3d::exp(vector(1));
    shape.size = {number(0, 1), number(0, 1), 0};
    return shape;
  }

  gslam::PoseEdge edge(gslam::KeyframeId from, gslam::KeyframeId to) {
    gslam::PoseEdge edge;
    edge.from = from;
    edge.to = to;
    edge.T_from_to = pose();
    edge.scale = number(0.5, 2);
    edge.kind = static_cast<gslam::EdgeKind>(below(4));
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c <= r; ++c) {
        edge.information(r, c) = edge.information(c, r) = r == c ? 10 : number(-1, 1);
      }
    }
    return edge;
  }

  /// A map with this many keyframes and points, with gaps between their ids.
  gslam::Map map(std::size_t keyframes, std::size_t points) {
    gslam::Map map;
    map.setRig(rig());
    std::vector<gslam::KeyframeId> seers;
    for (std::size_t i = 0; i < keyframes; ++i) {
      seers.push_back(map.add(keyframe(1 + below(8), i % 3 == 0)));
      if (i > 0) map.add(edge(seers[i - 1], seers[i]));
    }
    for (std::size_t i = 0; i < points; ++i) addPoint(map, seers);
    map.add(keyframe(0, false));
    map.remove(map.add(point()));
    if (keyframes > 2) map.remove(gslam::EdgeId(0));
    if (keyframes > 3) map.remove(seers[1]);
    return map;
  }

 private:
  void addPoint(gslam::Map& map, const std::vector<gslam::KeyframeId>& seers) {
    const gslam::PointId id = map.add(point());
    if (below(2) == 0) map.setShape(id, shape());
    if (below(3) == 0) map.setDescriptor(id, image(4, 1, gslam::PixelType::u8, 1));
    if (below(5) == 0) map.setDescriptor(id, image(2, 1, gslam::PixelType::f32, 1));
    if (below(4) == 0) map.remove(map.add(point()));
    for (int i = 0; i < 3 && !seers.empty(); ++i) {
      const gslam::KeyframeId seer = seers[below(seers.size())];
      const std::size_t features = map.pointsSeen(seer).size();
      if (features != 0) map.observe(id, seer, below(features));
    }
  }

  std::mt19937 generator_;
};

}  // namespace gslam_test

#endif  // GSLAM_CORE_TESTS_RANDOM_MAP_H
