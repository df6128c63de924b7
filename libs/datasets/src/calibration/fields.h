// Values of YAML, JSON and XML by the path to them, with errors that name it.
#ifndef GSLAM_DATASETS_SRC_CALIBRATION_FIELDS_H
#define GSLAM_DATASETS_SRC_CALIBRATION_FIELDS_H

#include <gslam/geometry/se3.h>
#include <gslam/svar/svar.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace calibration {

/// A value in a file. Names with points, such as ORB-SLAM's "Camera.fx", are names as others are.
/// Everything throws ParseError with the name of the file and the path of the value.
class Fields {
 public:
  /// The root.
  Fields(Svar value, std::string source) : value_(std::move(value)), source_(std::move(source)) {}

  bool isObject() const noexcept { return value_.type() == SvarType::object; }
  bool isArray() const noexcept { return value_.type() == SvarType::array; }
  bool isText() const noexcept { return value_.type() == SvarType::string; }
  /// Whether this is an object that has the member, and it is not null.
  bool has(const std::string& name) const { return find(name) != nullptr; }
  /// A member.
  Fields operator[](const std::string& name) const;
  Fields operator[](const char* name) const { return (*this)[std::string(name)]; }
  /// A member that has members; where there is none, those whose names begin with it and a point:
  /// `fx` is "Camera.fx" then.
  Fields section(const std::string& name) const;
  /// The first of these members that there is.
  Fields anyOf(const std::vector<std::string>& names) const;
  bool hasAnyOf(const std::vector<std::string>& names) const;
  /// Names of the members.
  std::vector<std::string> names() const;

  /// Elements of an array.
  std::size_t size() const;
  Fields at(std::size_t i) const;

  double number() const;
  /// Of a member that may be missing.
  double number(const std::string& name, double fallback) const;
  std::string text() const;
  /// A size in pixels, 1 or more.
  int pixels() const;
  /// Finite numbers: an array, an array of rows, one row by row, or what OpenCV and ROS make of
  /// it, an object with `data`. One number is an array of it.
  std::vector<double> numbers() const;
  /// That many of them.
  std::vector<double> numbers(std::size_t count) const;
  /// A matrix of 4 x 4 or 3 x 4, row by row, whose rotation is one.
  SE3d pose() const;
  /// A rotation matrix.
  SO3d rotation() const;

  const std::string& path() const noexcept { return path_; }
  const std::string& source() const noexcept { return source_; }
  [[noreturn]] void fail(const std::string& problem) const;
  [[noreturn]] void failMissing(const std::string& name) const;

 private:
  Fields(Svar value, std::string source, std::string path)
      : value_(std::move(value)), source_(std::move(source)), path_(std::move(path)) {}
  const Svar* find(const std::string& name) const;
  std::string place() const;
  void addNumbers(std::vector<double>& all) const;

  Svar value_;
  std::string source_;
  std::string path_;
  std::string prefix_;  // of the names of members: "Camera."
};

}  // namespace calibration
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_CALIBRATION_FIELDS_H
