// What a sensor makes of a picture: motion blur, exposure, noise, whole numbers.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_SENSOR_IMAGE_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_SENSOR_IMAGE_H

#include <gslam/core/frame.h>
#include <gslam/core/image.h>

#include <cstdint>

#include "render.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// Something dark before the lens: a disc, pixels.
struct Occluder {
  float u = 0, v = 0, radius = 0;  ///< no radius: there is none
};

struct Exposure {
  float seconds = 0;  ///< over which moving pixels are smeared
  float gain = 1;
  float contrast = 1;  ///< 0: everything is grey
  float vignette = 0;  ///< part of the brightness that the corners lack
  float noise = 0;     ///< standard deviation, grey levels
  Occluder occluder;
  std::uint64_t key = 0;  ///< of the noise
  unsigned threads = 0;
};

/// @param kind  grey, rgb or bgr; the picture must have colour for the last two
Image photograph(const Picture& picture, ImageKind kind, const Exposure& exposure);

struct DepthSensor {
  bool is_float = false;  ///< f32, metres; else u16
  double unit = 0.001;    ///< metres, of u16
  float farthest = 0;     ///< metres; 0: as far as the numbers go
  float noise = 0;        ///< standard deviation at 1 m, grows with the square of the distance
  Occluder occluder;
  std::uint64_t key = 0;
  unsigned threads = 0;
};

/// Depth along the optical axis; 0 where there is none: the sky, what is beside or behind the
/// camera, what is too far.
Image measureDepth(const Picture& picture, const Rays& rays, const DepthSensor& sensor);

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_SENSOR_IMAGE_H
