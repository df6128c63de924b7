// calib_results.txt of the OCamCalib toolbox.
//
// Its five lines: D. Scaramuzza, OCamCalib Toolbox for Matlab, C code "ocam_functions.c",
// get_ocam_model(). Its x is the row, its y the column; ocam.h has ours.
#include "formats.h"
#include "lines.h"

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

constexpr int kMostCoefficients = 5;  // that OcamCamera has
constexpr int kMostInverse = 100;

// A count and as many numbers, in one line.
std::vector<double> polynomial(FieldReader& reader, const char* what, int most) {
  needLine(reader, what);
  const int count = wholeNumber(reader, "the number of coefficients", 1, most);
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(reader.number("a coefficient"));
  reader.endLine();
  return values;
}

}  // namespace

// A line of a count and as many numbers, of which the first is negative.
bool isOcamcalib(const Document& document) {
  FieldReader reader(document.text, document.source, "a polynomial");
  if (!reader.nextLine()) return false;
  std::vector<double> numbers;
  try {
    numbers = restOfLine(reader, "a coefficient");
  } catch (const ParseError&) {
    return false;
  }
  return numbers.size() > 2 && numbers[0] == double(numbers.size() - 1) && numbers[1] < 0;
}

Calibration parseOcamcalib(const Document& document) {
  FieldReader reader(document.text, document.source,
                     "the five lines of OCamCalib: a count and the direct polynomial, a count and "
                     "the inverse one, centre (row, column), c d e, height and width");
  std::vector<double> direct =
      polynomial(reader, "a count and the direct polynomial", kMostCoefficients);
  polynomial(reader, "a count and the inverse polynomial", kMostInverse);
  needLine(reader, "row and column of the centre");
  const double row = reader.number("the row of the centre");
  const double column = reader.number("the column of the centre");
  reader.endLine();
  needLine(reader, "c d e");
  const double c = reader.number("c"), d = reader.number("d"), e = reader.number("e");
  reader.endLine();
  needLine(reader, "height and width");
  const std::size_t line = reader.line();
  const int height = wholeNumber(reader, "the height", 1, kMostPixels);
  const int width = wholeNumber(reader, "the width", 1, kMostPixels);
  reader.endLine();
  direct.resize(kMostCoefficients);
  Calibration result;
  const Camera camera = makeCamera(document.source, line, "ocam", {width, height},
                                   joined({column, row, c, d, e}, direct));
  result.rig.cameras.push_back(makeSensor("camera", camera));
  result.body = "the camera";
  return result;
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
