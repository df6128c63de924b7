// Images of any kind as the PNG files that layouts have.
#ifndef GSLAM_DATASETS_SRC_EXPORT_PIXELS_H
#define GSLAM_DATASETS_SRC_EXPORT_PIXELS_H

#include <gslam/core/frame.h>

#include <cstddef>

#include "export_folder.h"
#include "source.h"

namespace gslam {
inline namespace v1 {
namespace exporting {

/// @{
/// The image as a PNG: of 8-bit grey, 16-bit grey, 8-bit red green blue.
/// @throws ArgumentError when its kind or type is none that this can be made of, or its size is not
///   the camera's
Bytes greyPng(const CameraImage& image, const CameraSensor& camera, Notes& notes);
Bytes grey16Png(const CameraImage& image, const CameraSensor& camera, Notes& notes);
Bytes colourPng(const CameraImage& image, const CameraSensor& camera, Notes& notes);
/// @}

/// Depth as a 16-bit PNG; 0 is no depth. What does not fit is no depth, and counted.
/// @param units  of a pixel that make a metre
/// @throws ArgumentError as above, or when the scale of the image is not known
Bytes depthPng(const CameraImage& image, const CameraSensor& camera, double units, Notes& notes);

/// A 16-bit grey PNG of one brightness, for vignettes.
Bytes whitePng(int width, int height);

}  // namespace exporting
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_EXPORT_PIXELS_H
