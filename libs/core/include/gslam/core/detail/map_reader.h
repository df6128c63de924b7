// A map out of sections of bytes that may be wrong. map_file.h says what stands where.
#ifndef GSLAM_CORE_DETAIL_MAP_READER_H
#define GSLAM_CORE_DETAIL_MAP_READER_H

#include <gslam/base/detail/checksum.h>
#include <gslam/base/error.h>
#include <gslam/core/detail/binary_file.h>
#include <gslam/core/detail/binary_parts.h>
#include <gslam/core/detail/binary_reader.h>
#include <gslam/core/detail/map_writer.h>
#include <gslam/core/map.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Fills a map faster than its own functions can, which look everything up anew.
struct MapLoader {
  Map map;

  // Ids that were given once are not given again.
  void reserveIds(std::uint32_t keyframes, std::uint32_t points, std::uint32_t edges) noexcept {
    map.keyframe_end_ = std::max(map.keyframe_end_, keyframes);
    map.point_end_ = std::max(map.point_end_, points);
    map.edge_end_ = std::max(map.edge_end_, edges);
  }

  // All who see a point. What is wrong, or null; then the map is of no use any more.
  const char* observe(std::uint32_t point, Span<const Observation> seen) {
    if (map.points_.find(point) == nullptr) return "a point that is not in the map";
    if (!map.observations_.list(point).empty()) return "a point twice";
    for (const Observation& by : seen) {
      const Links& links = linksOf(std::uint32_t(by.keyframe));
      if (links.points == nullptr) return "a keyframe that is not in the map";
      if (by.feature >= links.size) return "a feature that its keyframe does not have";
      if (links.points[by.feature] != kNoPoint) return "a feature that sees two points";
      links.points[by.feature] = PointId(point);
    }
    map.observations_.assign(point, seen, map.owner_);
    map.observation_count_ += seen.size();
    return nullptr;
  }

 private:
  struct Links {
    std::uint32_t keyframe = 0xFFFFFFFF;
    std::uint32_t size = 0;
    PointId* points = nullptr;
  };

  // Points that are neighbours are seen by the same keyframes.
  const Links& linksOf(std::uint32_t keyframe) {
    Links& links = recent_[keyframe % kRecent];
    if (links.keyframe == keyframe && links.points != nullptr) return links;
    KeyframeRow* const row = map.keyframes_.edit(keyframe, map.owner_);
    links = Links();
    if (row == nullptr) return links;
    std::vector<PointId>& points = row->points.edit(map.owner_);
    links.keyframe = keyframe;
    links.size = static_cast<std::uint32_t>(points.size());
    links.points = points.data();
    return links;
  }

  static constexpr std::size_t kRecent = 4096;
  std::vector<Links> recent_ = std::vector<Links>(kRecent);
};

class MapReader {
 public:
  explicit MapReader(ByteSource& source) : source_(source) {}

  Map read() {
    readMagic();
    while (!is_over_) readSection();
    if (source_.remaining() != 0) fail("has bytes behind its end");
    return std::move(loader_.map);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw ParseError(source_.name(), 0, 0,
                     "byte " + std::to_string(source_.offset()) + ": " + problem);
  }

  void readMagic() {
    std::uint8_t head[16];
    if (source_.remaining() < sizeof(head)) fail("ends too early: is no GSLAM map");
    source_.read(head, sizeof(head));
    BinaryReader in(head, sizeof(head), source_.name());
    if (std::memcmp(in.take(8), kMapMagic, 8) != 0) fail("is no GSLAM map");
    const std::uint32_t version = in.number<std::uint32_t>();
    if (version != kMapVersion) {
      in.fail("has version " + std::to_string(version) + " of the format, expected " +
              std::to_string(kMapVersion));
    }
    in.zeros(4);
  }

