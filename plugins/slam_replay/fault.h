#ifndef GSLAM_PLUGINS_SLAM_REPLAY_FAULT_H
#define GSLAM_PLUGINS_SLAM_REPLAY_FAULT_H

#include <cstdint>

#include "options.h"

namespace replay {

/// Status of the fault "exit".
constexpr int kExitStatus = 7;

/// Fails as the environment variable GSLAM_REPLAY_FAULT says, which has the names of `fault`: the
/// constructor knows no parameters.
void failInConstructor();

/// Fails as asked for, if this is the call, and the frame has come. Does not return then.
/// @param frame  id of the frame; of configure() and finish() any
void failIfAsked(const FaultOptions& fault, FaultOptions::Call call, std::uint64_t frame = 0);

}  // namespace replay

#endif  // GSLAM_PLUGINS_SLAM_REPLAY_FAULT_H
