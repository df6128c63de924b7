#ifndef GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_FEATURE_PICTURE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_FEATURE_PICTURE_H

#include <gslam/core.h>

#include "scene/eye.h"
#include "scene/view.h"
#include "tracking/tracker.h"

namespace visual {

/// The image of a frame with what was found in it: green discs are features that see points of the
/// map, grey rings the others. Drawn into the photograph nearest to the eye, also where features
/// were found in a rectified one.
///
/// @return of kind rgb, 8 bits; no pixels where the frame has no photograph
gslam::CameraImage drawFeatures(const gslam::Frame& frame, const View& view, const Eye& eye,
                                const Tracked& tracked);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_FEATURE_PICTURE_H
