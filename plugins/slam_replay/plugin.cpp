#include <gslam/core/plugin.h>

#include "replay.h"

GSLAM_PLUGIN(slam_replay, "1.0.0", "A SLAM system with known errors, cost and faults") {
  registry.add(replay::replayFactory());
}
