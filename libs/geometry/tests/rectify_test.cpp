// rectifyStereo(): rows become equal, and nothing unseen is shown.
#include <gmock/gmock.h>
#include <gslam/geometry/rectify.h>
#include <gslam/geometry/undistort.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "refusal.h"

namespace {

using gslam::Camera;
using gslam::SO3d;
using gslam::StereoRectification;
using gslam::Vec2d;
using gslam::Vec3d;
using testing::HasSubstr;

Camera left() {
  return Camera::fromParameters(
      "radtan", 752, 480,
      {458.654, 457.296, 367.215, 248.375, -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05});
}
Camera right() {
  return Camera::fromParameters(
      "radtan", 752, 480,
      {457.587, 456.134, 379.999, 255.238, -0.28368365, 0.07451284, -0.00010473, -3.555907e-05});
}
Camera fisheye() {
  return Camera::fromParameters(
      "kannala_brandt", 512, 512,
      {190.978, 190.973, 254.931, 256.897, 0.00348, 0.000715, -0.00205, 0.000203});
}

// Seen from both sides, points have one row (or column), and the disparity of their depth.
void expectRectified(const StereoRectification& r, const SO3d& R_left_right,
                     const Vec3d& t_left_right) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> xy(-2, 2), depth(0.5, 20);
  const std::size_t across = r.is_vertical ? 0 : 1, along = r.is_vertical ? 1 : 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3d rectified = {xy(random), xy(random), depth(random)};
    const Vec3d p_left = r.R_rectified_left.transpose() * rectified;
    const Vec3d p_right = R_left_right.inverse() * (p_left - t_left_right);
    Vec2d a, b;
    const Vec3d in_right = r.R_rectified_right * p_right;
    ASSERT_TRUE(r.camera.project(r.R_rectified_left * p_left, a));
    ASSERT_TRUE(r.camera.project(in_right, b));
    ASSERT_NEAR(a[across], b[across], 1e-9);
    ASSERT_NEAR(a[along] - b[along], r.camera.parameter("fx") * r.baseline / rectified[2], 1e-9);
    ASSERT_NEAR(in_right[2], rectified[2], 1e-13 * rectified[2]);
  }
}

void expectAllSeen(const StereoRectification& r, const Camera& a, const Camera& b) {
  for (const bool is_left : {true, false}) {
    const gslam::Mat3d& rotation = is_left ? r.R_rectified_left : r.R_rectified_right;
    const gslam::Undistorter undistorter(is_left ? a : b, r.camera, rotation.transpose());
    const gslam::Span<const std::uint8_t> mask = undistorter.mask();
    EXPECT_EQ(std::count(mask.begin(), mask.end(), 0), 0);
  }
}

TEST(Rectify, SideBySide) {
  const SO3d R = SO3d::exp({0.02, -0.014, 0.005});
  const Vec3d t = {0.11, -0.0004, 0.0006};
  const StereoRectification r = rectifyStereo(left(), right(), R, t);
  EXPECT_FALSE(r.is_vertical);
  EXPECT_NEAR(r.baseline, t.norm(), 1e-15);
  EXPECT_EQ(r.camera.width(), 752);
  EXPECT_EQ(r.camera.height(), 480);
  expectRectified(r, R, t);
  expectAllSeen(r, left(), right());
}

TEST(Rectify, TheOtherSideAndAboveEachOther) {
  const SO3d R = SO3d::exp({0.03, 0.04, -0.02});
  for (const Vec3d& t : {Vec3d{-0.2, 0.01, 0.02}, Vec3d{0.01, 0.3, -0.01}, Vec3d{0.02, -0.3, 0}}) {
    const StereoRectification r = rectifyStereo(left(), right(), R, t);
    EXPECT_EQ(r.is_vertical, std::fabs(t[1]) > 0.1);
    EXPECT_EQ(r.baseline < 0, t[0] < -0.1 || t[1] < -0.1);
    expectRectified(r, R, t);
    expectAllSeen(r, left(), right());
  }
}

TEST(Rectify, FisheyesAndOtherSizes) {
  const SO3d R = SO3d::exp({0.01, 0.04, -0.02});
  const Vec3d t = {0.1, 0.002, 0.001};
  gslam::RectifyOptions options;
  options.width = 640;
  options.height = 400;
  const StereoRectification r = rectifyStereo(fisheye(), fisheye(), R, t, options);
  EXPECT_EQ(r.camera.width(), 640);
  EXPECT_EQ(r.camera.height(), 400);
  expectRectified(r, R, t);
  expectAllSeen(r, fisheye(), fisheye());
  options.focal = 200;
  EXPECT_EQ(rectifyStereo(fisheye(), fisheye(), R, t, options).camera.parameter("fx"), 200);
}

// What is rectified already stays as it is.
TEST(Rectify, NothingToTurn) {
  const Camera camera = Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5});
  const StereoRectification r = rectifyStereo(camera, camera, SO3d::identity(), {0.12, 0, 0});
  EXPECT_EQ(r.R_rectified_left, gslam::Mat3d::identity());
  EXPECT_EQ(r.R_rectified_right, gslam::Mat3d::identity());
  EXPECT_NEAR(r.camera.parameter("fx"), 500, 1e-6);
  EXPECT_NEAR(r.camera.parameter("cx"), 319.5, 1e-9);
}

TEST(Rectify, WhatIsRefused) {
  const Vec3d t = {0.1, 0, 0};
  const SO3d none = SO3d::identity();
  EXPECT_THAT(refusal([&] { rectifyStereo(Camera(), right(), none, t); }),
              HasSubstr("left is no camera"));
  EXPECT_THAT(refusal([&] { rectifyStereo(left(), Camera(), none, t); }),
              HasSubstr("right is no camera"));
  EXPECT_THAT(refusal([&] {
                rectifyStereo(left(), right(), none, {0, 0, 0});
              }),
              HasSubstr("t_left_right is 0, expected a baseline"));
  EXPECT_THAT(refusal([&] {
                rectifyStereo(left(), right(), none, {std::nan(""), 0, 0});
              }),
              HasSubstr("t_left_right is nan, expected a baseline"));
  EXPECT_THAT(refusal([&] {
                rectifyStereo(left(), right(), none, {0.01, 0, 1});
              }),
              HasSubstr("looks away"));
  EXPECT_THAT(refusal([&] {
                rectifyStereo(left(), right(), SO3d::exp({0, 3, 0}), t);
              }),
              HasSubstr("camera looks away from the common axis"));
  gslam::RectifyOptions options;
  options.focal = -1;
  EXPECT_THAT(refusal([&] { rectifyStereo(left(), right(), none, t, options); }),
              HasSubstr("focal is -1, expected 0, or"));
}

}  // namespace
