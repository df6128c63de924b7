#include "run_metrics.h"

#include <gslam/base/error.h>
#include <gslam/core/trajectory_file.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>

#include "frame_log.h"

namespace app {
namespace {

using gslam::Svar;
using gslam::TrackedFrame;
using gslam::Trajectory;

// A file of a run; none: no poses.
Trajectory readPoses(const std::string& path) {
  if (!std::filesystem::exists(path)) return {};
  gslam::TrajectoryFileOptions how;
  how.format = gslam::TrajectoryFormat::tum;
  how.may_be_empty = true;
  how.duplicates = gslam::DuplicateStamps::keep_first;  // two frames of a dataset may have one
  return gslam::readTrajectory(path, how);
}

// The frames that the system was given or should have been, ascending.
std::vector<TrackedFrame> givenFrames(const FrameRecords& records) {
  std::vector<TrackedFrame> frames;
  for (const gslam::FrameTime& frame : records.frames) {
    if (!frames.empty() && frame.stamp <= frames.back().stamp) continue;
    const bool is_tracked =
        !frame.is_dropped && frame.has_result && frame.state == gslam::TrackingState::tracking;
    frames.push_back({frame.stamp, is_tracked});
  }
  return frames;
}

// How many frames of the dataset a run that failed did not come to.
std::uint64_t framesToCome(const FrameRecords& records, const Svar& report) {
  if (report.get<std::string>("result.end", "") != "failed") return 0;
  const auto all = report.get<std::uint64_t>("dataset.frames", 0);
  const auto first = report.get<std::uint64_t>("first", 0);
  const auto most = report.get<std::uint64_t>("count", 0);
  std::uint64_t planned = all > first ? all - first : 0;
  if (most > 0) planned = std::min(planned, most);
  const std::uint64_t done = records.frames.size() + records.unreadable;
  return planned > done ? planned - done : 0;
}

// A crash must not look better than losing track: what comes behind it counts as lost. Stamps that
// nobody has read are taken at even steps.
void addFramesToCome(std::uint64_t count, const Svar& report, const Trajectory& truth,
                     std::vector<TrackedFrame>& frames) {
  const auto all = report.get<std::uint64_t>("dataset.frames", 0);
  auto first = report.get<std::int64_t>("dataset.first_stamp", 0);
  auto last = report.get<std::int64_t>("dataset.last_stamp", 0);
  if (last <= first && !truth.empty()) {  // the dataset does not tell
    first = truth.front().stamp;
    last = truth.back().stamp;
  }
  if (count == 0 || all < 2 || last <= first) return;
  const std::int64_t step = std::max<std::int64_t>(1, (last - first) / std::int64_t(all - 1));
  std::int64_t stamp = frames.empty() ? first - step : frames.back().stamp;
  for (std::uint64_t i = 0; i < count; ++i) frames.push_back({stamp += step, false});
}

Svar describe(const gslam::Coverage& coverage) {
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
Accuracy withoutErrors(const std::string& reason, const Trajectory& truth,
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
  if (!how.frames.empty() || !truth.empty()) {
    const gslam::Coverage coverage =
        how.frames.empty() ? gslam::coverageOf(truth, estimate) : gslam::coverageOf(how.frames);
    result.json.set("coverage", describe(coverage));
    result.text = "coverage     " + percent(coverage.frames) + " of " +
                  std::to_string(coverage.total_frames) + " frames, " + percent(coverage.time) +
                  " of the time\n";
  }
  // Nothing was tracked: a score of 0, so that giving up is no way to have none.
  if (!truth.empty() && estimate.empty()) result.json.set("score", Svar::object({{"value", 0.0}}));
  result.text += "accuracy     not measured: " + reason + '\n';
  return result;
}

Accuracy measure(const Trajectory& truth, const Trajectory& estimate,
                 const gslam::EvaluationOptions& how) {
  if (truth.empty()) {
    return withoutErrors("the dataset has no ground truth", truth, estimate, how);
  }
  if (estimate.empty()) return withoutErrors("there are no poses", truth, estimate, how);
  try {
    const gslam::Evaluation evaluation = gslam::evaluate(truth, estimate, how);
    Accuracy result{gslam::evaluationToSvar(evaluation), gslam::evaluationText(evaluation)};
    if (!evaluation.alignment.is_valid) {
      result.text += "alignment    not possible: " + evaluation.alignment.reason +
                     "; --align origin or none may be\n";
    }
    return result;
  } catch (const gslam::Error& error) {
    return withoutErrors(error.what(), truth, estimate, how);
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
  Accuracy result = measure(truth, readPoses(folder.final()), how);
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
  const Trajectory truth = readPoses(folder.truth()), live = readPoses(folder.trajectory());
  gslam::EvaluationOptions how = comparison;
  how.frames = givenFrames(records);
  const std::uint64_t to_come = framesToCome(records, report);
  addFramesToCome(to_come, report, truth, how.frames);
  how.protocol = Svar::object({{"run", report},
                               {"reference", describePoses(folder.truth(), truth)},
                               {"estimate", describePoses(folder.trajectory(), live)},
                               {"poses_used", "live, all"},
                               {"frames_lost_by_failure", to_come}});
  const Accuracy accuracy = measure(truth, live, how);
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
