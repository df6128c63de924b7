// Numbers to lines of text, the same whatever the locale.
#ifndef GSLAM_DATASETS_SRC_EXPORT_ROW_H
#define GSLAM_DATASETS_SRC_EXPORT_ROW_H

#include <gslam/core/stamp.h>
#include <gslam/geometry/se3.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>

namespace gslam {
inline namespace v1 {
namespace exporting {

/// The shortest text that reads back as the same number.
inline std::string numberText(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof(text), value).ptr);
}

/// As printf's %.<digits>e.
inline std::string scientificText(double value, int digits) {
  char text[64];
  return std::string(
      text,
      std::to_chars(text, text + sizeof(text), value, std::chars_format::scientific, digits).ptr);
}

/// A number with zeros in front, `width` digits or more.
inline std::string paddedText(std::size_t value, std::size_t width) {
  const std::string digits = std::to_string(value);
  return std::string(digits.size() < width ? width - digits.size() : 0, '0') + digits;
}

/// Fields with a separator between each two.
class Row {
 public:
  explicit Row(const char* separator) : separator_(separator) {}

  Row& text(const std::string& field) {
    text_ += (text_.empty() ? "" : separator_) + field;
    return *this;
  }
  Row& nanoseconds(std::int64_t stamp) { return text(std::to_string(stamp)); }
  Row& seconds(std::int64_t stamp) { return text(secondsText(stamp)); }
  Row& number(double value) { return text(numberText(value)); }
  Row& vector(const Vec3d& v) { return number(v[0]).number(v[1]).number(v[2]); }
  /// tx ty tz qx qy qz qw
  Row& poseXyzw(const SE3d& pose) {
    const Vec<double, 4>& q = pose.rotation().quaternion();
    return vector(pose.translation()).number(q[0]).number(q[1]).number(q[2]).number(q[3]);
  }
  /// tx ty tz qw qx qy qz
  Row& poseWxyz(const SE3d& pose) {
    const Vec<double, 4>& q = pose.rotation().quaternion();
    return vector(pose.translation()).number(q[3]).number(q[0]).number(q[1]).number(q[2]);
  }
  const std::string& str() const noexcept { return text_; }

 private:
  std::string separator_;
  std::string text_;
};

}  // namespace exporting
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_EXPORT_ROW_H