  // One section is in memory at a time, and none that is longer than the rest of the file.
  void readSection() {
    const std::uint64_t offset = source_.offset();
    std::uint8_t head[kSectionHead];
    if (source_.remaining() < kSectionHead + kSectionTail) fail("ends before its last section");
    source_.read(head, kSectionHead);
    BinaryReader head_in(head, kSectionHead, source_.name(), offset);
    const std::string tag(reinterpret_cast<const char*>(head_in.take(4)), 4);
    head_in.zeros(4);
    const std::uint64_t length = head_in.number<std::uint64_t>();
    if (length > source_.remaining() - kSectionTail) {
      head_in.fail("has a section of " + std::to_string(length) + " bytes, with " +
                   std::to_string(source_.remaining()) + " left");
    }
    const std::size_t size = kSectionHead + static_cast<std::size_t>(length);
    std::uint8_t* const bytes = room(size + kSectionTail);
    std::memcpy(bytes, head, kSectionHead);
    source_.read(bytes + kSectionHead, size + kSectionTail - kSectionHead);
    if (loadLittle<std::uint64_t>(bytes + size) != Xxh64::of(bytes, size)) {
      head_in.fail("is damaged: the checksum of the section does not match");
    }
    BinaryReader in(bytes + kSectionHead, size - kSectionHead, source_.name(),
                    offset + kSectionHead);
    readSection(tag, in);
    ++sections_;
  }

  std::uint8_t* room(std::size_t size) {
    if (size > capacity_) {
      buffer_.reset();
      buffer_.reset(new std::uint8_t[size]);
      capacity_ = size;
    }
    return buffer_.get();
  }

  void readSection(const std::string& tag, BinaryReader& in) {
    try {
      if (tag == "HEAD") return readHead(in);
      if (tag == "RIG ") return readRig(in);
      if (tag == "KEYF") return readAll(in, 96, &MapReader::readKeyframe);
      if (tag == "PNTS") return readAll(in, 52, &MapReader::readPoint);
      if (tag == "SHAP") return readAll(in, 60, &MapReader::readShapeOf);
      if (tag == "DESC") return readDescriptors(in);
      if (tag == "OBSV") return readAll(in, 8, &MapReader::readObservations);
      if (tag == "EDGE") return readAll(in, 368, &MapReader::readEdge);
      if (tag == "END ") return readEnd(in);
    } catch (const ArgumentError& error) {  // from what the numbers are made into
      in.fail(error.what());
    }
  }

  void readAll(BinaryReader& in, std::size_t least_size,
               void (MapReader::*readOne)(BinaryReader&)) {
    const std::size_t count = in.count(least_size);
    for (std::size_t i = 0; i < count; ++i) (this->*readOne)(in);
    in.end();
  }

  void readHead(BinaryReader& in) {
    const std::uint32_t keyframes = in.number<std::uint32_t>();
    const std::uint32_t points = in.number<std::uint32_t>();
    const std::uint32_t edges = in.number<std::uint32_t>();
    loader_.reserveIds(keyframes, points, edges);
    in.end();
  }

  void readRig(BinaryReader& in) {
    SensorRig rig;
    const std::size_t count = in.count(4 + 1 + 16 + 56 + 4);
    for (std::size_t i = 0; i < count; ++i) {
      CameraSensor sensor;
      sensor.name = in.text();
      sensor.kind = static_cast<ImageKind>(in.choice(kImageKinds, "kind of image"));
      sensor.rate = in.number<double>();
      sensor.depth_scale = in.number<double>();
      readPart(in, sensor.T_body_camera);
      readPart(in, sensor.camera);
      rig.cameras.push_back(std::move(sensor));
    }
    rig.has_imu = in.choice(2, "answer") != 0;
    readPart(in, rig.imu.T_body_imu);
    rig.imu.rate = in.number<double>();
    rig.imu.gyro_noise = in.number<double>();
    rig.imu.accel_noise = in.number<double>();
    rig.imu.gyro_bias_walk = in.number<double>();
    rig.imu.accel_bias_walk = in.number<double>();
    rig.has_gnss = in.choice(2, "answer") != 0;
    readPart(in, rig.gnss_antenna);
    in.end();
    loader_.map.setRig(rig);
  }

  static void readFeatures(BinaryReader& in, std::vector<Feature>& features) {
    features.resize(in.count(sizeof(Feature)));
    if (kIsLittleEndian) return in.bytes(features.data(), features.size() * sizeof(Feature));
    for (Feature& f : features) {
      readPart(in, f.pixel);
      f.size = in.number<float>();
      f.angle = in.number<float>();
      f.response = in.number<float>();
      f.octave = in.number<std::int16_t>();
      f.camera = in.number<std::uint16_t>();
    }
  }

