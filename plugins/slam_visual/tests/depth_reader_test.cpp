#include "features/depth_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using gslam::Camera;
using gslam::CameraImage;
using gslam::Feature;
using gslam::Image;
using gslam::PixelType;
using gslam::SE3d;
using gslam::Vec3d;
using visual::DepthReader;
using visual::Eye;

Camera pinhole(int width = 64, int height = 48, double focal = 50) {
  return Camera::fromParameters("pinhole", width, height,
                                {focal, focal, (width - 1) / 2.0, (height - 1) / 2.0});
}

Eye eyeOf(const Camera& camera) {
  Eye eye;
  eye.kind = visual::SensorKind::rgbd;
  eye.camera = camera;
  eye.baseline = 0.1;
  eye.far = 4;
  return eye;
}

CameraImage depthImageOf(const Camera& camera, PixelType type, double metres) {
  CameraImage image;
  image.kind = gslam::ImageKind::depth;
  image.name = "depth";
  image.camera = camera;
  image.depth_scale = type == PixelType::u16 ? 0.001 : 1;
  image.image = Image(camera.width(), camera.height(), type);
  for (int y = 0; y < camera.height(); ++y) {
    for (int x = 0; x < camera.width(); ++x) {
      if (type == PixelType::u16) {
        image.image.at<std::uint16_t>(x, y) = std::uint16_t(std::lround(1000 * metres));
      } else {
        image.image.at<float>(x, y) = float(metres);
      }
    }
  }
  return image;
}

Feature featureAt(float u, float v) {
  Feature feature;
  feature.pixel = {u, v};
  return feature;
}

float depthAt(DepthReader& reader, const CameraImage& image, float u, float v) {
  std::vector<float> depth, right_u;
  std::string problem;
  EXPECT_TRUE(reader.accepts(image, problem)) << problem;
  reader.read(image, {featureAt(u, v)}, depth, right_u);
  EXPECT_EQ(std::isnan(right_u[0]), !(depth[0] > 0));
  return depth[0];
}

TEST(DepthReader, ReadsTheNearestPixelAndWhereTheSecondCameraSeesIt) {
  const Camera camera = pinhole();
  DepthReader reader(eyeOf(camera), camera, SE3d());
  for (PixelType type : {PixelType::u16, PixelType::f32}) {
    CameraImage image = depthImageOf(camera, type, 2);
    std::vector<float> depth, right_u;
    reader.read(image, {featureAt(10.3F, 20), featureAt(0, 0), featureAt(63.4F, 47.4F)}, depth,
                right_u);
    EXPECT_NEAR(depth[0], 2, 1e-6);
    EXPECT_NEAR(right_u[0], 10.3 - 50 * 0.1 / 2, 1e-4);
    EXPECT_NEAR(depth[1], 2, 1e-6);
    EXPECT_NEAR(depth[2], 2, 1e-6);
  }
}

TEST(DepthReader, APixelIsAsWideAsItIs) {
  const Camera camera = pinhole();
  DepthReader reader(eyeOf(camera), camera, SE3d());
  CameraImage image = depthImageOf(camera, PixelType::f32, 2);
  image.image.at<float>(20, 10) = 2.1F;
  EXPECT_EQ(depthAt(reader, image, 20.45F, 9.55F), 2.1F);
  EXPECT_EQ(depthAt(reader, image, 20.55F, 10), 2);
}

TEST(DepthReader, AHoleIsFilledFromBesideAndAnEdgeIsNoDepth) {
  const Camera camera = pinhole();
  DepthReader reader(eyeOf(camera), camera, SE3d());
  CameraImage image = depthImageOf(camera, PixelType::f32, 2);
  image.image.at<float>(20, 10) = 0;
  EXPECT_EQ(depthAt(reader, image, 20, 10), 2);
  image.image.at<float>(20, 10) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(depthAt(reader, image, 20, 10), 2);
  image.image.at<float>(20, 10) = std::numeric_limits<float>::infinity();
  EXPECT_EQ(depthAt(reader, image, 20, 10), 2);
  image.image.at<float>(20, 10) = -1;
  EXPECT_EQ(depthAt(reader, image, 20, 10), 2);
  image.image.at<float>(21, 10) = 3;
  EXPECT_EQ(depthAt(reader, image, 20, 10), 0);  // 2 or 3?
  EXPECT_EQ(depthAt(reader, image, 22, 10), 0);
  EXPECT_EQ(depthAt(reader, image, 24, 10), 2);
  const CameraImage nothing = depthImageOf(camera, PixelType::u16, 0);
  EXPECT_EQ(depthAt(reader, nothing, 20, 10), 0);
}

