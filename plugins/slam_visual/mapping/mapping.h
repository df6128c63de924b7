#ifndef GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_MAPPING_H
#define GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_MAPPING_H

#include <gslam/core.h>

#include <memory>
#include <optional>

#include "loops/loop_closer.h"
#include "loops/loop_detector.h"
#include "loops/place_index.h"
#include "mapping/adjusted_scene.h"
#include "mapping/local_mapper.h"
#include "options.h"
#include "scene/world.h"
#include "tracking/initializer.h"

namespace visual {

/// The world and those who change it, for one thread: from a keyframe that is due to the map with
/// its loops closed. Sequential and threaded systems call the same functions.
class Mapping {
 public:
  Mapping(const Options& options, const Eye& eye, PlaceIndex& places);

  const Scene& scene() const noexcept { return world_.scene(); }
  bool hasBegun() const noexcept { return world_.keyframesAdded() > 0; }

  /// @return whether there is a map now
  bool begin(const std::shared_ptr<const View>& view, std::string& reason);
  /// Begins anew with an empty world.
  void reset();
  /// Adds a keyframe, so that the camera can be followed by it.
  gslam::KeyframeId add(const KeyframeRequest& request);
  /// Improves the map around it.
  /// @param is_hurried  more keyframes wait
  void improve(gslam::KeyframeId id, bool is_hurried);
  void close(const Loop& loop);
  void apply(const AdjustedScene& adjusted);

 private:
  Options options_;
  PlaceIndex& places_;
  World world_;
  Initializer initializer_;
  LocalMapper mapper_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_MAPPING_MAPPING_H