  void readKeyframe(BinaryReader& in) {
    const KeyframeId id = KeyframeId(in.number<std::uint32_t>());
    Keyframe keyframe;
    keyframe.frame = in.number<std::uint64_t>();
    keyframe.stamp = in.number<std::int64_t>();
    readPart(in, keyframe.T_world_body);
    const auto content = std::make_shared<KeyframeContent>();
    readFeatures(in, content->features);
    readPart(in, content->descriptors);
    content->images.resize(in.count(kLeastCameraImage));
    for (CameraImage& image : content->images) readPart(in, image);
    keyframe.content = content;
    loader_.map.insert(id, keyframe);
  }

  void readPoint(BinaryReader& in) {
    const PointId id = PointId(in.number<std::uint32_t>());
    MapPoint point;
    readPart(in, point.position);
    readPart(in, point.normal);
    point.color.red = in.number<std::uint8_t>();
    point.color.green = in.number<std::uint8_t>();
    point.color.blue = in.number<std::uint8_t>();
    point.color.alpha = in.number<std::uint8_t>();
    point.label = in.number<std::uint32_t>();
    point.kind = static_cast<PointKind>(in.choice(kPointKinds, "kind of point"));
    in.zeros(3);
    loader_.map.insert(id, point);
  }

  void readShapeOf(BinaryReader& in) {
    const PointId id = PointId(in.number<std::uint32_t>());
    Shape shape;
    readPart(in, shape.R_world_shape);
    readPart(in, shape.size);
    loader_.map.setShape(id, shape);
  }

  void readDescriptors(BinaryReader& in) {
    std::vector<PointId> ids(in.count(sizeof(std::uint32_t)));
    for (PointId& id : ids) id = PointId(in.number<std::uint32_t>());
    Image rows;
    readPart(in, rows);
    in.end();
    if (std::size_t(rows.height()) != ids.size()) {
      in.fail("has " + std::to_string(rows.height()) + " descriptors of " +
              std::to_string(ids.size()) + " points");
    }
    for (std::size_t i = 0; i < ids.size(); ++i) {
      loader_.map.setDescriptor(ids[i], rows.view(0, static_cast<int>(i), rows.width(), 1));
    }
  }

  void readObservations(BinaryReader& in) {
    const std::uint32_t point = in.number<std::uint32_t>();
    seen_.resize(in.count(sizeof(Observation)));
    if (kIsLittleEndian) {
      in.bytes(seen_.data(), seen_.size() * sizeof(Observation));
    } else {
      for (Observation& by : seen_) {
        by.keyframe = KeyframeId(in.number<std::uint32_t>());
        by.feature = in.number<std::uint32_t>();
      }
    }
    const char* const problem = loader_.observe(point, seen_);
    if (problem != nullptr) in.fail(std::string("has observations of ") + problem);
  }

  void readEdge(BinaryReader& in) {
    const EdgeId id = EdgeId(in.number<std::uint32_t>());
    PoseEdge edge;
    edge.from = KeyframeId(in.number<std::uint32_t>());
    edge.to = KeyframeId(in.number<std::uint32_t>());
    edge.kind = static_cast<EdgeKind>(in.choice(kEdgeKinds, "kind of edge"));
    in.zeros(3);
    readPart(in, edge.T_from_to);
    edge.scale = in.number<double>();
    in.numbers(edge.information.data(), 36);
    loader_.map.insert(id, edge);
  }

  void readEnd(BinaryReader& in) {
    const std::uint64_t sections = in.number<std::uint64_t>();
    in.end();
    if (sections != sections_) {
      in.fail("lacks a section: " + std::to_string(sections_) + " of " + std::to_string(sections));
    }
    is_over_ = true;
  }

  ByteSource& source_;
  MapLoader loader_;
  std::unique_ptr<std::uint8_t[]> buffer_;
  std::size_t capacity_ = 0;
  std::vector<Observation> seen_;
  std::uint64_t sections_ = 0;
  bool is_over_ = false;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_MAP_READER_H
