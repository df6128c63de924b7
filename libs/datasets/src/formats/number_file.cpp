#include "number_file.h"

#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/geometry/nearest_rotation.h>

#include <string>
#include <utility>
#include <vector>

#include "../calibration/formats.h"

namespace gslam {
inline namespace v1 {
namespace reading {

std::vector<double> numbersOf(const std::string& text, const std::string& source, std::size_t count,
                              const char* expected) {
  detail::FieldReader in(text, source, expected);
  std::vector<double> numbers;
  std::size_t line = 0;
  while (in.nextLine()) {
    line = in.line();
    while (!in.isLineEnd()) {
      if (numbers.size() == count) {
        in.fail(in.place(), "the file goes on after " + std::to_string(count) +
                                " numbers, expected " + expected);
      }
      numbers.push_back(in.number("a number"));
    }
  }
  if (numbers.size() == count) return numbers;
  throw ParseError(source, line, 0,
                   "the file has " + std::to_string(numbers.size()) + " numbers, expected " +
                       std::to_string(count) + ": " + expected);
}

std::vector<double> readNumbers(const FileTree& tree, const std::string& file, std::size_t count,
                                const char* expected) {
  return numbersOf(tree.text(file), tree.nameOf(file), count, expected);
}

std::vector<double> intrinsicsOfRows(const std::vector<double>& k, const std::string& source) {
  const bool is_matrix = k.size() >= 9 && k[0] > 0 && k[4] > 0 && k[1] == 0 && k[3] == 0 &&
                         k[6] == 0 && k[7] == 0 && k[8] == 1;
  if (is_matrix) return {k[0], k[4], k[2], k[5]};
  throw ParseError(source, 1, 0,
                   "the first three rows are no K, expected fx 0 cx  0 fy cy  0 0 1, and fx and fy "
                   "above 0");
}

NamedNumbers::NamedNumbers(const FileTree& tree, const std::string& file)
    : source_(tree.nameOf(file)) {
  const std::string text = tree.text(file);
  detail::FieldReader in(text, source_, "a name with a colon, then numbers");
  while (in.nextLine()) {
    const char* const at = in.place();
    std::string name = in.word();
    if (name.empty() || name.back() != ':')
      in.fail(at, detail::quotedText(name) + " has no colon behind it");
    name.pop_back();
    if (name == "calib_time") continue;
    in.skipWord();
    Line line;
    line.number = in.line();
    while (!in.isLineEnd()) line.numbers.push_back(in.number(name.c_str()));
    if (!lines_.emplace(name, std::move(line)).second) in.fail(at, name + " stands here again");
  }
}

void NamedNumbers::fail(const std::string& name, const std::string& problem) const {
  const auto found = lines_.find(name);
  const std::size_t line = found == lines_.end() ? 0 : found->second.number;
  throw ParseError(source_, line, 0, name + " " + problem);
}

Camera NamedNumbers::camera(const std::string& name, const std::string& model, int width,
                            int height, const std::vector<double>& parameters) const {
  const auto found = lines_.find(name);
  const std::size_t line = found == lines_.end() ? 0 : found->second.number;
  return calibration::makeCamera(source_, line, model, {width, height}, parameters);
}

const std::vector<double>& NamedNumbers::get(const std::string& name, std::size_t count) const {
  const auto found = lines_.find(name);
  const std::string expected =
      "expected '" + name + ": ' and " + std::to_string(count) + " numbers";
  if (found == lines_.end()) fail(name, "is missing, " + expected);
  const std::size_t size = found->second.numbers.size();
  if (size != count) fail(name, "has " + std::to_string(size) + " numbers, " + expected);
  return found->second.numbers;
}

Mat3d NamedNumbers::matrix(const std::string& name) const {
  const std::vector<double>& numbers = get(name, 9);
  Mat3d m{};
  for (std::size_t i = 0; i < 9; ++i) m.values[i] = numbers[i];
  return m;
}

Vec3d NamedNumbers::vector(const std::string& name) const {
  const std::vector<double>& numbers = get(name, 3);
  return {{numbers[0], numbers[1], numbers[2]}};
}

SO3d NamedNumbers::rotation(const std::string& name) const {
  const NearestRotation<double> nearest = nearestRotation(matrix(name));
  if (!(nearest.distance <= kMatrixTolerance)) fail(name, "is no rotation, expected one");
  return nearest.rotation;
}

bool toProjection(const std::vector<double>& p, Projection& result, std::string& problem) {
  const bool is_projection = p.size() == 12 && p[0] > 0 && p[5] > 0 && p[1] == 0 && p[4] == 0 &&
                             p[8] == 0 && p[9] == 0 && p[10] == 1;
  if (!is_projection) {
    problem = "is no K (I | t), expected fx 0 cx a 0 fy cy b 0 0 1 c";
    return false;
  }
  const double z = p[11];
  const Vec3d offset = {{(p[3] - p[2] * z) / p[0], (p[7] - p[6] * z) / p[5], z}};
  result = {p[0], p[5], p[2], p[6], offset};
  return true;
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
