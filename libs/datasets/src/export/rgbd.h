// One camera and depth of the same camera, as TUM RGB-D and ICL-NUIM have them.
#ifndef GSLAM_DATASETS_SRC_EXPORT_RGBD_H
#define GSLAM_DATASETS_SRC_EXPORT_RGBD_H

#include <gslam/base/error.h>

#include <string>

#include "pixels.h"
#include "source.h"

namespace gslam {
inline namespace v1 {
namespace exporting {

constexpr double kDepthUnits = 5000;  // of a pixel, in a metre

/// Images of a frame, in memory.
struct RgbdImages {
  Bytes colour;
  Bytes depth;  ///< empty: there is none
};

/// @throws ArgumentError when the depth is not that of the camera
inline void checkRegistered(const Source& source) {
  const CameraSensor* const depth = source.depth();
  if (depth == nullptr) return;
  const CameraSensor& camera = source.camera(0);
  const bool is_same_model =
      !depth->camera.isValid() || !camera.camera.isValid() || depth->camera == camera.camera;
  if (is_same_model && depth->T_body_camera.isApprox(camera.T_body_camera, 1e-9)) return;
  throw ArgumentError("camera '" + depth->name + "'",
                      "measures depth from elsewhere, or with another model, than camera '" +
                          camera.name + "', but in " + source.format() +
                          " both have the same pixels");
}

inline RgbdImages rgbdImages(Source& source, const Frame& frame) {
  const CameraImage* const colour = source.image(frame, 0);
  if (colour == nullptr) throw Error("there is no image of camera '" + source.camera(0).name + "'");
  RgbdImages images;
  images.colour = colourPng(*colour, source.camera(0), source.notes);
  const CameraImage* const depth = source.depthImage(frame);
  if (depth != nullptr) images.depth = depthPng(*depth, *source.depth(), kDepthUnits, source.notes);
  return images;
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_EXPORT_RGBD_H
