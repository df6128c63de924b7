#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_VIEW_MAKER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_VIEW_MAKER_H

#include <gslam/core.h>

#include <memory>
#include <string>

#include "options.h"
#include "scene/view.h"

namespace visual {

/// Frames in, features out: chooses the images that the sensor needs, makes them grey and, of a
/// pair, rectified, finds features and their depth.
class ViewMaker {
 public:
  virtual ~ViewMaker() = default;

  /// The camera that features refer to, for as long as the maker lives.
  virtual const Eye& eye() const noexcept = 0;
  /// What was found in a frame; null where the images that are needed are not there, or of another
  /// size or type than they were: then `problem` says what is wrong. A frame without texture is no
  /// problem: it has no features.
  virtual std::shared_ptr<const View> make(const gslam::Frame& frame, std::string& problem) = 0;
};

/// The one for the sensors of a dataset.
/// @throws ArgumentError that names what `sensor` needs and the dataset lacks
std::unique_ptr<ViewMaker> makeViewMaker(const gslam::SensorRig& rig, const Options& options);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_VIEW_MAKER_H
