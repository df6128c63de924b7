#include "trajectory_input.h"

#include <gslam/base/error.h>
#include <gslam/core/map_file.h>
#include <gslam/core/map_trajectory.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/svar/error.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "recorded_poses.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using gslam::ConfigError;
using gslam::TrajectoryFormat;

const std::vector<std::string> kFormats = {"any", "tum", "kitti", "euroc", "map", "ros"};
const std::vector<std::string> kUnits = {"seconds", "milliseconds", "microseconds", "nanoseconds"};

// Lines that begin with a number: the poses of a file whose stamps may repeat.
std::size_t countPoses(const std::string& content) {
  std::size_t count = 0;
  bool at_begin = true;
  for (const char c : content) {
    if (c == '\n' || c == '\r') {
      at_begin = true;
    } else if (at_begin && c != ' ' && c != '\t' && c != '\xef' && c != '\xbb' && c != '\xbf') {
      at_begin = false;
      const bool is_number = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
      if (is_number) ++count;
    }
  }
  return count;
}

gslam::TrajectoryFileOptions readingOptions(const Options& options, const std::string& which) {
  gslam::TrajectoryFileOptions result;
  const std::string format = options.get<std::string>(which + "-format");
  for (const TrajectoryFormat one :
       {TrajectoryFormat::tum, TrajectoryFormat::kitti, TrajectoryFormat::euroc}) {
    if (format == gslam::trajectoryFormatName(one)) result.format = one;
  }
  for (std::size_t i = 0; i < kUnits.size(); ++i) {
    if (options.get<std::string>(which + "-stamps") != kUnits[i]) continue;
    result.tum_stamps = static_cast<gslam::StampUnit>(3 - i);
  }
  // Public ground truth repeats stamps, too (fr2/desk).
  result.duplicates = gslam::DuplicateStamps::keep_first;
  return result;
}

void readText(const Options& options, const std::string& which, const std::string& content,
              Input& input) {
  gslam::TrajectoryFileOptions how = readingOptions(options, which);
  if (how.format == TrajectoryFormat::any) {
    how.format = gslam::detectTrajectoryFormat(content, input.path);
  }
  input.format = gslam::trajectoryFormatName(how.format);
  const std::string times = options.get<std::string>("times");
  if (how.format == TrajectoryFormat::kitti && !times.empty()) {
    input.trajectory = gslam::readKittiTrajectory(input.path, times);
    return;
  }
  try {
    input.trajectory = gslam::parseTrajectory(content, input.path, how);
  } catch (const gslam::ParseError& error) {
    // The reader knows which unit fits, not how to say it here.
    const bool is_unit = std::string(error.what()).find("nanoseconds") != std::string::npos &&
                         how.format == TrajectoryFormat::tum;
    if (!is_unit) throw;
    throw gslam::Error(error.what() + std::string("; --") + which +
                       "-stamps nanoseconds reads them so");
  }
  const std::size_t poses = countPoses(content);
  input.repeated = poses - std::min(poses, input.trajectory.size());
}

void readRecording(const Options& options, const std::string& which, Input& input) {
  input.format = "ros";
  input.topic = options.get<std::string>(which + "-topic");
  RecordedPoses poses = readRecordedPoses(input.path, input.topic, "--" + which + "-topic");
  input.topic = poses.topic;
  input.trajectory = std::move(poses.trajectory);
  input.remarks = std::move(poses.remarks);
}

}  // namespace

void declareInputs(Options& options) {
  options
      .arg<std::string>("ref", "",
                        "ground truth: a trajectory (TUM, KITTI, EuRoC), a map file, or a ROS "
                        "recording (.bag, .db3, .mcap)")
      .group("Files");
  options.arg<std::string>("est", "", "what is measured, likewise").group("Files");
  for (const char* const which : {"ref", "est"}) {
    const std::string name = which;
    options.arg<std::string>(name + "-format", "any", "format of --" + name + "; any: is found out")
        .choices(kFormats)
        .group("Files");
    options.arg<std::string>(name + "-stamps", "seconds", "what stamps of a TUM file count")
        .choices(kUnits)
        .group("Files");
    options
        .arg<std::string>(name + "-topic", "",
                          "topic of a ROS recording; needed where several have poses")
        .group("Files");
  }
  options.arg<std::string>("times", "", "times of KITTI files' poses, a line each in seconds")
      .group("Files");
}

Input readInput(const Options& options, const std::string& which) {
  Input input;
  input.path = options.get<std::string>(which);
  if (input.path.empty()) throw ConfigError("--" + which, "must be given");
  const std::string format = options.get<std::string>(which + "-format");
  const bool is_ros = format == "ros" || (format == "any" && isRecording(input.path));
  if (is_ros) {
    readRecording(options, which, input);
    return input;
  }
  if (!options.get<std::string>(which + "-topic").empty()) {
    throw ConfigError("--" + which + "-topic", "is for ROS recordings, and " + input.path +
                                                   " does not look like one (.bag, .db3, .mcap)");
  }
  const std::string content = contentOf(input.path);
  if (format == "map" || (format == "any" && isMap(content))) {
    input.format = "map";
    input.trajectory = gslam::keyframeTrajectory(gslam::loadMap(input.path));
    return input;
  }
  readText(options, which, content, input);
  return input;
}

bool isNumbered(const Input& input, const Options& options) {
  return input.format == "kitti" && options.get<std::string>("times").empty();
}

void printInput(const char* name, const Input& input) {
  const std::string head = name;
  std::cout << head << std::string(13 - head.size(), ' ') << input.path << ": " << input.format
            << (input.topic.empty() ? "" : ", topic " + input.topic) << ", "
            << input.trajectory.size() << " poses\n";
  if (input.repeated > 0) {
    std::cout << "             " << input.repeated
              << " more repeat a stamp; the first of each counts\n";
  }
  for (const std::string& remark : input.remarks) {
    std::cout << "             note: " << remark << '\n';
  }
}

gslam::Svar describe(const Input& input) {
  gslam::Svar result = gslam::Svar::object({{"file", input.path},
                                            {"format", input.format},
                                            {"poses", input.trajectory.size()},
                                            {"repeated_stamps", input.repeated}});
  if (!input.topic.empty()) result.set("topic", input.topic);
  if (!input.remarks.empty()) result.set("remarks", input.remarks);
  return result;
}

std::string contentOf(const std::string& path) {
  if (fs::is_directory(path)) throw gslam::FileError(path, "is a folder, expected a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw gslam::FileError(path, "cannot be opened", errno);
  std::ostringstream content;
  content << in.rdbuf();
  if (in.bad()) throw gslam::FileError(path, "cannot be read", errno);
  return std::move(content).str();
}

bool isMap(const std::string& content) {
  return content.compare(0, 8, gslam::detail::kMapMagic) == 0;
}

}  // namespace app
