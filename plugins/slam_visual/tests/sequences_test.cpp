// What the whole system reaches on real sequences and in computed worlds. The bounds are those of
// ORB-SLAM2 on the same frames, or below; they hold for what is published at once and for what is
// published in the end.
#include <gslam/datasets.h>
#include <gslam/estimator/solvers/rigid_3d.h>
#include <gslam/estimator/solvers/similarity_3d.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "test_data.h"
#include "visual_slam.h"

namespace {

using gslam::SE3d;
using gslam::SIM3d;
using gslam::Svar;
using gslam::TrackedPose;
using gslam::Vec3d;

using Poses = std::map<std::uint64_t, TrackedPose>;

/// What a run published.
struct SequenceRun {
  Poses live, last;
  std::size_t frames = 0;
  gslam::Trajectory truth;
  std::size_t loop_edges = 0;
};

SequenceRun runOn(gslam::Dataset& dataset, const Svar& given) {
  const gslam::SlamFactory factory = visual::visualFactory();
  const std::unique_ptr<gslam::Slam> slam = factory.make();
  gslam::Messenger messenger;
  SequenceRun run;
  bool is_over = false;
  const gslam::Subscriber subscriber =
      messenger.subscribe<TrackedPose>("pose", [&](const TrackedPose& pose) {
        if (!is_over) run.live[pose.frame] = pose;
        run.last[pose.frame] = pose;
      });
  gslam::SlamSetup setup;
  setup.parameters = completeParameters(factory.parameters, given);
  setup.sensors = dataset.info().sensors;
  setup.messenger = messenger;
  slam->configure(setup);
  while (const std::shared_ptr<const gslam::Frame> frame = dataset.next()) {
    slam->feed(frame);
    ++run.frames;
  }
  is_over = true;
  slam->finish();
  run.truth = dataset.info().ground_truth;
  for (const auto& edge : slam->map()->edges()) {
    run.loop_edges += edge.value.kind == gslam::EdgeKind::loop ? 1 : 0;
  }
  return run;
}

/// Root mean squared distance from the truth after alignment, metres, and the part of the frames
/// that were tracked.
struct Accuracy {
  double error = 1e9;
  double coverage = 0;
};

Accuracy accuracyOf(const SequenceRun& run, const Poses& poses, bool has_scale) {
  std::vector<Vec3d> found, truth;
  std::size_t tracked = 0;
  for (const auto& [frame, pose] : poses) {
    if (pose.state != gslam::TrackingState::tracking) continue;
    ++tracked;
    SE3d there;
    if (!run.truth.interpolate(pose.stamp, there, 100000000)) continue;
    found.push_back(pose.T_world_body.translation());
    truth.push_back(there.translation());
  }
  Accuracy accuracy;
  accuracy.coverage = double(tracked) / double(run.frames);
  SIM3d S;
  SE3d T;
  if (found.size() < 3) return accuracy;
  if (has_scale) {
    if (similarity3D(found, truth, S) != 1) return accuracy;
  } else {
    if (rigid3D(found, truth, T) != 1) return accuracy;
    S = SIM3d(T);
  }
  double sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) sum += (S * found[i] - truth[i]).squaredNorm();
  accuracy.error = std::sqrt(sum / double(found.size()));
  return accuracy;
}

/// A sequence and what must be reached on it.
struct Gate {
  const char* name;
  const char* dataset;
  const char* sensor;
  double error;     ///< metres
  double coverage;  ///< part of the frames
};

void expectReached(const Gate& gate, const SequenceRun& run) {
  const bool has_scale = std::string(gate.sensor) == "mono";
  const Accuracy live = accuracyOf(run, run.live, has_scale);
  const Accuracy last = accuracyOf(run, run.last, has_scale);
  std::printf("%s: %.2f cm at once, %.2f cm in the end, %.1f %% tracked\n", gate.name,
              100 * live.error, 100 * last.error, 100 * last.coverage);
  EXPECT_LE(last.error, gate.error);
  EXPECT_GE(last.coverage, gate.coverage);
  EXPECT_GE(live.coverage, gate.coverage);
}

class RealSequences : public testing::TestWithParam<Gate> {};

TEST_P(RealSequences, AreFollowedAsWellAsByOthers) {
  NEEDS_TEST_DATA();
  const Gate& gate = GetParam();
  const std::unique_ptr<gslam::Dataset> dataset =
      gslam::openDataset(test_data::folder() + "sequences/" + gate.dataset, Svar());
  const SequenceRun run = runOn(*dataset, Svar::object({{"sensor", gate.sensor}}));
  expectReached(gate, run);
  EXPECT_LE(accuracyOf(run, run.live, std::string(gate.sensor) == "mono").error, gate.error);
}

INSTANTIATE_TEST_SUITE_P(
    Sequences, RealSequences,
    testing::Values(Gate{"RedKitchenDepth", "7scenes_redkitchen", "rgbd", 0.028, 1},
                    Gate{"RedKitchenMono", "7scenes_redkitchen", "mono", 0.028, 0.90},
                    Gate{"RpyDepth", "tum_rgbd_freiburg1_rpy", "rgbd", 0.020, 1},
                    Gate{"RpyMono", "tum_rgbd_freiburg1_rpy", "mono", 0.016, 0.90},
                    Gate{"Kitti06Stereo", "kitti_06", "stereo", 0.065, 1},
                    Gate{"Kitti06Mono", "kitti_06", "mono", 0.060, 0.96}),
    [](const testing::TestParamInfo<Gate>& gate) { return gate.param.name; });

bool isFull() {
  return std::getenv("GSLAM_FULL_TESTS") != nullptr;
}

std::unique_ptr<gslam::Dataset> room(const std::string& sensors, int seed) {
  return gslam::openSynthetic(gslam::syntheticOptions(
      "synthetic://room?frames=300&sensors=" + sensors + "&seed=" + std::to_string(seed)));
}

class Rooms : public testing::TestWithParam<Gate> {};

TEST_P(Rooms, AreWalkedAroundWithTheLoopClosed) {
  const Gate& gate = GetParam();
  const bool is_pair = std::string(gate.sensor) == "stereo";  // KITTI's is in every run
  if (is_pair && !isFull()) GTEST_SKIP() << "GSLAM_FULL_TESTS is not set";
  for (int seed = 1; seed <= (isFull() ? 5 : 1); ++seed) {
    SCOPED_TRACE(seed);
    expectReached(gate, runOn(*room(gate.sensor, seed), Svar::object({{"sensor", gate.sensor}})));
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, Rooms,
                         testing::Values(Gate{"Depth", "", "rgbd", 0.015, 1},
                                         Gate{"Stereo", "", "stereo", 0.020, 0.95},
                                         Gate{"Mono", "", "mono", 0.020, 0.95}),
                         [](const testing::TestParamInfo<Gate>& gate) { return gate.param.name; });

TEST(Corridor, IsLostWhereThereIsNothingToSeeAndFoundAgain) {
  if (!isFull()) GTEST_SKIP() << "GSLAM_FULL_TESTS is not set";
  const std::unique_ptr<gslam::Dataset> dataset = gslam::openSynthetic(
      gslam::syntheticOptions("synthetic://corridor?frames=600&low_texture=200-230"));
  const SequenceRun run = runOn(*dataset, Svar());
  std::size_t lost = 0;
  for (const auto& [frame, pose] : run.live) {
    lost += pose.state == gslam::TrackingState::lost ? 1 : 0;
  }
  EXPECT_GT(lost, 0U);
  expectReached({"Corridor", "", "rgbd", 0.1, 0.80}, run);
}

}  // namespace
