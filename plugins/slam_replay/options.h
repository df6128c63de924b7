#ifndef GSLAM_PLUGINS_SLAM_REPLAY_OPTIONS_H
#define GSLAM_PLUGINS_SLAM_REPLAY_OPTIONS_H

#include <gslam/core.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "losses.h"

namespace replay {

/// Which poses, and what is wrong with them.
struct PoseOptions {
  std::string file;            ///< with the trajectory
  std::int64_t max_gap = 0;    ///< widest gap between two poses that is filled, ns; 0: any
  double noise_m = 0;          ///< standard deviation of each coordinate
  double noise_rad = 0;        ///< standard deviation about each axis
  std::uint64_t seed = 0;      ///< of the noise
  double scale = 1;            ///< of all lengths
  double drift = 0;            ///< of the way, 0.01: a metre in 100
  double drift_rad_per_m = 0;  ///< of the heading, about z of the world
};

/// What each frame costs.
struct CostOptions {
  std::size_t allocations = 0;       ///< blocks
  std::size_t allocation_bytes = 0;  ///< of each
  std::chrono::nanoseconds cpu{0};   ///< of each thread
  std::size_t cpu_threads = 1;       ///< that burn it at the same time
  std::size_t grow_bytes = 0;        ///< that are touched and kept
};

/// How it fails on purpose.
struct FaultOptions {
  enum class Kind { none, signal, abort, exit, exception, hang };
  enum class Call { configure, feed, finish };
  Kind kind = Kind::none;
  Call call = Call::feed;
  std::uint64_t frame = 0;  ///< at the first frame of this id or a later one
};

/// The kind of fault with that name.
/// @param parameter  what has that name as its value
/// @throws ArgumentError
FaultOptions::Kind faultCalled(const char* parameter, const std::string& name);

/// All parameters of the system, in the units of the program.
struct Options {
  PoseOptions poses;
  CostOptions cost;
  FaultOptions fault;
  Losses losses;
  std::uint64_t start_after = 0;        ///< frames before the first pose
  std::chrono::nanoseconds delay{0};    ///< of feed()
  std::chrono::nanoseconds latency{0};  ///< of the answer, behind feed()
  std::uint64_t strays = 0;             ///< poses a frame of frames that there are not
  std::int64_t stamp_error = 0;         ///< of the poses' stamps, nanoseconds
  std::uint64_t keyframe_every = 0;     ///< frames; 0: no map
  bool is_corrected = false;            ///< whether poses are published again without noise
};

/// What the user may set, with what holds unless he does.
gslam::Svar defaultParameters();
/// What each of them means.
gslam::Svar parameterHelp();

/// @throws ArgumentError that names the parameter, what is wrong and what is expected
Options readOptions(const gslam::Svar& parameters);

}  // namespace replay

#endif  // GSLAM_PLUGINS_SLAM_REPLAY_OPTIONS_H
