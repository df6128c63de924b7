// Lines of numbers and words.
#ifndef GSLAM_DATASETS_SRC_CALIBRATION_LINES_H
#define GSLAM_DATASETS_SRC_CALIBRATION_LINES_H

#include <gslam/core/detail/field_reader.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace calibration {

using detail::FieldReader;

/// The next line, which must be there.
inline void needLine(FieldReader& reader, const char* what) {
  if (reader.nextLine()) return;
  reader.fail(reader.place(), std::string("the file ends here, expected ") + what);
}

/// A whole number in a range.
inline int wholeNumber(FieldReader& reader, const char* name, int least, int most) {
  const char* const at = reader.place();
  const double value = reader.number(name);
  if (value >= least && value <= most && value == std::floor(value)) {
    return static_cast<int>(value);
  }
  reader.fail(at, std::string(name) + " is out of range, expected a whole number from " +
                      std::to_string(least) + " to " + std::to_string(most));
}

/// All numbers up to the end of the line.
inline std::vector<double> restOfLine(FieldReader& reader, const char* name) {
  std::vector<double> numbers;
  while (!reader.isLineEnd()) numbers.push_back(reader.number(name));
  return numbers;
}

constexpr int kMostPixels = 1000000;

}  // namespace calibration
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_CALIBRATION_LINES_H
