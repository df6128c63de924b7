#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_VIEW_MAKERS_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_VIEW_MAKERS_H

#include <cstddef>
#include <memory>
#include <string>

#include "features/view_maker.h"

namespace visual {

/// Cameras that are used, by their places in SensorRig::cameras.
struct CameraChoice {
  SensorKind kind = SensorKind::mono;
  std::size_t first = 0;   ///< the camera, or one of a pair
  std::size_t second = 0;  ///< the depth camera, or the other one of the pair
};

/// @{
/// The makers, for cameras that have a model.
/// @throws ArgumentError when they cannot work together
std::unique_ptr<ViewMaker> makeMono(const gslam::SensorRig& rig, const CameraChoice& cameras,
                                    const Options& options);
std::unique_ptr<ViewMaker> makeRgbd(const gslam::SensorRig& rig, const CameraChoice& cameras,
                                    const Options& options);
std::unique_ptr<ViewMaker> makeStereo(const gslam::SensorRig& rig, const CameraChoice& cameras,
                                      const Options& options);
/// @}

/// Pixels a radian in the middle of an image.
/// @throws ArgumentError when the camera does not see what is there
double focalOfEye(const gslam::Camera& camera, const std::string& name);

/// The image of a camera in a frame; null where there is none, then `problem` says so.
const gslam::CameraImage* imageOf(const gslam::Frame& frame, std::size_t camera,
                                  const std::string& name, std::string& problem);

/// A view of features that are done, whose memory it takes.
/// @param camera  that they are of
std::shared_ptr<View> viewOf(const gslam::Frame& frame, gslam::KeyframeContent&& content,
                             std::size_t camera, const Eye& eye);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_VIEW_MAKERS_H
