#include <gslam/base/error.h>
#include <gslam/core/map_file.h>
#include <gslam/core/map_trajectory.h>
#include <gslam/core/ply.h>
#include <gslam/core/stamp.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/evaluation.h>
#include <gslam/svar/error.h>
#include <gslam/svar/json.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <thread>

#include "command.h"
#include "options.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using gslam::ConfigError;
using gslam::Svar;
using gslam::TrajectoryFormat;

const std::vector<std::string> kFormats = {"any", "tum", "kitti", "euroc", "map"};
const std::vector<std::string> kUnits = {"seconds", "milliseconds", "microseconds", "nanoseconds"};

// One of the two files, as it was read.
struct Input {
  std::string path, format;
  gslam::Trajectory trajectory;
  std::size_t repeated = 0;  // poses whose stamp an earlier one has
};

void declareOptions(Options& options) {
  options
      .arg<std::string>("ref", "", "ground truth: a trajectory (TUM, KITTI, EuRoC) or a map file")
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
  }
  options.arg<std::string>("times", "", "times of KITTI files' poses, a line each in seconds")
      .group("Files");
  options.arg<std::string>("ref-cloud", "", "PLY or map file with the true surface's points")
      .group("Files");
  options.arg<std::string>("cloud", "", "PLY or map file whose points are measured").group("Files");
  options
      .arg<std::string>("association", "one-to-one",
                        "which poses are compared: one-to-one, interpolate or evo")
      .group("Comparison");
  options.arg<std::string>("max-dt", "0.01", "most seconds between the two poses of a pair")
      .group("Comparison");
  options
      .arg<std::string>("time-offset", "0", "seconds to add to stamps of --est, or auto to find it")
      .group("Comparison");
  options
      .arg<std::string>(
          "align", "se3",
          "none, origin, se3, sim3, scale, yaw, or first:N (se3 of the first N pairs)")
      .group("Comparison");
  options
      .arg<double>("lost-after", 0,
                   "seconds without a pose that are a loss; 0: 5 median steps, 0.5 at least")
      .range(0, 1e9)
      .group("Comparison");
  options
      .arg<std::vector<std::string>>(
          "rpe", {},
          "relative errors over 1f (frames), 5m, 2s or 10deg; 10f:all for "
          "all pairs; may be repeated")
      .group("Figures");
  options.arg<bool>("kitti", false, "the figures of KITTI's odometry benchmark").group("Figures");
  options.arg<std::vector<double>>("segments", {}, "errors over parts of these lengths, metres")
      .group("Figures");
  options.arg<int>("icp", 0, "most rounds that refine the alignment of --cloud")
      .range(0, 10000)
      .group("Figures");
}

// Config lets the last of several win; here each adds one.
std::vector<std::string> withOneRpe(const std::vector<std::string>& arguments) {
  std::vector<std::string> rest;
  std::string list;
  const auto add = [&list](const std::string& one) { list += (list.empty() ? "" : ",") + one; };
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--") {
      rest.insert(rest.end(), arguments.begin() + std::ptrdiff_t(i), arguments.end());
      break;
    }
    if (argument == "--rpe" && i + 1 < arguments.size()) {
      add(arguments[++i]);
    } else if (argument.compare(0, 6, "--rpe=") == 0) {
      add(argument.substr(6));
    } else {
      rest.push_back(argument);
    }
  }
  if (!list.empty()) rest.insert(rest.begin(), "--rpe=" + list);
  return rest;
}

// What an option's text means; what is wrong with it is wrong use of the command.
template <class Parse>
auto parsed(const std::string& option, const std::string& text, const Parse& parse) {
  try {
    return parse(text);
  } catch (const gslam::Error& error) {
    throw ConfigError(option, "'" + text + "': " + error.what());
  }
}

