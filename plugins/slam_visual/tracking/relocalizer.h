#ifndef GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_RELOCALIZER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_RELOCALIZER_H

#include <gslam/core.h>

#include <vector>

#include "loops/place_index.h"
#include "matching/pose_fitter.h"
#include "options.h"

namespace visual {

/// Finds where a view was taken, of which nothing is known but the map.
class Relocalizer {
 public:
  Relocalizer(const Options& options, const PlaceIndex& places);

  /// Where the camera should be, if it went on as it did.
  struct Guess {
    gslam::KeyframeId reference;  ///< that saw most of what it saw last
    gslam::SE3d T_world_body;
    double within;  ///< lengths
  };

  /// @param guess         null: none. Near to it fewer matches are enough, of what was seen last
  /// @param matches       result: features that see points
  /// @param T_world_body  result
  /// @return whether it was found: by enough matches that chance cannot explain
  bool locate(const View& view, const Scene& scene, const Guess* guess, std::vector<Match>& matches,
              gslam::SE3d& T_world_body);

 private:
  bool locateNear(const View& view, const Scene& scene, const Guess& guess,
                  std::vector<Match>& matches, gslam::SE3d& T_world_body);
  bool locateAt(const View& view, const Scene& scene, gslam::KeyframeId keyframe,
                std::vector<Match>& matches, gslam::SE3d& T_world_body);

  Options options_;
  const PlaceIndex& places_;
  ProjectionMatcher projector_;
  PoseFitter fitter_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_TRACKING_RELOCALIZER_H
