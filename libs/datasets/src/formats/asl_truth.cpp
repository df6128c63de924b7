// Ground truth in the ASL layout: poses, or positions, each with the place of its sensor.
#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/svar_formats/yaml.h>

#include <utility>

#include "../calibration/fields.h"
#include "asl.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

const char* const kWithPoses[] = {"state_groundtruth_estimate0", "mocap0", "vicon0"};
const char* const kPositions = "leica0";

std::string dataOf(const Asl& asl, const std::string& folder) {
  return asl.file(folder + "/data.csv");
}

std::size_t countLines(const std::string& text, const std::string& name) {
  detail::FieldReader in(text, name, "a pose");
  std::size_t count = 0;
  while (in.nextLine()) ++count;
  return count;
}

Trajectory readPoses(Asl& asl, const std::string& folder) {
  const std::string file = dataOf(asl, folder);
  const std::string text = asl.tree->text(file), name = asl.tree->nameOf(file);
  TrajectoryFileOptions options;
  options.format = TrajectoryFormat::euroc;
  options.duplicates = DuplicateStamps::keep_first;
  options.may_be_empty = true;
  const Trajectory read = parseTrajectory(text, name, options);
  const std::size_t twins = countLines(text, name) - read.size();
  if (twins > 0) {
    asl.sequence.remarks.say(std::to_string(twins) + " poses of " + file +
                             " that have the stamp of another were skipped");
  }
  const SE3d T_sensor_body = placeOfSensor(asl, folder).inverse();
  std::vector<StampedPose> poses;
  poses.reserve(read.size());
  for (const StampedPose& pose : read) poses.push_back({pose.stamp, pose.pose * T_sensor_body});
  return Trajectory(std::move(poses));
}

// A tracker of a prism has no rotations: the poses are of the prism, and turned like the world.
Trajectory readPositions(Asl& asl) {
  const std::string file = dataOf(asl, kPositions);
  const std::string text = asl.tree->text(file), name = asl.tree->nameOf(file);
  detail::FieldReader in(text, name, "stamp (ns), position x y z (m)");
  Trajectory poses;
  while (in.nextLine()) {
    const std::int64_t stamp = in.stamp("nanoseconds", 0);
    Vec3d position;
    for (std::size_t i = 0; i < 3; ++i) position[i] = in.number("the position");
    in.endLine();
    try {
      poses.add(stamp, SE3d(SO3d(), position));
    } catch (const ArgumentError&) {
      asl.sequence.remarks.skip("positions that have the stamp of another",
                                file + ":" + std::to_string(in.line()));
    }
  }
  asl.sequence.remarks.say("ground truth is of the prism of " + file +
                           ", which has no rotations: they are the identity, and the positions "
                           "are not those of the body");
  return poses;
}

}  // namespace

SE3d placeOfSensor(const Asl& asl, const std::string& folder) {
  const std::string file = asl.file(folder + "/sensor.yaml");
  if (!asl.tree->has(file)) return SE3d();
  const std::string name = asl.tree->nameOf(file);
  const calibration::Fields fields(parseYaml(asl.tree->text(file), name), name);
  return fields.has("T_BS") ? fields["T_BS"].pose() : SE3d();
}

void readAslTruth(Asl& asl) {
  DatasetInfo& info = asl.sequence.info;
  Remarks& remarks = asl.sequence.remarks;
  std::string wanted = asl.parameters.get<std::string>("truth");
  if (!wanted.empty() && !asl.tree->has(dataOf(asl, wanted))) {
    throw FileError(asl.tree->nameOf(dataOf(asl, wanted)),
                    "does not exist, but the parameter truth names it");
  }
  for (const char* folder : kWithPoses) {
    if (!asl.tree->has(dataOf(asl, folder))) continue;
    if (wanted.empty()) {
      wanted = folder;
    } else if (wanted != folder) {
      remarks.say(std::string(folder) + " has poses, too: truth=" + folder + " takes them");
    }
  }
  if (asl.tree->has(dataOf(asl, kPositions)) && wanted != kPositions) {
    remarks.say(std::string(kPositions) + " has positions: truth=" + kPositions + " takes them");
  }
  if (wanted.empty()) {
    remarks.say("there is no ground truth");
    return;
  }
  info.ground_truth = wanted == kPositions ? readPositions(asl) : readPoses(asl, wanted);
  if (info.ground_truth.empty()) remarks.say(dataOf(asl, wanted) + " has no poses");
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