// A wall before a camera that stands beside the eye, turned, with another lens.
TEST(DepthReader, AnotherCameraIsProjected) {
  const Camera camera = pinhole(64, 48, 50);
  for (const Camera& other : {pinhole(64, 48, 45), pinhole(32, 24, 25), pinhole(160, 120, 120)}) {
    const SE3d T_eye_depth(gslam::SO3d::exp({0.02, -0.05, 0.1}), Vec3d{0.03, -0.01, 0.02});
    CameraImage image = depthImageOf(other, PixelType::f32, 0);
    // The wall z = 2 + 0.1 x in the eye.
    const Vec3d normal = {-0.1, 0, 1};
    for (int y = 0; y < other.height(); ++y) {
      for (int x = 0; x < other.width(); ++x) {
        Vec3d bearing;
        ASSERT_TRUE(other.unproject({double(x), double(y)}, bearing));
        const Vec3d way = T_eye_depth.rotation() * bearing;
        const double length = (2 - normal.dot(T_eye_depth.translation())) / normal.dot(way);
        image.image.at<float>(x, y) = float(length * bearing[2]);
      }
    }
    DepthReader reader(eyeOf(camera), other, T_eye_depth);
    std::vector<Feature> features;
    for (float v = 12; v < 36; v += 3) {
      for (float u = 16; u < 48; u += 3) features.push_back(featureAt(u, v));
    }
    std::vector<float> depth, right_u;
    reader.read(image, features, depth, right_u);
    int found = 0;
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (!(depth[i] > 0)) continue;
      ++found;
      const double x = (double(features[i].pixel[0]) - 31.5) / 50;
      EXPECT_NEAR(double(depth[i]), 2 / (1 - 0.1 * x), 0.02);
    }
    EXPECT_GT(found, int(features.size()) * 95 / 100) << other;
  }
}

TEST(DepthReader, WhatIsBehindIsNotSeen) {
  const Camera camera = pinhole();
  const SE3d beside(gslam::SO3d(), Vec3d{0.2, 0, 0});
  DepthReader reader(eyeOf(camera), camera, beside);
  CameraImage image = depthImageOf(camera, PixelType::f32, 4);
  for (int y = 0; y < 48; ++y) {
    for (int x = 20; x < 40; ++x) image.image.at<float>(x, y) = 1;  // 10 to the right in the eye
  }
  EXPECT_EQ(depthAt(reader, image, 40, 24), 1);
  EXPECT_EQ(depthAt(reader, image, 60, 24), 4);
}

TEST(DepthReader, WhatCannotBeUsedIsNamed) {
  const Camera camera = pinhole();
  const DepthReader reader(eyeOf(camera), camera, SE3d());
  std::string problem;
  CameraImage image = depthImageOf(camera, PixelType::u16, 1);
  image.depth_scale = 0;
  EXPECT_FALSE(reader.accepts(image, problem));
  EXPECT_EQ(problem,
            "the image of camera 'depth' has no scale of depth, expected metres for a number");
  image = depthImageOf(pinhole(10, 10), PixelType::u16, 1);
  EXPECT_FALSE(reader.accepts(image, problem));
  EXPECT_EQ(problem, "the image of camera 'depth' is 10 x 10 u16, expected 64 x 48 u16 or f32");
  image.image = Image();
  EXPECT_FALSE(reader.accepts(image, problem));
  image.kind = gslam::ImageKind::grey;
  EXPECT_FALSE(reader.accepts(image, problem));
}

}  // namespace
