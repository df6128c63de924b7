// A colour camera and the depth of its pixels, as RGB-D datasets have them.
#ifndef GSLAM_DATASETS_SRC_FORMATS_RGBD_CAMERA_H
#define GSLAM_DATASETS_SRC_FORMATS_RGBD_CAMERA_H

#include <gslam/core/frame.h>
#include <gslam/svar/svar.h>

#include <string>

#include "../reading/decode.h"
#include "../reading/file_tree.h"
#include "../reading/remarks.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// Of a pixel, in a metre, in TUM RGB-D and what is compatible with it.
constexpr double kTumDepthUnits = 5000;

/// The camera of a line `[model] fx fy cx cy ...`; without a model it is pinhole, or radtan where
/// more than four numbers stand there.
/// @param source         what errors call the text
/// @param width, height  of the images
/// @throws ParseError
Camera cameraOfText(const std::string& text, const std::string& source, int width, int height);

/// The camera that the user wants, see overrideCamera(); none where that is not said.
/// @param shape  of the images
Camera wantedCamera(const Svar& parameters, const ImageShape& shape, Remarks& remarks);

/// The depth of a colour camera's pixels. Reads an image of it.
/// @param colour  the camera
/// @param file    one of the depth images
/// @param units   of a pixel, in a metre
/// @throws FileError when it is no depth image of 16 bits
CameraSensor depthOf(const CameraSensor& colour, const FileTree& tree, const std::string& file,
                     double units);

/// Parameter `depth_factor`: units of a pixel in a metre.
/// @throws ArgumentError when it is not positive
double depthFactorOf(const Svar& parameters, double usual);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_RGBD_CAMERA_H
