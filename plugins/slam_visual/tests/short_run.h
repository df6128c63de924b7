// Runs of the whole system on a few small frames, as a program runs it.
#ifndef GSLAM_PLUGINS_SLAM_VISUAL_TESTS_SHORT_RUN_H
#define GSLAM_PLUGINS_SLAM_VISUAL_TESTS_SHORT_RUN_H

#include <gslam/core.h>
#include <gslam/estimator/solvers/rigid_3d.h>
#include <gslam/estimator/solvers/similarity_3d.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "images.h"
#include "visual_slam.h"

namespace short_run {

using gslam::Frame;
using gslam::Svar;
using gslam::TrackedPose;
using gslam::TrackingState;

using Frames = std::vector<std::shared_ptr<const Frame>>;

constexpr std::size_t kFrames = 45;

inline std::string nameOf(const std::string& options) {
  return "synthetic://room?width=320&height=240&frames=45&speed=1&" + options;
}

inline const gslam::SensorRig& rigOf(const std::string& options) {
  return images::worldOf(nameOf(options)).info().sensors;
}

/// The frames of a small room, rendered once.
inline Frames framesOf(const std::string& options = "sensors=rgbd") {
  Frames frames;
  for (std::size_t i = 0; i < kFrames; ++i) frames.push_back(images::frameOf(nameOf(options), i));
  return frames;
}

/// Changes a copy of some frames.
inline void change(Frames& frames, std::size_t first, std::size_t last,
                   const std::function<void(Frame&)>& how) {
  for (std::size_t i = first; i <= last; ++i) {
    const auto changed = std::make_shared<Frame>(*frames[i]);
    how(*changed);
    frames[i] = changed;
  }
}

inline void number(Frames& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    change(frames, i, i, [i](Frame& frame) { frame.id = i; });
  }
}

/// All photographs of a frame in one grey.
inline void paint(Frame& frame, int grey) {
  for (gslam::CameraImage& image : frame.images) {
    if (!gslam::isPhotographic(image.kind)) continue;
    image.image = gslam::Image(image.image.width(), image.image.height(), gslam::PixelType::u8,
                               image.image.channels());
    for (int y = 0; y < image.image.height(); ++y) {
      std::uint8_t* const row = image.image.bytes(y);
      std::fill(row, row + image.image.rowBytes(), std::uint8_t(grey));
    }
  }
}

/// A system that is fed, and what it says.
struct Played {
  explicit Played(const gslam::SensorRig& rig, const Svar& parameters = Svar()) {
    const gslam::SlamFactory factory = visual::visualFactory();
    slam = factory.make();
    subscriber = messenger.subscribe<TrackedPose>(
        "pose", [this](const TrackedPose& pose) { (is_finished ? finals : live).push_back(pose); });
    gslam::SlamSetup setup;
    Svar small = Svar::object({{"features", 500}});
    setup.parameters = gslam::completeParameters(
        factory.parameters, parameters.isNull() ? small : small.merged(parameters));
    setup.sensors = rig;
    setup.messenger = messenger;
    slam->configure(setup);
  }
  Played(const Played&) = delete;
  Played& operator=(const Played&) = delete;

  void feed(const Frames& frames) {
    for (const auto& frame : frames) slam->feed(frame);
  }
  void finish() {
    is_finished = true;
    slam->finish();
  }
  std::size_t tracked(const std::vector<TrackedPose>& poses) const {
    std::size_t count = 0;
    for (const TrackedPose& pose : poses) count += pose.state == TrackingState::tracking ? 1 : 0;
    return count;
  }

  gslam::Messenger messenger;
  std::vector<TrackedPose> live, finals;
  bool is_finished = false;
  gslam::Subscriber subscriber;
  std::unique_ptr<gslam::Slam> slam;  // first to go
};

inline std::unique_ptr<Played> runOf(const gslam::SensorRig& rig, const Frames& frames,
                                     const Svar& parameters = Svar()) {
  auto run = std::make_unique<Played>(rig, parameters);
  run->feed(frames);
  run->finish();
  return run;
}

/// Each frame has one pose in feed(), and one in finish(), in order.
inline void expectAllAnswered(const Played& run, const Frames& frames) {
  for (const std::vector<TrackedPose>* poses : {&run.live, &run.finals}) {
    ASSERT_EQ(poses->size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const TrackedPose& pose = (*poses)[i];
      EXPECT_EQ(pose.frame, frames[i]->id);
      EXPECT_EQ(pose.stamp, frames[i]->stamp);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_TRUE(std::isfinite(pose.T_world_body.translation()[k]));
      }
    }
  }
}

/// Root mean square of the distance of tracked frames from the truth, metres, after the best
/// alignment.
/// @param source  by the place of the pose: which frame of the dataset the image is of; empty: the
///   same place
inline double errorOf(const std::vector<TrackedPose>& poses, const std::string& options,
                      bool has_scale, const std::vector<std::size_t>& source = {}) {
  const gslam::Trajectory& truth = images::worldOf(nameOf(options)).info().ground_truth;
  std::vector<gslam::Vec3d> found, expected;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].state != TrackingState::tracking) continue;
    const std::size_t of = source.empty() ? i : source[i];
    const std::int64_t stamp = images::frameOf(nameOf(options), of)->stamp;
    gslam::SE3d pose;
    if (!truth.interpolate(stamp, pose)) continue;
    found.push_back(poses[i].T_world_body.translation());
    expected.push_back(pose.translation());
  }
  if (found.size() < 3) return 1e9;
  gslam::SIM3d S;
  gslam::SE3d T;
  if (has_scale) {
    gslam::similarity3D(found, expected, S);
  } else {
    gslam::rigid3D(found, expected, T);
    S = gslam::SIM3d(T.rotation(), T.translation(), 1.0);
  }
  double sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) sum += (S * found[i] - expected[i]).squaredNorm();
  return std::sqrt(sum / double(found.size()));
}

}  // namespace short_run

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_TESTS_SHORT_RUN_H
