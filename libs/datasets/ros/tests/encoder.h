// Writes messages byte by byte, as the specifications have them: nothing is shared with the
// readers.
#ifndef GSLAM_DATASETS_ROS_TESTS_ENCODER_H
#define GSLAM_DATASETS_ROS_TESTS_ENCODER_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

enum class Coding { ros1, little_cdr, big_cdr };

class Encoder {
 public:
  explicit Encoder(Coding coding) : coding_(coding) {
    if (coding == Coding::little_cdr) bytes_ = {0, 1, 0, 0};
    if (coding == Coding::big_cdr) bytes_ = {0, 0, 0, 0};
  }

  template <class T>
  Encoder& number(T value) {
    align(sizeof(T));
    std::uint8_t raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));  // the machine of the tests is little-endian
    const bool is_big = coding_ == Coding::big_cdr;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_.push_back(raw[is_big ? sizeof(T) - 1 - i : i]);
    }
    return *this;
  }
  Encoder& u8(int value) { return number(static_cast<std::uint8_t>(value)); }
  Encoder& u32(std::size_t value) { return number(static_cast<std::uint32_t>(value)); }
  Encoder& f64(double value) { return number(value); }
  Encoder& f64s(const std::vector<double>& values) {
    for (const double value : values) f64(value);
    return *this;
  }
  Encoder& text(const std::string& text) {
    u32(text.size() + (coding_ == Coding::ros1 ? 0 : 1));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    if (coding_ != Coding::ros1) bytes_.push_back(0);
    return *this;
  }
  Encoder& blob(const std::vector<std::uint8_t>& blob) {
    u32(blob.size());
    bytes_.insert(bytes_.end(), blob.begin(), blob.end());
    return *this;
  }
  Encoder& header(std::int64_t stamp, const std::string& frame) {
    if (coding_ == Coding::ros1) u32(0);
    u32(static_cast<std::size_t>(stamp / 1000000000));
    u32(static_cast<std::size_t>(stamp % 1000000000));
    return text(frame);
  }

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  void align(std::size_t unit) {
    if (coding_ == Coding::ros1) return;
    while ((bytes_.size() - 4) % unit != 0) bytes_.push_back(0);
  }

  Coding coding_;
  std::vector<std::uint8_t> bytes_;
};

inline std::vector<std::uint8_t> imuBytes(Coding coding, std::int64_t stamp, double base) {
  Encoder out(coding);
  out.header(stamp, "imu").f64s({0, 0, 0, 1}).f64s(std::vector<double>(9, 0));
  out.f64s({base, base + 1, base + 2}).f64s(std::vector<double>(9, 0));
  out.f64s({base + 3, base + 4, base + 5}).f64s(std::vector<double>(9, 0));
  return out.bytes();
}

inline std::vector<std::uint8_t> poseBytes(Coding coding, std::int64_t stamp,
                                           const std::vector<double>& xyz_xyzw) {
  return Encoder(coding).header(stamp, "map").f64s(xyz_xyzw).bytes();
}

inline std::vector<std::uint8_t> odometryBytes(Coding coding, std::int64_t stamp,
                                               const std::vector<double>& xyz_xyzw,
                                               double variance) {
  std::vector<double> covariance(36, 0);
  for (std::size_t i = 0; i < 6; ++i) covariance[7 * i] = variance;
  Encoder out(coding);
  out.header(stamp, "odom").text("base").f64s(xyz_xyzw).f64s(covariance);
  return out.f64s(std::vector<double>(6 + 36, 0)).bytes();
}

inline std::vector<std::uint8_t> transformBytes(Coding coding, std::int64_t stamp,
                                                const std::string& parent, const std::string& child,
                                                const std::vector<double>& xyz_xyzw) {
  Encoder out(coding);
  out.u32(1).header(stamp, parent).text(child).f64s(xyz_xyzw);
  return out.bytes();
}

inline std::vector<std::uint8_t> fixBytes(Coding coding, std::int64_t stamp, int status,
                                          const std::vector<double>& place) {
  Encoder out(coding);
  out.header(stamp, "gps").number(static_cast<std::int8_t>(status));
  out.number(std::uint16_t{1}).f64s(place).f64s({4, 0, 0, 0, 5, 0, 0, 0, 6}).u8(2);
  return out.bytes();
}

struct InfoFields {
  std::uint32_t width = 4, height = 3;
  std::string model = "plumb_bob";
  std::vector<double> d, k = {100, 0, 1.5, 0, 110, 1, 0, 0, 1};
  std::vector<double> p = std::vector<double>(12, 0);
  std::uint32_t binning = 0;
};

inline std::vector<std::uint8_t> infoBytes(Coding coding, std::int64_t stamp,
                                           const std::string& frame, const InfoFields& info) {
  Encoder out(coding);
  out.header(stamp, frame).u32(info.height).u32(info.width).text(info.model);
  out.u32(info.d.size()).f64s(info.d).f64s(info.k).f64s({1, 0, 0, 0, 1, 0, 0, 0, 1}).f64s(info.p);
  out.u32(info.binning).u32(info.binning).u32(0).u32(0).u32(0).u32(0).u8(0);
  return out.bytes();
}

inline std::vector<std::uint8_t> imageBytes(Coding coding, std::int64_t stamp,
                                            const std::string& frame, int width, int height,
                                            const std::string& encoding, int step, bool is_big,
                                            const std::vector<std::uint8_t>& data) {
  Encoder out(coding);
  out.header(stamp, frame).u32(std::size_t(height)).u32(std::size_t(width)).text(encoding);
  return out.u8(is_big ? 1 : 0).u32(std::size_t(step)).blob(data).bytes();
}

inline std::vector<std::uint8_t> compressedBytes(Coding coding, std::int64_t stamp,
                                                 const std::string& format,
                                                 const std::vector<std::uint8_t>& data) {
  return Encoder(coding).header(stamp, "camera").text(format).blob(data).bytes();
}

/// Bytes that look like nothing, the same for the same seed.
inline std::vector<std::uint8_t> noise(std::size_t size, std::uint32_t seed) {
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t& byte : bytes) {
    seed = seed * 1664525U + 1013904223U;
    byte = static_cast<std::uint8_t>(seed >> 24);
  }
  return bytes;
}

#endif  // GSLAM_DATASETS_ROS_TESTS_ENCODER_H
