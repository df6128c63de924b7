#ifndef GSLAM_CORE_FRAME_H
#define GSLAM_CORE_FRAME_H

#include <gslam/core/image.h>
#include <gslam/core/sensor.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/pose_with_covariance.h>
#include <gslam/geometry/se3.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// What all sensors saw at one time.

namespace gslam {
inline namespace v1 {

/// What the pixels of an image mean.
enum class ImageKind : std::uint8_t {
  grey,       ///< brightness, 1 channel
  rgb,        ///< red, green, blue
  bgr,        ///< blue, green, red: OpenCV's order
  rgba,       ///< red, green, blue, opacity
  bgra,       ///< blue, green, red, opacity
  bayer,      ///< raw colour filter, 1 channel
  depth,      ///< distance along the optical axis, 1 channel; see CameraImage::depth_scale
  disparity,  ///< pixels from the left to the right image, 1 channel
  infrared,   ///< brightness outside of the visible, 1 channel
  mask,       ///< 0: not to be used
  label       ///< number of a class or object
};

namespace detail {
constexpr std::uint8_t kImageKinds = 11;  // number of them
}

/// Its name, such as "grey"; "unknown" for a number that is no kind.
inline const char* imageKindName(ImageKind kind) noexcept {
  static const char* const kNames[] = {"grey",  "rgb",       "bgr",      "rgba", "bgra", "bayer",
                                       "depth", "disparity", "infrared", "mask", "label"};
  const std::size_t i = static_cast<std::size_t>(kind);
  return i < sizeof(kNames) / sizeof(kNames[0]) ? kNames[i] : "unknown";
}

/// A camera of a rig, without an image.
struct CameraSensor {
  std::string name;                  ///< such as "left"
  ImageKind kind = ImageKind::grey;  ///< of its images
  Camera camera;                     ///< the model; none where it is not known
  SE3d T_body_camera;                ///< takes camera to body coordinates
  double rate = 0;                   ///< images a second; 0: unknown
  double depth_scale = 0;            ///< of depth images, see CameraImage::depth_scale
};

/// An image and the camera that took it.
struct CameraImage {
  Image image;                ///< pixels
  Camera camera;              ///< the model; none where it is not known
  SE3d T_body_camera;         ///< takes camera to body coordinates
  std::int64_t exposure = 0;  ///< nanoseconds; 0: unknown
  double depth_scale = 0;     ///< depth images: metres are pixel * depth_scale; 0 is no depth
  ImageKind kind = ImageKind::grey;  ///< what the pixels mean
  std::string name;                  ///< of the camera, such as "left"
};

/// What all sensors saw at one time: the images, and what the other sensors measured since the
/// frame before.
///
/// Plain data. Once published as `std::shared_ptr<const Frame>` nobody changes it, or the pixels of
/// its images, and threads share it without a copy.
struct Frame {
  std::uint64_t id = 0;             ///< counts up by one through a dataset
  std::int64_t stamp = 0;           ///< nanoseconds: the middle of the exposure where it is known
  std::vector<CameraImage> images;  ///< in the order of SensorRig::cameras
  std::vector<ImuSample> imu;       ///< after the frame before, up to this stamp, by stamp
  ImuCalibration imu_calibration;   ///< where `imu` was measured
  std::vector<GnssSample> gnss;     ///< after the frame before, up to this stamp, by stamp
  bool has_prior = false;           ///< whether `prior` means anything
  PoseWithCovariance<SE3d> prior;   ///< T_world_body as another source has it, such as odometry
};

/// The first image of a kind; null where there is none. It lives as long as the frame.
inline const CameraImage* findImage(const Frame& frame, ImageKind kind) noexcept {
  for (const CameraImage& image : frame.images) {
    if (image.kind == kind) return &image;
  }
  return nullptr;
}

/// The image of a camera of that name; null where there is none. It lives as long as the frame.
inline const CameraImage* findImage(const Frame& frame, const std::string& name) noexcept {
  for (const CameraImage& image : frame.images) {
    if (image.name == name) return &image;
  }
  return nullptr;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_FRAME_H
