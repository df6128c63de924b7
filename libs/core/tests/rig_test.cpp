// Rigs, frames and samples: what is found, what is missing, and layouts that plugins rely on.
#include <gslam/core/frame.h>
#include <gslam/core/rig.h>
#include <gslam/core/sensor.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <type_traits>

namespace {

using gslam::CameraSensor;
using gslam::Frame;
using gslam::ImageKind;
using gslam::missingSensors;
using gslam::SensorNeeds;
using gslam::SensorRig;

CameraSensor camera(const std::string& name, ImageKind kind, bool calibrated = true) {
  CameraSensor sensor;
  sensor.name = name;
  sensor.kind = kind;
  if (calibrated) {
    sensor.camera = gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 320, 240});
  }
  return sensor;
}

SensorNeeds needs(int cameras, bool depth = false, bool imu = false, bool gnss = false,
                  bool calibration = true) {
  SensorNeeds result;
  result.cameras = cameras;
  result.depth = depth;
  result.imu = imu;
  result.gnss = gnss;
  result.calibration = calibration;
  return result;
}

TEST(Rig, NeedsAsText) {
  EXPECT_EQ(toText(SensorNeeds()), "1 calibrated camera");
  EXPECT_EQ(toText(needs(2, false, true)), "2 calibrated cameras, an IMU");
  EXPECT_EQ(toText(needs(1, true, false, true)), "1 calibrated camera, calibrated depth, GNSS");
  EXPECT_EQ(toText(needs(0)), "nothing");
}

TEST(Rig, NothingIsMissingWhereAllIsThere) {
  SensorRig rig;
  rig.cameras = {camera("left", ImageKind::grey), camera("right", ImageKind::bgr),
                 camera("depth", ImageKind::depth)};
  rig.has_imu = rig.has_gnss = true;
  EXPECT_EQ(missingSensors(needs(2, true, true, true), rig), "");
  EXPECT_EQ(missingSensors(needs(0), SensorRig()), "");
}

TEST(Rig, WhatIsMissingIsNamed) {
  SensorRig rig;
  rig.cameras = {camera("left", ImageKind::grey)};
  EXPECT_EQ(missingSensors(needs(2, true, true, true), rig),
            "2 cameras (it has 1), depth images, an IMU, GNSS positions");
  EXPECT_EQ(missingSensors(needs(1), SensorRig()), "1 camera (it has 0)");
  rig.cameras = {camera("depth", ImageKind::depth), camera("labels", ImageKind::label)};
  EXPECT_EQ(missingSensors(needs(1, true), rig), "1 camera (it has 0)");
}

TEST(Rig, CamerasThatAreUsedMustBeCalibrated) {
  SensorRig rig;
  rig.cameras = {camera("depth", ImageKind::depth, false), camera("left", ImageKind::grey),
                 camera("right", ImageKind::grey, false)};
  EXPECT_EQ(missingSensors(needs(1), rig), "");
  EXPECT_EQ(missingSensors(needs(2), rig), "the calibration of camera 'right'");
  EXPECT_EQ(missingSensors(needs(2, false, false, false, false), rig), "");
  EXPECT_EQ(missingSensors(needs(1, true), rig), "the calibration of camera 'depth'");
}

TEST(Rig, AnyCameraThatIsCalibratedWillDo) {
  SensorRig rig;
  rig.cameras = {camera("left", ImageKind::grey, false), camera("right", ImageKind::grey)};
  EXPECT_EQ(missingSensors(needs(1), rig), "");
}

TEST(Rig, KindsShowLightOrDoNot) {
  const std::set<ImageKind> others = {ImageKind::depth, ImageKind::disparity, ImageKind::mask,
                                      ImageKind::label};
  std::set<std::string> names;
  for (int i = 0; i <= static_cast<int>(ImageKind::label); ++i) {
    const ImageKind kind = static_cast<ImageKind>(i);
    EXPECT_EQ(isPhotographic(kind), others.count(kind) == 0) << i;
    names.insert(imageKindName(kind));
  }
  EXPECT_EQ(names.size(), 11U);
  EXPECT_EQ(names.count("unknown"), 0U);
  EXPECT_STREQ(imageKindName(static_cast<ImageKind>(11)), "unknown");
  EXPECT_FALSE(isPhotographic(static_cast<ImageKind>(11)));
}

TEST(Frame, ImagesAreFoundByKindAndName) {
  Frame frame;
  EXPECT_EQ(findImage(frame, ImageKind::grey), nullptr);
  EXPECT_EQ(findImage(frame, "left"), nullptr);
  frame.images.resize(3);
  frame.images[0].name = "left";
  frame.images[1].name = "right";
  frame.images[2].name = "depth";
  frame.images[2].kind = ImageKind::depth;
  EXPECT_EQ(findImage(frame, ImageKind::grey), &frame.images[0]);
  EXPECT_EQ(findImage(frame, ImageKind::depth), &frame.images[2]);
  EXPECT_EQ(findImage(frame, std::string("right")), &frame.images[1]);
  EXPECT_EQ(findImage(frame, std::string()), nullptr);
}

TEST(Frame, ACopySharesThePixels) {
  Frame frame;
  frame.images.resize(1);
  frame.images[0].image = gslam::Image(64, 48, gslam::PixelType::u8);
  const Frame copy = frame;
  EXPECT_EQ(copy.images[0].image.bytes(), frame.images[0].image.bytes());
  EXPECT_FALSE(frame.has_prior);
  EXPECT_FALSE(frame.images[0].camera.isValid());
  EXPECT_EQ(frame.images[0].T_body_camera.translation().norm(), 0);
}

// What plugins were compiled with; a change of any of these is a new interface version.
TEST(Sensor, LayoutsArePlain) {
  static_assert(std::is_trivially_copyable<gslam::ImuSample>::value, "");
  static_assert(std::is_trivially_copyable<gslam::Geodetic>::value, "");
  static_assert(std::is_trivially_copyable<gslam::GnssSample>::value, "");
  static_assert(std::is_standard_layout<gslam::ImuSample>::value, "");
  static_assert(std::is_standard_layout<gslam::GnssSample>::value, "");
  EXPECT_EQ(offsetof(gslam::ImuSample, gyro), 8U);
  EXPECT_EQ(offsetof(gslam::ImuSample, accel), 32U);
  EXPECT_EQ(offsetof(gslam::Geodetic, longitude), 8U);
  EXPECT_EQ(offsetof(gslam::Geodetic, altitude), 16U);
  EXPECT_EQ(offsetof(gslam::GnssSample, position), 8U);
  EXPECT_EQ(offsetof(gslam::GnssSample, covariance), 32U);
  EXPECT_EQ(offsetof(gslam::GnssSample, velocity), 104U);
  EXPECT_EQ(offsetof(gslam::GnssSample, fix), 128U);
  EXPECT_EQ(sizeof(gslam::GnssFix), 1U);
  EXPECT_EQ(static_cast<int>(gslam::GnssFix::rtk_fixed), 4);
}

}  // namespace
