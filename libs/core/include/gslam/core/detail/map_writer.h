// A map as sections of bytes. map_file.h says what stands where.
#ifndef GSLAM_CORE_DETAIL_MAP_WRITER_H
#define GSLAM_CORE_DETAIL_MAP_WRITER_H

#include <gslam/base/detail/checksum.h>
#include <gslam/base/detail/little_endian.h>
#include <gslam/core/detail/binary_parts.h>
#include <gslam/core/detail/binary_writer.h>
#include <gslam/core/map.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr char kMapMagic[] = "GSLAMMAP";  // without the zero at its end
constexpr std::uint32_t kMapVersion = 1;
constexpr std::size_t kSectionHead = 16;  // tag, zeros, length
constexpr std::size_t kSectionTail = 8;   // checksum

inline void writeFeatures(BinaryWriter& out, const std::vector<Feature>& features) {
  out.count(features.size());
  if (kIsLittleEndian) {  // a Feature is in memory as in files
    out.bytes(features.data(), features.size() * sizeof(Feature));
    return;
  }
  for (const Feature& f : features) {
    writePart(out, f.pixel);
    out.number(f.size);
    out.number(f.angle);
    out.number(f.response);
    out.number(f.octave);
    out.number(f.camera);
  }
}

inline void writePart(BinaryWriter& out, const SensorRig& rig) {
  out.count(rig.cameras.size());
  for (const CameraSensor& sensor : rig.cameras) {
    out.text(sensor.name);
    out.number(static_cast<std::uint8_t>(sensor.kind));
    out.number(sensor.rate);
    out.number(sensor.depth_scale);
    writePart(out, sensor.T_body_camera);
    writePart(out, sensor.camera);
  }
  out.number(std::uint8_t(rig.has_imu));
  writePart(out, rig.imu.T_body_imu);
  out.number(rig.imu.rate);
  out.number(rig.imu.gyro_noise);
  out.number(rig.imu.accel_noise);
  out.number(rig.imu.gyro_bias_walk);
  out.number(rig.imu.accel_bias_walk);
  out.number(std::uint8_t(rig.has_gnss));
  writePart(out, rig.gnss_antenna);
}

// Sink has write(bytes, count).
template <class Sink>
class MapWriter {
 public:
  MapWriter(const Map& map, Sink& sink) : map_(map), sink_(sink) {}

  void write() {
    BinaryWriter head;
    head.bytes(kMapMagic, 8);
    head.number(kMapVersion);
    head.number(std::uint32_t(0));
    sink_.write(head.data(), head.size());
    writeHead();
    writeAll("KEYF", map_.keyframes(), [this](KeyframeId id, const Keyframe& keyframe) {
      writeKeyframe(id, keyframe);
      return true;
    });
    writeAll("PNTS", map_.points(), [this](PointId id, const MapPoint& point) {
      writePoint(id, point);
      return true;
    });
    writeAll("SHAP", map_.points(),
             [this](PointId id, const MapPoint&) { return writeShapeOf(id); });
    writeDescriptors();
    writeAll("OBSV", map_.points(),
             [this](PointId id, const MapPoint&) { return writeObservations(id); });
    writeAll("EDGE", map_.edges(), [this](EdgeId id, const PoseEdge& edge) {
      writeEdge(id, edge);
      return true;
    });
    begin("END ");
    out_.number(sections_);
    end();
  }

 private:
  // Large enough for few calls, small enough for the cache of a processor.
  static constexpr std::size_t kFullSection = 1 << 19;

  void begin(const char* tag) {
    out_.clear();
    out_.bytes(tag, 4);
    out_.number(std::uint32_t(0));
    out_.number(std::uint64_t(0));
  }
  // Of a section of many elements, whose number is not known yet.
  void beginCounted(const char* tag) {
    begin(tag);
    out_.number(std::uint32_t(0));
  }
  void end() {
    ++sections_;
    out_.numberAt(8, std::uint64_t(out_.size() - kSectionHead));
    out_.number(Xxh64::of(out_.data(), out_.size()));
    sink_.write(out_.data(), out_.size());
  }