std::int64_t nanosecondsOf(const std::string& seconds) {
  return gslam::parseStamp(seconds);
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

bool isBag(const std::string& path, const std::string& content) {
  const std::string ending = fs::path(path).extension();
  return ending == ".bag" || ending == ".db3" || ending == ".mcap" ||
         content.compare(0, 7, "#ROSBAG") == 0;
}

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

Input readInput(const Options& options, const std::string& which) {
  Input input;
  input.path = options.get<std::string>(which);
  if (input.path.empty()) throw ConfigError("--" + which, "must be given");
  const std::string content = contentOf(input.path);
  if (isBag(input.path, content)) {
    throw gslam::FileError(input.path,
                           "is a ROS bag; topics of bags are not read yet, expected a "
                           "file in TUM, KITTI or EuRoC format, or a map file");
  }
  const std::string format = options.get<std::string>(which + "-format");
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

gslam::AssociationOptions associationOf(const Options& options, const Input& reference,
                                        const Input& estimate) {
  gslam::AssociationOptions how;
  how.method =
      parsed("--association", options.get<std::string>("association"), gslam::associationMethod);
  how.max_dt = parsed("--max-dt", options.get<std::string>("max-dt"), nanosecondsOf);
  if (how.max_dt < 0) throw ConfigError("--max-dt", "expected 0 or more");
  const std::string offset = options.get<std::string>("time-offset");
  how.finds_offset = offset == "auto";
  if (!how.finds_offset) how.time_offset = parsed("--time-offset", offset, nanosecondsOf);
  const bool reference_counts = isNumbered(reference, options);
  const bool estimate_counts = isNumbered(estimate, options);
  how.is_numbered = reference_counts && estimate_counts;
  if (reference_counts != estimate_counts) {
    throw ConfigError("--times",
                      "must be given: " + (reference_counts ? reference.path : estimate.path) +
                          " is a KITTI file, which has no times, and the other has some");
  }
  return how;
}

std::string posesUsed(const Input& input) {
  if (input.format == "map") return "final, keyframes";
  const fs::path path = input.path;
  if (!fs::exists(path.parent_path() / "run.json")) return "as in the file";
  if (path.filename() == "trajectory.txt") return "live, all";
  return path.filename() == "trajectory_final.txt" ? "final, all" : "as in the file";
}

Svar describe(const Input& input) {
  return Svar::object({{"file", input.path},
                       {"format", input.format},
                       {"poses", input.trajectory.size()},
                       {"repeated_stamps", input.repeated}});
}

Svar describeMachine() {
  utsname name{};
  Svar machine = Svar::object({{"cores", std::thread::hardware_concurrency()}});
  if (uname(&name) != 0) return machine;
  machine.set("system", std::string(name.sysname) + " " + name.release);
  machine.set("architecture", std::string(name.machine));
  return machine;
}

// Where the estimate lies beside what `gslam run` wrote, that says dataset, SLAM, parameters, seed.
Svar protocolOf(const Input& reference, const Input& estimate) {
  Svar protocol = Svar::object({{"reference", describe(reference)},
                                {"estimate", describe(estimate)},
                                {"poses_used", posesUsed(estimate)},
                                {"machine", describeMachine()}});
  const fs::path run = fs::path(estimate.path).parent_path() / "run.json";
  if (fs::exists(run)) protocol.set("run", gslam::loadJson(run.string()));
  return protocol;
}

gslam::EvaluationOptions evaluationOf(const Options& options, const Input& reference,
                                      const Input& estimate) {
  gslam::EvaluationOptions how;
  how.association = associationOf(options, reference, estimate);
  how.alignment = parsed("--align", options.get<std::string>("align"), gslam::parseAlignment);
  for (const std::string& rpe : options.get<std::vector<std::string>>("rpe")) {
    how.rpe.push_back(parsed("--rpe", rpe, gslam::parseRpe));
  }
  how.has_kitti = options.get<bool>("kitti");
  how.segments = options.get<std::vector<double>>("segments");
  for (const double length : how.segments) {
    if (!(length > 0)) throw ConfigError("--segments", "expected lengths above 0, in metres");
  }
  how.lost_after = std::int64_t(1e9 * options.get<double>("lost-after"));
  how.protocol = protocolOf(reference, estimate);
  const bool are_matrices = reference.format == "kitti" && estimate.format == "kitti";
  if (are_matrices && how.association.method == gslam::AssociationMethod::evo) {
    how.reference_matrices = gslam::readKittiMatrices(reference.path);
    how.estimate_matrices = gslam::readKittiMatrices(estimate.path);
  }
  return how;
}

std::vector<gslam::MapPoint> readCloud(const std::string& path) {
  if (!isMap(contentOf(path))) return gslam::loadPly(path);
  const gslam::Map map = gslam::loadMap(path);
  std::vector<gslam::MapPoint> points;
  for (const auto& item : map.points()) points.push_back(item.value);
  return points;
}

void measureCloud(const Options& options, gslam::Evaluation& evaluation) {
  const std::string reference = options.get<std::string>("ref-cloud");
  const std::string cloud = options.get<std::string>("cloud");
  if (reference.empty() && cloud.empty()) return;
  if (reference.empty() || cloud.empty()) {
    throw ConfigError(reference.empty() ? "--ref-cloud" : "--cloud",
                      "must be given with the other");
  }
  if (!evaluation.alignment.is_valid) return;
  gslam::CloudOptions how;
  how.S_world_cloud = evaluation.alignment.S_world_map;
  how.icp_rounds = std::size_t(options.get<int>("icp"));
  evaluation.cloud = gslam::cloudErrors(readCloud(reference), readCloud(cloud), how);
  evaluation.has_cloud = true;
}

void printText(const Input& reference, const Input& estimate, const gslam::Evaluation& evaluation) {
  for (const Input* const input : {&reference, &estimate}) {
    std::cout << (input == &reference ? "reference    " : "estimate     ") << input->path << ": "
              << input->format << ", " << input->trajectory.size() << " poses\n";
    if (input->repeated == 0) continue;
    std::cout << "             " << input->repeated
              << " more repeat a stamp; the first of each counts\n";
  }
  std::cout << gslam::evaluationText(evaluation);
}

}  // namespace

int evalCommand(const std::vector<std::string>& arguments) {
  Options options("gslam eval --ref GT --est EST [options]",
                  "Measures a trajectory against ground truth: association, coverage, alignment, "
                  "absolute and relative errors.");
  declareOptions(options);
  if (!options.read(withOneRpe(arguments))) return kSuccess;
  options.noWords();
  const Input reference = readInput(options, "ref"), estimate = readInput(options, "est");
  const gslam::EvaluationOptions how = evaluationOf(options, reference, estimate);
  gslam::Evaluation evaluation = gslam::evaluate(reference.trajectory, estimate.trajectory, how);
  measureCloud(options, evaluation);
  if (options.isJson()) {
    std::cout << gslam::printJson(gslam::evaluationToSvar(evaluation)) << '\n';
  } else {
    printText(reference, estimate, evaluation);
  }
  if (evaluation.alignment.is_valid) return kSuccess;
  std::cerr << "gslam eval: --align " << gslam::alignmentText(how.alignment)
            << " is not possible: " << evaluation.alignment.reason << '\n';
  return kFailure;
}

}  // namespace app
