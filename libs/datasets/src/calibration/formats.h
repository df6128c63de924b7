// The readers of each format, and what they have in common.
#ifndef GSLAM_DATASETS_SRC_CALIBRATION_FORMATS_H
#define GSLAM_DATASETS_SRC_CALIBRATION_FORMATS_H

#include <gslam/datasets/calibration_file.h>
#include <gslam/geometry/camera.h>

#include <string>
#include <vector>

#include "fields.h"

namespace gslam {
inline namespace v1 {
namespace calibration {

/// A file that was taken apart, as far as its syntax goes.
struct Document {
  std::string text;
  std::string source;  ///< name of the file
  bool is_lines;       ///< lines of words and numbers; else `root` has the values
  Fields root;
  CalibrationOptions options;
};

/// @{
/// One format: whether a document has it, and the calibration.
bool isKalibr(const Document& document);
Calibration parseKalibr(const Document& document);
bool isOpenCv(const Document& document);
Calibration parseOpenCv(const Document& document);
bool isOcamcalib(const Document& document);
Calibration parseOcamcalib(const Document& document);
bool isBasalt(const Document& document);
Calibration parseBasalt(const Document& document);
bool isOrbslam(const Document& document);
Calibration parseOrbslam(const Document& document);
bool isColmap(const Document& document);
Calibration parseColmap(const Document& document);
bool isEuroc(const Document& document);
Calibration parseEuroc(const Document& document);
bool isDso(const Document& document);
Calibration parseDso(const Document& document);
bool isStella(const Document& document);
Calibration parseStella(const Document& document);
bool isSvo(const Document& document);
Calibration parseSvo(const Document& document);
/// @}

/// Size of an image.
struct ImageSize {
  int width = 0;
  int height = 0;
};

/// The size in the options. @throws ParseError that says what the file lacks
ImageSize sizeOfOptions(const Document& document);
/// Two numbers: width, height.
ImageSize sizeOf(const Fields& pair);

/// Camera::fromParameters() with errors that name the place.
Camera makeCamera(const Fields& where, const std::string& model, ImageSize size,
                  const std::vector<double>& parameters);
/// The same for a line of text.
Camera makeCamera(const std::string& source, std::size_t line, const std::string& model,
                  ImageSize size, const std::vector<double>& parameters);

/// A camera with its place. Cameras are named after their file's words.
CameraSensor makeSensor(const std::string& name, const Camera& camera,
                        const SE3d& T_body_camera = SE3d(), double rate = 0);

/// The camera of a pinhole and distortion over it, in Kalibr's and ASL's words: radtan (also
/// radial-tangential, plumb_bob), equidistant (also fisheye), fov, none.
/// radtan without any distortion is a pinhole.
/// @param intrinsics  fx fy cx cy
Camera distortedPinhole(const Fields& where, const std::string& distortion, ImageSize size,
                        const std::vector<double>& intrinsics,
                        const std::vector<double>& coefficients);

/// radtan with OpenCV's numbers of coefficients; a pinhole where none is other than 0.
Camera radtanOrPinhole(const Fields& where, ImageSize size, const std::vector<double>& intrinsics,
                       const std::vector<double>& coefficients);
/// The same for a line of text, whose numbers begin with fx fy cx cy.
Camera radtanOrPinhole(const std::string& source, std::size_t line, ImageSize size,
                       const std::vector<double>& parameters);

/// Where the right camera is in the left one's coordinates, of a pair that a program rectifies.
/// @param baseline  metres
SE3d placeOfRight(const SO3d& R_rectified_left, const SO3d& R_rectified_right, double baseline);

/// fx fy cx cy of a camera matrix without skew.
std::vector<double> intrinsicsOfMatrix(const Fields& matrix);

/// Numbers that members of an object are, in this order.
std::vector<double> membersOf(const Fields& object, const std::vector<std::string>& names);

/// The density of a noise, 0 or more. Of one for each axis the largest counts, which is said.
double noiseOf(const Fields& density, Calibration& result);

/// A camera for depth that looks as another does.
/// @param factor  what metres are multiplied by in the images
CameraSensor depthOf(const CameraSensor& colour, const Fields& factor);

/// a and after it b.
std::vector<double> joined(std::vector<double> a, const std::vector<double>& b);

/// Seconds to nanoseconds. @throws ParseError when they are more than 64 bits hold
std::int64_t nanosecondsOf(const Fields& seconds);

}  // namespace calibration
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_CALIBRATION_FORMATS_H
