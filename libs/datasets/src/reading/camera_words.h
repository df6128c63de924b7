// A camera as users write it in one line.
#ifndef GSLAM_DATASETS_SRC_READING_CAMERA_WORDS_H
#define GSLAM_DATASETS_SRC_READING_CAMERA_WORDS_H

#include <gslam/geometry/camera.h>

#include <string>

namespace gslam {
inline namespace v1 {
namespace reading {

/// The camera of "pinhole 640x480 525 525 319.5 239.5": model, size, parameters in their order.
/// What `gslam info` prints is read as well: "pinhole 640 x 480 fx 525 fy 525 cx 319.5 cy 239.5".
/// @throws ArgumentError that names the parameter "camera"
Camera cameraOfWords(const std::string& words);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_CAMERA_WORDS_H
