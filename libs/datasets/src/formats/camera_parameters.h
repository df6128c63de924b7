// The parameters by which a user says what the camera is.
#ifndef GSLAM_DATASETS_SRC_FORMATS_CAMERA_PARAMETERS_H
#define GSLAM_DATASETS_SRC_FORMATS_CAMERA_PARAMETERS_H

#include <gslam/core/frame.h>
#include <gslam/svar/svar.h>

#include <functional>
#include <string>

#include "../reading/decode.h"
#include "../reading/remarks.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// `camera`: one line, see cameraOfWords(); `calibration`: a file that readCalibration() reads, of
/// which the first camera is taken. Both are empty by default.
void addCameraParameters(Svar& parameters);

/// Gives a camera the model that the user wants.
/// @param remarks  what there is to say of the calibration
/// @param shape    of the images, for files that do not say their size; asked for `calibration`
/// only
/// @return whether the user wants one
/// @throws ArgumentError when both are given, and what reading them throws
bool overrideCamera(const Svar& parameters, CameraSensor& sensor, Remarks& remarks,
                    const std::function<ImageShape()>& shape);

/// A camera of a calibration file's text, see parseCalibration().
/// @param name     what errors call the file
/// @param shape    of the images, for files that do not say their size
/// @param index    which of its cameras
/// @param remarks  what there is to say of it
CameraSensor cameraOfFile(const std::string& text, const std::string& name, int index,
                          const ImageShape& shape, Remarks& remarks);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_CAMERA_PARAMETERS_H
