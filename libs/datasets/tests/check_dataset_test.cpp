#include <gslam/base/error.h>
#include <gslam/core/memory_dataset.h>
#include <gslam/datasets/check_dataset.h>
#include <gslam/datasets/synthetic.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "words.h"

namespace {

using gslam::checkDataset;
using gslam::DatasetCheck;
using gslam::DatasetInfo;
using gslam::Frame;
using gslam::Image;
using gslam::PixelType;

// A dataset of ten frames with nothing wrong, but for what `spoil` does to it.
struct Parts {
  DatasetInfo info;
  std::vector<std::shared_ptr<Frame>> frames;
};

DatasetCheck checkOf(const std::function<void(Parts&)>& spoil) {
  Parts parts;
  gslam::CameraSensor colour, depth;
  colour.name = "colour";
  colour.kind = gslam::ImageKind::grey;
  colour.camera = gslam::Camera::fromParameters("pinhole", 32, 24, {30, 30, 15.5, 11.5});
  depth = colour;
  depth.name = "depth";
  depth.kind = gslam::ImageKind::depth;
  depth.depth_scale = 0.001;
  parts.info.sensors.cameras = {colour, depth};
  parts.info.sensors.has_imu = parts.info.sensors.has_gnss = true;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const auto frame = std::make_shared<Frame>();
    frame->id = i;
    frame->stamp = std::int64_t(i) * 100000000;
    for (const gslam::CameraSensor& camera : parts.info.sensors.cameras) {
      const bool is_depth = camera.kind == gslam::ImageKind::depth;
      gslam::CameraImage image;
      image.name = camera.name;
      image.kind = camera.kind;
      image.camera = camera.camera;
      image.depth_scale = camera.depth_scale;
      image.image = Image(32, 24, is_depth ? PixelType::u16 : PixelType::u8);
      for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 32; ++x) {
          if (is_depth) image.image.at<std::uint16_t>(x, y) = std::uint16_t(1000 + x + y);
          if (!is_depth) image.image.at<std::uint8_t>(x, y) = std::uint8_t(x * y);
        }
      }
      frame->images.push_back(image);
    }
    gslam::ImuSample imu{};
    imu.stamp = frame->stamp;
    imu.accel = {{0, 0, 9.81}};
    frame->imu.push_back(imu);
    gslam::GnssSample gnss{};
    gnss.stamp = frame->stamp;
    gnss.fix = gslam::GnssFix::single;
    frame->gnss.push_back(gnss);
    parts.info.ground_truth.add(frame->stamp, gslam::SE3d());
    parts.frames.push_back(frame);
  }
  spoil(parts);
  gslam::MemoryDataset dataset(parts.info, {parts.frames.begin(), parts.frames.end()});
  return checkDataset(dataset);
}

TEST(check_dataset, finds_nothing_wrong_with_a_good_one) {
  const DatasetCheck check = checkOf([](Parts&) {});
  EXPECT_EQ(check.frames, 10U);
  EXPECT_EQ(check.images, 20U);
  EXPECT_EQ(check.imu_samples, 10U);
  EXPECT_EQ(check.gnss_samples, 10U);
  EXPECT_EQ(check.longest_step, 100000000);
  EXPECT_TRUE(check.errors.empty()) << check.errors[0];
  EXPECT_TRUE(check.warnings.empty()) << check.warnings[0];
}

TEST(check_dataset, finds_nothing_wrong_with_a_synthetic_world) {
  const auto dataset = gslam::openSynthetic(
      gslam::syntheticOptions("synthetic://room?frames=5&width=160&height=120&imu=true&gnss=true"));
  const DatasetCheck check = checkDataset(*dataset);
  EXPECT_EQ(check.frames, 5U);
  EXPECT_TRUE(check.errors.empty()) << check.errors[0];
  EXPECT_TRUE(check.warnings.empty()) << check.warnings[0];
}

struct Fault {
  const char* error;  // else a warning
  const char* warning;
  std::function<void(Parts&)> spoil;
};

