#ifndef GSLAM_PLUGINS_SLAM_REPLAY_REPLAY_H
#define GSLAM_PLUGINS_SLAM_REPLAY_REPLAY_H

#include <gslam/core.h>

namespace replay {

/// A SLAM system that looks at no image: it answers with the poses of a file. What is wrong with
/// them, what a frame costs and how it fails is said by parameters, so that what measures SLAM
/// systems can be measured itself. The README beside this file lists them.
gslam::SlamFactory replayFactory();

}  // namespace replay

#endif  // GSLAM_PLUGINS_SLAM_REPLAY_REPLAY_H
