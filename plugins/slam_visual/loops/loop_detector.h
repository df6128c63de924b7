#ifndef GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_DETECTOR_H
#define GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_DETECTOR_H

#include <gslam/core.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "loops/place_index.h"
#include "matching/pose_fitter.h"
#include "options.h"

namespace visual {

/// A place that was seen before, though the map does not know it yet.
struct Loop {
  gslam::KeyframeId here;      ///< the keyframe that sees it now
  gslam::KeyframeId there;     ///< the one that saw it
  gslam::SIM3d S_there_here;   ///< takes coordinates of body `here` to those of body `there`; the
                               ///< scale is 1 where the sensor measures depth
  std::vector<Match> matches;  ///< features of `here` that see points of the old place
};

/// Says which keyframes close a loop. One thread calls it; it only reads the scene.
class LoopDetector {
 public:
  LoopDetector(const Options& options, const PlaceIndex& places);

  /// @param keyframe  the newest one, already in the index
  /// @return the loop that it closes, if it is consistent with the keyframes before and its
  ///   geometry is confirmed by matches
  std::optional<Loop> detect(const Scene& scene, gslam::KeyframeId keyframe);

  /// What was found so far does not count any more: a loop was closed, or keyframes are gone.
  void reset();

 private:
  /// A place that the last keyframes looked like, and how many of them in a row.
  struct Trail {
    std::vector<gslam::KeyframeId> group;
    int length = 0;
  };
  std::vector<gslam::KeyframeId> candidates(const Scene& scene, gslam::KeyframeId keyframe) const;
  std::vector<gslam::KeyframeId> consistent(const Scene& scene,
                                            const std::vector<gslam::KeyframeId>& candidates);
  std::optional<Loop> confirm(const Scene& scene, gslam::KeyframeId here, gslam::KeyframeId there);

  Options options_;
  const PlaceIndex& places_;
  std::vector<Trail> trails_;
  std::uint32_t closed_at_ = 0;  // number of the keyframe that closed the last loop
  ProjectionMatcher projector_;
  PoseFitter fitter_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_DETECTOR_H