  // Sections of a tag that begin with the number of their elements. write_one(id, value) writes
  // one, or says that there is none.
  template <class Range, class Write>
  void writeAll(const char* tag, const Range& range, const Write& write_one) {
    std::uint32_t count = 0;
    beginCounted(tag);
    for (const auto& item : range) {
      if (write_one(item.id, item.value)) ++count;
      if (out_.size() < kFullSection) continue;
      endCounted(count);
      beginCounted(tag);
    }
    endCounted(count);
  }
  void endCounted(std::uint32_t& count) {
    if (count == 0) return;  // nothing to write
    out_.numberAt(kSectionHead, count);
    end();
    count = 0;
  }

  void writeHead() {
    begin("HEAD");
    out_.number(std::uint32_t(map_.nextKeyframeId()));
    out_.number(std::uint32_t(map_.nextPointId()));
    out_.number(std::uint32_t(map_.nextEdgeId()));
    end();
    begin("RIG ");
    writePart(out_, map_.rig());
    end();
  }

  void writeKeyframe(KeyframeId id, const Keyframe& keyframe) {
    out_.number(std::uint32_t(id));
    out_.number(keyframe.frame);
    out_.number(keyframe.stamp);
    writePart(out_, keyframe.T_world_body);
    writeFeatures(out_, keyframe.content->features);
    writePart(out_, keyframe.content->descriptors);
    out_.count(keyframe.content->images.size());
    for (const CameraImage& image : keyframe.content->images) writePart(out_, image);
  }

  void writePoint(PointId id, const MapPoint& point) {
    out_.number(std::uint32_t(id));
    writePart(out_, point.position);
    writePart(out_, point.normal);
    out_.number(point.color.red);
    out_.number(point.color.green);
    out_.number(point.color.blue);
    out_.number(point.color.alpha);
    out_.number(point.label);
    out_.number(static_cast<std::uint8_t>(point.kind));
    out_.bytes("\0\0\0", 3);
  }

  bool writeShapeOf(PointId id) {
    const Shape* const shape = map_.shape(id);
    if (shape == nullptr) return false;
    out_.number(std::uint32_t(id));
    writePart(out_, shape->R_world_shape);
    writePart(out_, shape->size);
    return true;
  }

  // Those of one form in one image, so that the reader can keep them as that.
  void writeDescriptors() {
    std::map<std::pair<PixelType, std::pair<int, int>>, std::vector<PointId>> forms;
    for (const auto& item : map_.points()) {
      const Image* const row = map_.descriptor(item.id);
      if (row == nullptr) continue;
      const auto size = std::make_pair(row->width(), row->channels());
      std::vector<PointId>& ids = forms[std::make_pair(row->type(), size)];
      ids.push_back(item.id);
      if (ids.size() * row->rowBytes() >= kFullSection) writeDescriptors(ids);
    }
    for (auto& form : forms) writeDescriptors(form.second);
  }
  void writeDescriptors(std::vector<PointId>& ids) {
    if (ids.empty()) return;
    const Image& first = *map_.descriptor(ids[0]);
    begin("DESC");
    out_.count(ids.size());
    for (const PointId id : ids) out_.number(std::uint32_t(id));
    writeShape(out_, first.width(), static_cast<int>(ids.size()), first.channels(), first.type());
    for (const PointId id : ids) writeRow(out_, *map_.descriptor(id), 0);
    end();
    ids.clear();
  }

  bool writeObservations(PointId id) {
    const Span<const Observation> seen = map_.observations(id);
    if (seen.empty()) return false;
    out_.number(std::uint32_t(id));
    out_.count(seen.size());
    if (kIsLittleEndian) {  // an Observation is in memory as in files
      out_.bytes(seen.data(), seen.size() * sizeof(Observation));
      return true;
    }
    for (const Observation& by : seen) {
      out_.number(std::uint32_t(by.keyframe));
      out_.number(by.feature);
    }
    return true;
  }

  void writeEdge(EdgeId id, const PoseEdge& edge) {
    out_.number(std::uint32_t(id));
    out_.number(std::uint32_t(edge.from));
    out_.number(std::uint32_t(edge.to));
    out_.number(static_cast<std::uint8_t>(edge.kind));
    out_.bytes("\0\0\0", 3);
    writePart(out_, edge.T_from_to);
    out_.number(edge.scale);
    out_.numbers(edge.information.data(), 36);
  }

  const Map& map_;
  Sink& sink_;
  BinaryWriter out_;
  std::uint64_t sections_ = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_MAP_WRITER_H
