// A SLAM system that does what a test says, and a dataset for it.
#ifndef GSLAM_CORE_TESTS_SCRIPTED_SLAM_H
#define GSLAM_CORE_TESTS_SCRIPTED_SLAM_H

#include <gslam/core.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace scripted {

constexpr std::int64_t kFramePeriod = 10000000;  // ns
constexpr std::int64_t kImuPeriod = 2500000;     // ns

// Where the body is at a time, for no reason.
inline gslam::SE3d poseAt(std::int64_t stamp) {
  const double t = double(stamp) * 1e-9;
  return gslam::SE3d(gslam::SO3d::exp({{0, 0, t}}), {{t, 2 * t, 0}});
}

// Frames with a small image each, and the four inertial samples before it; the ground truth has a
// pose at each frame.
inline std::unique_ptr<gslam::MemoryDataset> dataset(std::size_t count) {
  gslam::DatasetInfo info;
  info.name = "scripted";
  gslam::CameraSensor camera;
  camera.name = "left";
  camera.camera = gslam::Camera::fromParameters("pinhole", 8, 6, {10, 10, 3.5, 2.5});
  info.sensors.cameras.push_back(camera);
  info.sensors.has_imu = true;
  std::vector<std::shared_ptr<const gslam::Frame>> frames;
  for (std::size_t i = 0; i < count; ++i) {
    const auto frame = std::make_shared<gslam::Frame>();
    frame->id = i;
    frame->stamp = std::int64_t(i) * kFramePeriod;
    gslam::CameraImage image;
    image.image = gslam::Image(8, 6, gslam::PixelType::u8);
    image.image.at<std::uint8_t>(0, 0) = static_cast<std::uint8_t>(i);
    image.camera = camera.camera;
    image.name = camera.name;
    frame->images.push_back(image);
    for (int s = 3; s >= 0; --s) {
      frame->imu.push_back({frame->stamp - s * kImuPeriod, {{0, 0, 1}}, {{0, 0, 9.81}}});
    }
    info.ground_truth.add(frame->stamp, poseAt(frame->stamp));
    frames.push_back(frame);
  }
  return std::unique_ptr<gslam::MemoryDataset>(
      new gslam::MemoryDataset(std::move(info), std::move(frames)));
}

// Publishes the true pose of each frame, remembers who called, and does what it is told at frames.
class Slam : public gslam::Slam {
 public:
  void configure(const gslam::SlamSetup& setup) override {
    calls.push_back("configure");
    threads.push_back(std::this_thread::get_id());
    pose_ = setup.messenger.advertise<gslam::TrackedPose>("pose");
    if (on_configure) on_configure(setup);
  }
  void feed(const std::shared_ptr<const gslam::Frame>& frame) override {
    threads.push_back(std::this_thread::get_id());
    if (on_frame) on_frame(*frame);
    frames.push_back(frame);
    publish({frame->id, frame->stamp, poseAt(frame->stamp), gslam::TrackingState::tracking});
  }
  std::shared_ptr<const gslam::Map> map() override {
    calls.push_back("map");
    threads.push_back(std::this_thread::get_id());
    return nullptr;
  }
  void finish() override {
    calls.push_back("finish");
    threads.push_back(std::this_thread::get_id());
    if (on_finish) on_finish();
  }

  void publish(const gslam::TrackedPose& pose) const { pose_.publish(pose); }

  std::function<void(const gslam::SlamSetup&)> on_configure;
  std::function<void(const gslam::Frame&)> on_frame;
  std::function<void()> on_finish;
  std::vector<std::shared_ptr<const gslam::Frame>> frames;
  std::vector<std::string> calls;
  std::vector<std::thread::id> threads;

 private:
  gslam::Publisher<gslam::TrackedPose> pose_;
};

}  // namespace scripted

#endif  // GSLAM_CORE_TESTS_SCRIPTED_SLAM_H
