// Poses, cameras and images as bytes: what maps have in common with frames.
#ifndef GSLAM_CORE_DETAIL_BINARY_PARTS_H
#define GSLAM_CORE_DETAIL_BINARY_PARTS_H

#include <gslam/base/error.h>
#include <gslam/core/detail/binary_reader.h>
#include <gslam/core/detail/binary_writer.h>
#include <gslam/core/frame.h>
#include <gslam/core/image.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

template <class T, std::size_t N>
void writePart(BinaryWriter& out, const Vec<T, N>& v) {
  out.numbers(v.data(), N);
}
template <class T, std::size_t N>
void readPart(BinaryReader& in, Vec<T, N>& v) {
  in.numbers(v.data(), N);
}

// qx qy qz qw
inline void writePart(BinaryWriter& out, const SO3d& rotation) {
  const Vec4d& q = rotation.quaternion();
  if (!(q.norm() > 1e-15 && std::isfinite(q.norm()))) {
    throw ArgumentError("rotation", "is not finite or zero, which no reader takes");
  }
  writePart(out, q);
}
// What a product of rotations has lost of its norm stays lost: what is read is what was written, to
// the bit. Only what is no product of rotations is normalised.
inline void readPart(BinaryReader& in, SO3d& rotation) {
  static_assert(std::is_trivially_copyable<SO3d>::value && sizeof(SO3d) == sizeof(Vec4d),
                "a rotation is its quaternion");
  Vec4d q;
  readPart(in, q);
  if (std::fabs(q.squaredNorm() - 1) <= 1e-6) {
    std::memcpy(static_cast<void*>(&rotation), q.data(), sizeof(rotation));
  } else {
    rotation = SO3d::fromQuaternion(q[0], q[1], q[2], q[3]);
  }
}

// tx ty tz qx qy qz qw
inline void writePart(BinaryWriter& out, const SE3d& pose) {
  writePart(out, pose.translation());
  writePart(out, pose.rotation());
}
inline void readPart(BinaryReader& in, SE3d& pose) {
  Vec3d translation;
  SO3d rotation;
  readPart(in, translation);
  readPart(in, rotation);
  pose = SE3d(rotation, translation);
}

// The name of the model, empty for none, and then its size and parameters.
inline void writePart(BinaryWriter& out, const Camera& camera) {
  out.text(camera.modelName());
  if (!camera.isValid()) return;
  out.number(std::int32_t(camera.width()));
  out.number(std::int32_t(camera.height()));
  const std::vector<double> values = camera.parameters();
  out.count(values.size());
  out.numbers(values.data(), values.size());
}
inline void readPart(BinaryReader& in, Camera& camera) {
  const std::string model = in.text();
  camera = Camera();
  if (model.empty()) return;
  const std::int32_t width = in.number<std::int32_t>();
  const std::int32_t height = in.number<std::int32_t>();
  std::vector<double> values(in.count(sizeof(double)));
  in.numbers(values.data(), values.size());
  camera = Camera::fromParameters(model, width, height, values);
}

template <class T>
void swapEach(std::uint8_t* bytes, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i, bytes += sizeof(T)) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    storeLittle(bytes, value);
  }
}
// Between the order of the machine and that of files, which takes the same steps both ways.
inline void swapPixels(std::uint8_t* bytes, std::size_t count, std::size_t size) noexcept {
  if (kIsLittleEndian || size == 1) return;
  if (size == 2) swapEach<std::uint16_t>(bytes, count);
  if (size == 4) swapEach<std::uint32_t>(bytes, count);
  if (size == 8) swapEach<std::uint64_t>(bytes, count);
}

// Its shape, and the rows without the gaps between them.
inline void writeShape(BinaryWriter& out, int width, int height, int channels, PixelType type) {
  out.number(std::uint32_t(width));
  out.number(std::uint32_t(height));
  out.number(std::uint16_t(channels));
  out.number(static_cast<std::uint8_t>(type));
  out.number(std::uint8_t(0));
}
inline void writeRow(BinaryWriter& out, const Image& image, int y) {
  const std::size_t size = pixelTypeSize(image.type());
  const std::size_t row_bytes = image.rowBytes();
  std::uint8_t* const place = out.grow(row_bytes);
  std::memcpy(place, image.bytes(y), row_bytes);
  swapPixels(place, row_bytes / size, size);
}
inline void writePart(BinaryWriter& out, const Image& image) {
  writeShape(out, image.width(), image.height(), image.channels(), image.type());
  for (int y = 0; y < image.height(); ++y) writeRow(out, image, y);
}
inline void readPart(BinaryReader& in, Image& image) {
  const std::uint32_t width = in.number<std::uint32_t>(), height = in.number<std::uint32_t>();
  const std::uint16_t channels = in.number<std::uint16_t>();
  const PixelType type = static_cast<PixelType>(in.choice(11, "pixel type"));
  in.zeros(1);
  image = Image();
  if (width == 0 && height == 0) return;
  // No product of these overflows: 31, 16 and 3 bits, and then 31 more at the division.
  const std::uint64_t row = std::uint64_t(width) * channels * pixelTypeSize(type);
  if (row == 0 || width > 0x7FFFFFFF || height > 0x7FFFFFFF || height > in.remaining() / row) {
    in.fail("has an image of " + std::to_string(width) + " x " + std::to_string(height) + " x " +
            std::to_string(channels) + " " + pixelTypeName(type) + " with " +
            std::to_string(in.remaining()) + " bytes left");
  }
  // Every pixel is overwritten, so that large ones need not be zero first.
  const std::size_t size = static_cast<std::size_t>(row * height);
  const std::shared_ptr<void> memory = alignedMemory(size);
  in.bytes(memory.get(), size);
  swapPixels(static_cast<std::uint8_t*>(memory.get()), size / pixelTypeSize(type),
             pixelTypeSize(type));
  image = Image::wrap(memory.get(), int(width), int(height), type, channels, 0, memory);
}

inline void writePart(BinaryWriter& out, const CameraImage& image) {
  out.text(image.name);
  out.number(static_cast<std::uint8_t>(image.kind));
  out.number(image.exposure);
  out.number(image.depth_scale);
  writePart(out, image.T_body_camera);
  writePart(out, image.camera);
  writePart(out, image.image);
}
inline void readPart(BinaryReader& in, CameraImage& image) {
  image.name = in.text();
  image.kind = static_cast<ImageKind>(in.choice(kImageKinds, "kind of image"));
  image.exposure = in.number<std::int64_t>();
  image.depth_scale = in.number<double>();
  readPart(in, image.T_body_camera);
  readPart(in, image.camera);
  readPart(in, image.image);
}
constexpr std::size_t kLeastCameraImage = 4 + 1 + 8 + 8 + 56 + 4 + 12;  // bytes

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_BINARY_PARTS_H