TEST(check_dataset, finds_each_fault) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Fault> faults = {
      {"not after that of the frame before", "",
       [](Parts& p) { p.frames[4]->stamp = p.frames[3]->stamp; }},
      {"an inertial sample is not between", "", [](Parts& p) { p.frames[4]->imu[0].stamp = 0; }},
      {"not finite", "", [nan](Parts& p) { p.frames[4]->imu[0].gyro[1] = nan; }},
      {"is no place", "", [](Parts& p) { p.frames[4]->gnss[0].position.latitude = 46.8; }},
      {"has no pixels", "", [](Parts& p) { p.frames[4]->images[0].image = Image(); }},
      {"calibrated for 32 x 24", "",
       [](Parts& p) { p.frames[4]->images[1].image = Image(64, 24, PixelType::u16); }},
      {"expected one channel of u16 or f32", "",
       [](Parts& p) { p.frames[4]->images[1].image = Image(32, 24, PixelType::u8, 3); }},
      {"a satellite position is not between", "",
       [](Parts& p) { p.frames[4]->gnss[0].stamp = 990000000; }},
      {"the pose is not finite", "",
       [nan](Parts& p) {
         p.info.ground_truth.add(450000000, gslam::SE3d(gslam::SO3d(), {{nan, 0, 0}}));
       }},
      {"has no depth scale", "", [](Parts& p) { p.frames[4]->images[1].depth_scale = 0; }},
      {"camera 'depth' has no image at all", "",
       [](Parts& p) {
         for (auto& frame : p.frames) frame->images.pop_back();
       }},
      {"no frame has a sample", "",
       [](Parts& p) {
         for (auto& frame : p.frames) frame->imu.clear();
       }},
      {"satellite positions, but no frame", "",
       [](Parts& p) {
         for (auto& frame : p.frames) frame->gnss.clear();
       }},
      {"no frame can be read", "", [](Parts& p) { p.frames.clear(); }},
      {"", "'depth' is the same everywhere",
       [](Parts& p) { p.frames[4]->images[1].image = Image(32, 24, PixelType::u16); }},
      {"", "one colour everywhere",
       [](Parts& p) { p.frames[4]->images[0].image = Image(32, 24, PixelType::u8); }},
      {"", "it has no image of camera 'depth'", [](Parts& p) { p.frames[4]->images.pop_back(); }},
      {"", "acceleration is usually 1.0",
       [](Parts& p) {
         for (auto& frame : p.frames) frame->imu[0].accel = {{0, 1, 0}};
       }},
      {"", "turning is usually 57",
       [](Parts& p) {
         for (auto& frame : p.frames) frame->imu[0].gyro = {{0, 57, 0}};
       }},
      {"", "depth is usually 1",
       [](Parts& p) {
         for (auto& frame : p.frames) frame->images[1].depth_scale = 1;
       }},
      {"", "the ground truth is of another time",
       [](Parts& p) {
         p.info.ground_truth = gslam::Trajectory();
         p.info.ground_truth.add(5000000000000, gslam::SE3d());
       }},
      {"", "jumps faster",
       [](Parts& p) {
         p.info.ground_truth.add(450000000, gslam::SE3d(gslam::SO3d(), {{100, 0, 0}}));
       }},
  };
  for (const Fault& fault : faults) {
    const DatasetCheck check = checkOf(fault.spoil);
    if (*fault.warning == '\0') {
      EXPECT_TRUE(says(check.errors, fault.error)) << fault.error;
      continue;
    }
    EXPECT_TRUE(says(check.warnings, fault.warning)) << fault.warning;
    EXPECT_TRUE(check.errors.empty()) << fault.warning << ": " << check.errors[0];
  }
}

// Frames that cannot be read, one that fails for ever, and a count that is wrong.
class HalfBroken : public gslam::Dataset {
 public:
  explicit HalfBroken(std::size_t stated) { info_.frame_count = stated; }
  const DatasetInfo& info() const override { return info_; }
  std::shared_ptr<const Frame> next() override {
    if (at_ == 7) return nullptr;
    if (++at_ % 2 == 0) throw gslam::FileError(std::to_string(at_) + ".png", "a file is damaged");
    const auto frame = std::make_shared<Frame>();
    frame->id = at_ - 1;
    frame->stamp = std::int64_t(at_);
    return frame;
  }
  void seek(std::size_t index) override { at_ = index; }

 protected:
  DatasetInfo info_;
  std::size_t at_ = 0;
};

class Endless : public HalfBroken {
 public:
  Endless() : HalfBroken(0) {}
  std::shared_ptr<const Frame> next() override { throw gslam::Error("nothing works"); }
};

TEST(check_dataset, counts_what_cannot_be_read) {
  HalfBroken dataset(9);
  const DatasetCheck check = checkDataset(dataset);
  EXPECT_EQ(check.frames, 4U);
  EXPECT_TRUE(says(check.errors,
                   "frame 1 (2.png): cannot be read: a file is damaged (and 2 more like it)"));
  EXPECT_TRUE(says(check.errors, "there are 7 frames, but it says 9"));
}

TEST(check_dataset, ends_where_everything_fails) {
  Endless dataset;
  const DatasetCheck check = checkDataset(dataset);
  EXPECT_EQ(check.frames, 0U);
  EXPECT_FALSE(check.errors.empty());
}

TEST(check_dataset, can_be_stopped_and_refuses_devices) {
  HalfBroken dataset(7);
  const std::atomic<bool> stop{true};
  gslam::CheckOptions options;
  options.stop = &stop;
  EXPECT_TRUE(checkDataset(dataset, options).is_stopped);
  DatasetInfo info;
  class Live : public HalfBroken {
   public:
    Live() : HalfBroken(0) { info_.is_live = true; }
  } live;
  EXPECT_THROW(checkDataset(live), gslam::ArgumentError);
}

}  // namespace
