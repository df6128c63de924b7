#ifndef GSLAM_PLUGINS_SLAM_VISUAL_PIPELINE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_PIPELINE_H

#include <gslam/core.h>

#include <functional>
#include <memory>
#include <string>

#include "options.h"
#include "scene/frame_log.h"
#include "scene/view.h"

namespace visual {

/// From views to poses and a map: the same algorithm one step after the other, or in threads.
class Pipeline {
 public:
  virtual ~Pipeline() = default;

  /// What became of the next view. A null one could not be seen: the camera is lost.
  virtual Tracked step(const std::shared_ptr<const View>& view) = 0;
  /// Ends what is in work. No step comes after it.
  virtual void finish() = 0;
  /// The scene as it is now.
  virtual std::shared_ptr<const Scene> scene() = 0;
  /// Whether what was tracked before this step means nothing any more: the world began anew.
  virtual bool hasRestarted() = 0;
};

/// Everything in the thread that calls: each frame is done when step() returns, and the same frames
/// give the same bits.
std::unique_ptr<Pipeline> makeSequentialPipeline(const Options& options, const Eye& eye);
/// step() only follows the camera; the map grows in a second thread, and loops are searched in a
/// third one.
std::unique_ptr<Pipeline> makeThreadedPipeline(const Options& options, const Eye& eye);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_PIPELINE_H
