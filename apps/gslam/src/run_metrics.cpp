#include "run_metrics.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "frame_log.h"
#include "live_trajectory.h"

namespace app {
namespace {

using gslam::Svar;
using gslam::TrackedFrame;
using gslam::Trajectory;

// The frames that the system was given or should have been, ascending. Of those with the same stamp
// the first counts: they cannot be told apart in a trajectory.
std::vector<TrackedFrame> givenFrames(const FrameRecords& records) {
  std::vector<TrackedFrame> frames;
  for (const gslam::FrameTime& frame : records.frames) {
    const bool is_tracked =
        !frame.is_dropped && frame.has_result && frame.state == gslam::TrackingState::tracking;
    frames.push_back({frame.stamp, is_tracked});
  }
  std::stable_sort(frames.begin(), frames.end(),
                   [](const TrackedFrame& a, const TrackedFrame& b) { return a.stamp < b.stamp; });
  const auto end =
      std::unique(frames.begin(), frames.end(),
                  [](const TrackedFrame& a, const TrackedFrame& b) { return a.stamp == b.stamp; });
  frames.erase(end, frames.end());
  return frames;
}

// Where the dataset's frames lie in time; 0 frames: not known.
struct Extent {
  std::int64_t first = 0, step = 0;
  std::uint64_t frames = 0;
};

// By what the dataset tells, or else by ground truth.
Extent extentOf(const Svar& report, const Trajectory& truth,
                const std::vector<TrackedFrame>& given) {
  Extent extent;
  extent.frames = report.get<std::uint64_t>("dataset.frames", 0);
  extent.first = report.get<std::int64_t>("dataset.first_stamp", 0);
  auto last = report.get<std::int64_t>("dataset.last_stamp", 0);
  if (last <= extent.first && !truth.empty()) {
    extent.first = truth.front().stamp;
    last = truth.back().stamp;
  }
  if (extent.frames == 0 && given.size() > 1) {  // as many as at the pace so far
    const std::int64_t span = given.back().stamp - given.front().stamp;
    extent.step = span / std::int64_t(given.size() - 1);
    if (extent.step > 0 && last > extent.first) {
      extent.frames = std::uint64_t((last - extent.first) / extent.step) + 1;
    }
  }
  if (extent.frames < 2 || last <= extent.first) return {};
  extent.step = std::max<std::int64_t>(1, (last - extent.first) / std::int64_t(extent.frames - 1));
  return extent;
}

// A crash must not look better than losing track: the frames that a run which failed did not come
// to count as lost. Stamps that nobody has read are taken at even steps. A dataset that fails is
// not the system's fault.
// @return how many were added
std::uint64_t addFramesToCome(const FrameRecords& records, const Svar& report,
                              const Trajectory& truth, std::vector<TrackedFrame>& frames) {
  if (report.get<std::string>("result.end", "") != "failed") return 0;
  if (report.get<std::string>("result.cause", "") == "dataset") return 0;
  const Extent extent = extentOf(report, truth, frames);
  const auto first = report.get<std::uint64_t>("first", 0);
  const auto most = report.get<std::uint64_t>("count", 0);
  std::uint64_t planned = extent.frames > first ? extent.frames - first : 0;
  if (most > 0) planned = std::min(planned, most);
  const std::uint64_t done = records.frames.size() + records.unreadable;
  const std::uint64_t to_come = planned > done ? planned - done : 0;
  std::int64_t stamp = frames.empty()
                           ? extent.first + std::int64_t(first) * extent.step - extent.step
                           : frames.back().stamp;
  for (std::uint64_t i = 0; i < to_come; ++i) frames.push_back({stamp += extent.step, false});
  return to_come;
}

// Whether the dataset has ground truth; where it was never opened, that is not known.
bool lacksTruth(const Svar& report) {
  const Svar poses = report.get<Svar>("dataset.ground_truth_poses", Svar());
  return !poses.isNull() && poses.as<std::uint64_t>() == 0;
}

Svar describeCoverage(const gslam::Coverage& coverage) {
  return Svar::object({{"time", coverage.time},
                       {"frames", coverage.frames},
                       {"tracked_frames", coverage.tracked_frames},
                       {"total_frames", coverage.total_frames},
                       {"losses", coverage.losses},
                       {"longest_loss_s", coverage.longest_loss},
                       {"time_to_initialise_s",
                        coverage.is_initialised ? Svar(coverage.time_to_initialise) : Svar()}});
}

// Why the coverage may be less than the poses.
std::string noteOfGuesses(const FrameRecords& records) {
  const auto guessed = std::count_if(
      records.frames.begin(), records.frames.end(), [](const gslam::FrameTime& frame) {
        return frame.has_result && frame.state == gslam::TrackingState::guessed;
      });
  if (guessed == 0) return "";
  return "note         " + std::to_string(guessed) +
         " frames are guessed, not tracked: they count for errors, not for the coverage\n";
}

std::string percent(double part) {
  std::ostringstream out;
  out.precision(3);
  out << 100 * part << " %";
  return out.str();
}

// One of the two trajectories against ground truth.
struct Accuracy {
  Svar json;
  std::string text;
};

// What can be said without a comparison.
Accuracy withoutErrors(const std::string& reason, bool lacks_truth, const Trajectory& truth,
                       const Trajectory& estimate, const gslam::EvaluationOptions& how) {
  Accuracy result;
  result.json = Svar::object({{"protocol", how.protocol},
                              {"association", nullptr},
                              {"coverage", nullptr},
                              {"alignment", nullptr},
                              {"ape", nullptr},
                              {"rpe", Svar::array()},
                              {"drift", nullptr},
                              {"score", nullptr},
                              {"reason", reason}});
  gslam::Coverage coverage;  // nothing
  if (!how.frames.empty()) coverage = gslam::coverageOf(how.frames);
  if (how.frames.empty() && !truth.empty()) coverage = gslam::coverageOf(truth, estimate);
  result.json.set("coverage", describeCoverage(coverage));
  result.text = "coverage     " + percent(coverage.frames) + " of " +
                std::to_string(coverage.total_frames) + " frames, " + percent(coverage.time) +
                " of the time\n";
  // Nothing that can be compared: a score of 0, so that giving up is no way to have none.
  if (!lacks_truth) result.json.set("score", Svar::object({{"value", 0.0}}));
  result.text += "accuracy     not measured: " + reason + '\n';
  return result;
}

Accuracy measure(const Trajectory& truth, const Trajectory& estimate, const Svar& report,
                 const gslam::EvaluationOptions& how) {
  const bool lacks_truth = lacksTruth(report);
  if (lacks_truth) {
    return withoutErrors("the dataset has no ground truth", true, truth, estimate, how);
  }
  if (truth.empty()) {  // it did not come to that
    return withoutErrors(report.get<std::string>("result.failure", "it did not begin"), false,
                         truth, estimate, how);
  }
  if (estimate.empty()) return withoutErrors("there are no poses", false, truth, estimate, how);
  try {
    const gslam::Evaluation evaluation = gslam::evaluate(truth, estimate, how);
    Accuracy result{gslam::evaluationToSvar(evaluation), gslam::evaluationText(evaluation)};
    if (!evaluation.alignment.is_valid) {
      result.text += "alignment    not possible: " + evaluation.alignment.reason +
                     "; --align origin or none may be\n";
      result.json.set("score.value", 0.0);  // so that giving up is no way to have none
    }
    return result;
  } catch (const gslam::Error& error) {
    return withoutErrors(error.what(), false, truth, estimate, how);
  }
}

// What the other trajectory has of its own: no protocol.
Svar withoutProtocol(const Svar& json) {
  Svar result = Svar::object();
  for (const Svar::Member& member : json.members()) {
    if (member.first != "protocol") result.set(member.first, member.second);
  }
  return result;
}

Accuracy measureFinal(const RunFolder& folder, const Svar& report, const Trajectory& truth,
                      const gslam::EvaluationOptions& live) {
  const Svar said = report.get<Svar>("poses.final", Svar());
  if (said.isNull()) return {nullptr, ""};  // it did not come to that
  const auto poses = said.as<std::string>();
  gslam::EvaluationOptions how = live;
  how.protocol = Svar::object();
  const bool are_keyframes = poses.find("keyframes") != std::string::npos;
  if (are_keyframes) how.frames.clear();  // they are few by intent
  Accuracy result = measure(truth, readLiveTrajectory(folder.final()), report, how);
  result.json = withoutProtocol(result.json);
  result.json.set("poses_used", are_keyframes ? "final, keyframes" : "final, all");
  const Svar rmse = result.json.get<Svar>("ape.translation.rmse", Svar());
  result.text.clear();
  if (!rmse.isNull()) {
    std::ostringstream text;
    text << "final poses  APE translation rmse " << rmse.as<double>() << " m ("
         << (are_keyframes ? "keyframes of the map" : "last pose of each frame") << ")\n";
    result.text = text.str();
  }
  return result;
}

Svar describePoses(const std::string& path, const Trajectory& trajectory) {
  return Svar::object({{"file", path}, {"format", "tum"}, {"poses", trajectory.size()}});
}

}  // namespace

RunMetrics measureRun(const RunFolder& folder, const Svar& report,
                      const gslam::EvaluationOptions& comparison, gslam::CostSource cost) {
  const FrameRecords records = readFrames(folder.frames());
  if (!records.frames.empty()) writeFrames(folder.frames(), records);
  const Trajectory truth = readLiveTrajectory(folder.truth());
  const Trajectory live = readLiveTrajectory(folder.trajectory());
  gslam::EvaluationOptions how = comparison;
  how.frames = givenFrames(records);
  const std::uint64_t same_stamps = records.frames.size() - how.frames.size();
  const std::uint64_t to_come = addFramesToCome(records, report, truth, how.frames);
  how.protocol = Svar::object({{"run", report},
                               {"reference", describePoses(folder.truth(), truth)},
                               {"estimate", describePoses(folder.trajectory(), live)},
                               {"poses_used", "live, all"},
                               {"frames_of_the_same_stamp", same_stamps},
                               {"frames_lost_by_failure", to_come}});
  const Accuracy accuracy = measure(truth, live, report, how);
  const Accuracy final = measureFinal(folder, report, truth, how);
  cost.frames = records.frames;
  cost.is_slam_alone = report.get<bool>("slam.isolated", false);
  const gslam::Cost summed = gslam::costOf(std::move(cost));

  RunMetrics metrics{accuracy.json, accuracy.text + final.text + noteOfGuesses(records)};
  if (!records.frames.empty()) metrics.text += '\n' + gslam::costText(summed);
  metrics.json.set("final", final.json);
  metrics.json.set("cost", gslam::costToSvar(summed));
  return metrics;
}

}  // namespace app
