// Text files of numbers: matrices, and lines that begin with a name.
#ifndef GSLAM_DATASETS_SRC_FORMATS_NUMBER_FILE_H
#define GSLAM_DATASETS_SRC_FORMATS_NUMBER_FILE_H

#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "../reading/file_tree.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// All numbers of a file, whatever lines they stand in.
/// @param count     how many there must be
/// @param expected  what they are, for errors
/// @throws FileError, ParseError with the line
std::vector<double> readNumbers(const FileTree& tree, const std::string& file, std::size_t count,
                                const char* expected);

/// The same of a text that was read already.
std::vector<double> numbersOf(const std::string& text, const std::string& source, std::size_t count,
                              const char* expected);

/// fx, fy, cx, cy of the rows of a camera's matrix, with which a file of numbers begins.
/// @throws ParseError when they are no such matrix
std::vector<double> intrinsicsOfRows(const std::vector<double>& numbers, const std::string& source);

/// Lines of a name, a colon and numbers, as KITTI's calibrations are.
class NamedNumbers {
 public:
  /// @throws FileError when it cannot be read, ParseError where a line has no numbers or a name
  ///   stands twice. `calib_time`, which is a date, is passed over.
  NamedNumbers(const FileTree& tree, const std::string& file);

  bool has(const std::string& name) const { return lines_.count(name) != 0; }
  /// @throws ParseError when the name is missing, or has not so many numbers
  const std::vector<double>& get(const std::string& name, std::size_t count) const;
  /// Nine numbers as the rows of a matrix.
  Mat3d matrix(const std::string& name) const;
  Vec3d vector(const std::string& name) const;
  /// Nine numbers as a rotation. @throws ParseError when they are none
  SO3d rotation(const std::string& name) const;
  /// A camera of what stands behind a name. @throws ParseError when it is none
  Camera camera(const std::string& name, const std::string& model, int width, int height,
                const std::vector<double>& parameters) const;
  /// @throws ParseError about a name
  [[noreturn]] void fail(const std::string& name, const std::string& problem) const;

 private:
  struct Line {
    std::vector<double> numbers;
    std::size_t number = 0;
  };
  std::string source_;
  std::map<std::string, Line> lines_;
};

/// A camera that P = K (I | t) projects into, as rectified ones are described.
struct Projection {
  double fx, fy, cx, cy;
  Vec3d offset;  ///< t: takes points of the reference to points of the camera
};
/// @param numbers  12, the rows of P
/// @param problem  why it is none, where false is returned
bool toProjection(const std::vector<double>& numbers, Projection& result, std::string& problem);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_NUMBER_FILE_H
