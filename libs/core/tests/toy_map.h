// The map of the toy plugin: everything that a map can have, of numbers that need no rounding, so
// that it is the same whatever flags it was compiled with.
#ifndef GSLAM_CORE_TESTS_TOY_MAP_H
#define GSLAM_CORE_TESTS_TOY_MAP_H

#include <gslam/core/map.h>

#include <cstddef>
#include <cstdint>
#include <memory>

inline gslam::SE3d toyPose(int i) {
  const double s = i % 2 == 0 ? 0.5 : -0.5;
  return gslam::SE3d(gslam::SO3d::fromQuaternion(s, 0.5, -s, 0.5), {i / 4.0, i / 8.0, -i / 2.0});
}

inline gslam::Image toyImage(int width, int height, int first) {
  gslam::Image image(width, height, gslam::PixelType::u8);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at<std::uint8_t>(x, y) = static_cast<std::uint8_t>(first + 7 * y + x);
    }
  }
  return image;
}

inline gslam::Keyframe toyKeyframe(int i) {
  const auto content = std::make_shared<gslam::KeyframeContent>();
  content->features.resize(8);
  for (std::size_t f = 0; f < 8; ++f) {
    content->features[f].pixel = {float(f) + 0.5F, float(i)};
    content->features[f].octave = static_cast<std::int16_t>(i - int(f));
    content->features[f].size = 31;
  }
  content->descriptors = toyImage(32, 8, i);
  content->images.resize(1);
  content->images[0].image = toyImage(4, 3, i);
  content->images[0].name = "a name that is longer than what a string has room for";
  content->images[0].T_body_camera = toyPose(i + 1);
  gslam::Keyframe keyframe;
  keyframe.frame = std::uint64_t(10 * i);
  keyframe.stamp = std::int64_t(1000000007) * i;
  keyframe.T_world_body = toyPose(i);
  keyframe.content = content;
  return keyframe;
}

inline void addToyPoint(gslam::Map& map, int i, gslam::KeyframeId seer, std::uint32_t feature) {
  gslam::MapPoint point;
  point.position = {i / 16.0, 1.5, -i / 32.0};
  point.normal = {0, i % 2 == 0 ? 1.0F : -1.0F, 0};
  point.color = gslam::Color{static_cast<std::uint8_t>(i), 2, 3, 255};
  point.label = std::uint32_t(i);
  point.kind = static_cast<gslam::PointKind>(i % 5);
  const gslam::PointId id = map.add(point);
  map.observe(id, seer, feature);
  if (i % 3 == 0) map.setDescriptor(id, toyImage(32, 1, i));
  gslam::Shape shape;
  shape.R_world_shape = toyPose(i).rotation();
  shape.size = {i / 2.0, 1, 2};
  if (i % 4 == 0) map.setShape(id, shape);
}

inline gslam::Map toyMap() {
  gslam::Map map;
  gslam::SensorRig rig;
  rig.cameras.resize(2);
  rig.cameras[1].name = "right";
  rig.cameras[1].T_body_camera = toyPose(3);
  map.setRig(rig);
  const int keyframes = 300;  // more than a chunk has
  for (int i = 0; i < keyframes; ++i) map.add(toyKeyframe(i));
  for (int i = 0; i < 1000; ++i) {
    addToyPoint(map, i, gslam::KeyframeId(std::uint32_t(i % keyframes)),
                std::uint32_t(2 * (i / keyframes)));
  }
  map.insert(gslam::PointId(100000), gslam::MapPoint());  // in another page
  gslam::PoseEdge edge;
  for (int i = 1; i < keyframes; ++i) {
    edge.from = gslam::KeyframeId(std::uint32_t(i - 1));
    edge.to = gslam::KeyframeId(std::uint32_t(i));
    edge.T_from_to = toyPose(i);
    edge.information(2, 2) = i;
    edge.kind = static_cast<gslam::EdgeKind>(i % 4);
    map.add(edge);
  }
  map.remove(gslam::KeyframeId(5));
  map.remove(gslam::PointId(17));
  return map;
}

#endif  // GSLAM_CORE_TESTS_TOY_MAP_H
