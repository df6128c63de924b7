// The files that `eval` compares.
#ifndef GSLAM_APPS_TRAJECTORY_INPUT_H
#define GSLAM_APPS_TRAJECTORY_INPUT_H

#include <gslam/core/trajectory.h>
#include <gslam/svar/svar.h>

#include <cstddef>
#include <string>
#include <vector>

#include "options.h"

namespace app {

/// One of the two trajectories, as it was read.
struct Input {
  std::string path, format;
  std::string topic;  ///< of a ROS recording; else empty
  gslam::Trajectory trajectory;
  std::size_t repeated = 0;          ///< poses whose stamp an earlier one has
  std::vector<std::string> remarks;  ///< sentences about what was skipped
};

/// Declares --ref, --est and what belongs to them.
void declareInputs(Options& options);

/// Reads a trajectory, a map file, or poses of a ROS recording; finds out which it is.
/// @param which  "ref" or "est"
Input readInput(const Options& options, const std::string& which);

/// Whether its stamps are numbers of frames.
bool isNumbered(const Input& input, const Options& options);

/// For people, on stdout.
void printInput(const char* name, const Input& input);
/// For machines.
gslam::Svar describe(const Input& input);

/// All of a file. @throws FileError
std::string contentOf(const std::string& path);
/// Whether that is a map file.
bool isMap(const std::string& content);

}  // namespace app

#endif  // GSLAM_APPS_TRAJECTORY_INPUT_H
