// Camera models in the words of the files of public datasets.
#ifndef GSLAM_DATASETS_SRC_EXPORT_CAMERA_TEXT_H
#define GSLAM_DATASETS_SRC_EXPORT_CAMERA_TEXT_H

#include <gslam/geometry/camera.h>

#include <cstddef>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace exporting {

/// A pinhole and the distortion over it, as Kalibr and EuRoC have it.
struct PinholeText {
  std::vector<double> intrinsics;  ///< fx fy cx cy
  std::string distortion;          ///< "none", "radtan" or "equidistant"
  std::vector<double> coefficients;
};

/// False for a camera that is none of these. Coefficients of radtan that are 0 are left out at the
/// end, but for the first four; those of "none" are none.
bool describePinhole(const Camera& camera, PinholeText& text);

/// Numbers with a separator between each two.
std::string joined(const std::vector<double>& values, const char* separator);

/// camera.txt of TUM's mono and visual-inertial datasets, as DSO reads it: parameters relative to
/// the size of the image, whose first pixel goes from 0 to 1 there, and the same size for what is
/// undistorted. Empty for a camera that it has no words for.
std::string dsoCameraText(const Camera& camera);

/// The models that dsoCameraText() has words for.
const char* dsoCameraModels();

}  // namespace exporting
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_EXPORT_CAMERA_TEXT_H
