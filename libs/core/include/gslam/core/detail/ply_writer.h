// A map as PLY.
#ifndef GSLAM_CORE_DETAIL_PLY_WRITER_H
#define GSLAM_CORE_DETAIL_PLY_WRITER_H

#include <gslam/core/detail/binary_writer.h>
#include <gslam/core/map.h>
#include <gslam/svar/detail/print_number.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// A line of numbers, as text or as bytes.
class PlyLine {
 public:
  PlyLine(BinaryWriter& out, bool is_binary) : out_(out), is_binary_(is_binary) {}

  template <class Real>
  void real(Real value) {
    if (is_binary_) return out_.number(value);
    char text[32];
    std::size_t size = printDouble(double(value), text);
    if (size == 0) return word(std::isnan(value) ? "nan" : value < 0 ? "-inf" : "inf");
    if (size > 2 && text[size - 1] == '0' && text[size - 2] == '.') size -= 2;
    word(std::string(text, size));
  }
  void byte(std::uint8_t value) {
    if (is_binary_) return out_.number(value);
    word(std::to_string(int(value)));
  }
  void integer(std::int32_t value) {
    if (is_binary_) return out_.number(value);
    word(std::to_string(value));
  }
  template <class T, std::size_t N>
  void reals(const Vec<T, N>& values) {
    for (std::size_t i = 0; i < N; ++i) real(values[i]);
  }
  void end() {
    if (!is_binary_) out_.bytes("\n", 1);
    is_first_ = true;
  }

 private:
  void word(const std::string& text) {
    if (!is_first_) out_.bytes(" ", 1);
    is_first_ = false;
    out_.bytes(text.data(), text.size());
  }

  BinaryWriter& out_;
  bool is_binary_;
  bool is_first_ = true;
};

// The pyramid that a camera looks into: its tip and the corners of its image.
struct Frustum {
  Vec3d points[5];
  static constexpr int kEdges = 8;
};

inline Frustum frustumOf(const Camera& camera, const SE3d& T_world_camera, double depth) {
  Frustum frustum;
  const double right = camera.width() - 0.5, bottom = camera.height() - 0.5;
  const Vec2d corners[] = {{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}};
  frustum.points[0] = T_world_camera.translation();
  for (std::size_t i = 0; i < 4; ++i) {
    Vec3d bearing = {0, 0, 1};
    camera.unproject(corners[i], bearing);
    const double along = bearing[2] > 0.1 ? bearing[2] : 1;  // very wide ones end on a ball
    frustum.points[i + 1] = T_world_camera * ((depth / along) * bearing);
  }
  return frustum;
}

// Sink has write(bytes, count).
template <class Sink>
class PlyWriter {
 public:
  PlyWriter(const Map& map, bool is_binary, bool has_keyframes, double frustum_depth, Sink& sink)
      : map_(map),
        sink_(sink),
        line_(out_, is_binary),
        is_binary_(is_binary),
        has_keyframes_(has_keyframes) {
    for (const auto& item : map.points()) {
      has_normals_ = has_normals_ || item.value.normal != Vec3f{};
      has_colors_ = has_colors_ || item.value.color.alpha != 0;
    }
    if (frustum_depth > 0) addFrusta(frustum_depth);
  }

  void write() {
    writeHeader();
    for (const auto& item : map_.points()) writePoint(item.value);
    for (const Frustum& frustum : frusta_) writeCorners(frustum);
    if (has_keyframes_) {
      for (const auto& item : map_.keyframes()) writeKeyframe(item.value);
    }
    for (std::size_t i = 0; i < frusta_.size(); ++i) writeEdges(i);
    flush();
  }

 private:
  void flush() {
    sink_.write(out_.data(), out_.size());
    out_.clear();
  }
  void endLine() {
    line_.end();
    if (out_.size() > (1 << 19)) flush();
  }

  void addFrusta(double depth) {
    for (const auto& item : map_.keyframes()) {
      for (const CameraSensor& sensor : map_.rig().cameras) {
        if (!sensor.camera.isValid()) continue;
        const SE3d T_world_camera = item.value.T_world_body * sensor.T_body_camera;
        frusta_.push_back(frustumOf(sensor.camera, T_world_camera, depth));
      }
    }
    const std::size_t vertices = map_.points().size() + 5 * frusta_.size();
    if (vertices > 0x7FFFFFFF) throw Error("a PLY file cannot have edges of so many vertices");
    has_colors_ = has_colors_ || !frusta_.empty();
  }

  void writeHeader() {
    const auto count = [](std::size_t n) { return std::to_string(n) + "\n"; };
    std::string header = "ply\nformat ";
    header += is_binary_ ? "binary_little_endian" : "ascii";
    header += " 1.0\ncomment GSLAM map\nelement vertex " +
              count(map_.points().size() + 5 * frusta_.size());
    header += "property double x\nproperty double y\nproperty double z\n";
    if (has_normals_) header += "property float nx\nproperty float ny\nproperty float nz\n";
    if (has_colors_) {
      header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    if (!frusta_.empty()) header += "property uchar frustum\n";  // 1: no point of the map
    if (has_keyframes_) {
      header += "element keyframe " + count(map_.keyframes().size());
      for (const char* const name : {"time", "x", "y", "z", "qx", "qy", "qz", "qw"}) {
        header += std::string("property double ") + name + "\n";
      }
    }
    if (!frusta_.empty()) {
      header += "element edge " + count(Frustum::kEdges * frusta_.size()) +
                "property int vertex1\nproperty int vertex2\n";
    }
    header += "end_header\n";
    out_.bytes(header.data(), header.size());
  }

  void writeVertex(const Vec3d& position, const Vec3f& normal, const Color& color,
                   bool is_frustum) {
    line_.reals(position);
    if (has_normals_) line_.reals(normal);
    if (has_colors_) {
      const bool is_known = color.alpha != 0;
      line_.byte(is_known ? color.red : 255);
      line_.byte(is_known ? color.green : 255);
      line_.byte(is_known ? color.blue : 255);
    }
    if (!frusta_.empty()) line_.byte(is_frustum ? 1 : 0);
    endLine();
  }
  void writePoint(const MapPoint& point) {
    writeVertex(point.position, point.normal, point.color, false);
  }
  void writeCorners(const Frustum& frustum) {
    for (const Vec3d& corner : frustum.points) {
      writeVertex(corner, Vec3f{}, Color{0, 128, 255, 255}, true);
    }
  }
  void writeKeyframe(const Keyframe& keyframe) {
    line_.real(double(keyframe.stamp) * 1e-9);
    line_.reals(keyframe.T_world_body.translation());
    line_.reals(keyframe.T_world_body.rotation().quaternion());
    endLine();
  }
  // From the tip to the corners, and around.
  void writeEdges(std::size_t frustum) {
    const std::size_t tip = map_.points().size() + 5 * frustum;
    for (std::size_t i = 0; i < 4; ++i) {
      writeEdge(tip, tip + 1 + i);
      writeEdge(tip + 1 + i, tip + 1 + (i + 1) % 4);
    }
  }
  void writeEdge(std::size_t a, std::size_t b) {
    line_.integer(static_cast<std::int32_t>(a));
    line_.integer(static_cast<std::int32_t>(b));
    endLine();
  }

  const Map& map_;
  Sink& sink_;
  BinaryWriter out_;
  PlyLine line_;
  bool is_binary_;
  bool has_keyframes_;
  bool has_normals_ = false;
  bool has_colors_ = false;
  std::vector<Frustum> frusta_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_PLY_WRITER_H
