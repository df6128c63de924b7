// Camera models that are others for some parameters: formulas checked by formulas.
#include <gslam/geometry/camera.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "camera_steps.h"

namespace {

using gslam::Camera;
using gslam::Vec2d;
using gslam::Vec3d;

Camera cameraOf(const char* model, const std::vector<double>& values) {
  return Camera::fromParameters(model, 640, 480, values);
}

// Both see the same points at the same pixels, and have the same bearings.
void expectSame(const Camera& a, const Camera& b, double max_angle, double tolerance = 1e-10) {
  int seen = 0;
  for (const double theta : steps(0, 3.14, 0.07)) {
    for (const double phi : steps(-3, 3, 0.43)) {
      const Vec3d point = {3 * std::sin(theta) * std::cos(phi), 3 * std::sin(theta) * std::sin(phi),
                           3 * std::cos(theta)};
      Vec2d p, q;
      Vec3d u, v;
      ASSERT_EQ(a.project(point, p), b.project(point, q)) << a << "\n" << b << "\n" << point;
      if (!a.project(point, p) || theta > max_angle) continue;
      ++seen;
      ASSERT_LE((p - q).norm(), tolerance) << point;
      ASSERT_TRUE(a.unproject(p, u));
      ASSERT_TRUE(b.unproject(p, v));
      ASSERT_LE((u - v).norm(), tolerance);
    }
  }
  EXPECT_GT(seen, 100);
}

TEST(CameraRelation, UnifiedCamerasOfOneSphere) {
  for (const double alpha : {0.0, 0.2, 0.5, 0.7, 1.0}) {
    const Camera ucm = cameraOf("ucm", {300, 310, 320, 240, alpha});
    expectSame(ucm, cameraOf("eucm", {300, 310, 320, 240, alpha, 1}), 1.5);
    expectSame(ucm, cameraOf("double_sphere", {300, 310, 320, 240, 0, alpha}), 1.5);
  }
}

TEST(CameraRelation, MirrorAndUnifiedCamera) {
  for (const double xi : {0.0, 0.4, 1.0, 1.7}) {
    const double alpha = xi / (1 + xi), f = 400 / (1 + xi);
    expectSame(cameraOf("mei", {400, 400, 320, 240, xi, 0, 0, 0, 0}),
               cameraOf("ucm", {f, f, 320, 240, alpha}), 1.5);
  }
}

TEST(CameraRelation, FirstSphereAlone) {
  for (const double xi : {0.0, 0.3, 0.9}) {
    expectSame(cameraOf("double_sphere", {400, 390, 320, 240, xi, 0}),
               cameraOf("mei", {400, 390, 320, 240, xi, 0, 0, 0, 0}), 1.5);
  }
}

TEST(CameraRelation, WithoutDistortionAllArePinholes) {
  const Camera pinhole = cameraOf("pinhole", {300, 310, 320, 240});
  for (const std::size_t count : {4U, 5U, 8U, 12U, 14U}) {
    std::vector<double> values = {300, 310, 320, 240};
    values.resize(4 + count);
    expectSame(pinhole, cameraOf("radtan", values), 1.5);
  }
  expectSame(pinhole, cameraOf("fov", {300, 310, 320, 240, 0}), 1.5);
  expectSame(pinhole, cameraOf("fov", {300, 310, 320, 240, 1e-9}), 1.5);
  expectSame(pinhole, cameraOf("fov", {300, 310, 320, 240, 5e-324}), 1.5);
  expectSame(pinhole, cameraOf("ucm", {300, 310, 320, 240, 0}), 1.5);
  expectSame(pinhole, cameraOf("eucm", {300, 310, 320, 240, 0, 1.3}), 1.5);
  expectSame(pinhole, cameraOf("mei", {300, 310, 320, 240, 0, 0, 0, 0, 0}), 1.5);
  expectSame(pinhole, cameraOf("ocam", {320, 240, 310. / 300, 0, 0, -300, 0, 0, 0, 0}), 1.5);
}

TEST(CameraRelation, RadtanModelsContainEachOther) {
  std::vector<double> values = {300, 310, 320, 240, -0.2, 0.05, 0.001, -0.002};
  const Camera four = cameraOf("radtan", values);
  for (const std::size_t count : {5U, 8U, 12U, 14U}) {
    values.resize(4 + count);
    expectSame(four, cameraOf("radtan", values), 1.2);
  }
  values.resize(8);
  values.insert(values.begin() + 4, 0.0);  // xi
  expectSame(four, cameraOf("mei", values), 1.2);
}

// Radial models at which the angle can be read off.
TEST(CameraRelation, AngleAndDistance) {
  const Camera equidistant = cameraOf("kannala_brandt", {100, 100, 0, 0, 0, 0, 0, 0});
  const Camera orthographic = cameraOf("orthographic", {100, 100, 0, 0});
  const Camera panorama = cameraOf("equirectangular", {100, 100, 0, 0});
  for (const double t : {1e-9, 0.1, 0.7, 1.5}) {
    const Vec3d point = {0, 7 * std::sin(t), 7 * std::cos(t)};
    Vec2d pixel;
    ASSERT_TRUE(equidistant.project(point, pixel));
    EXPECT_NEAR(pixel[1], 100 * t, 1e-13);
    ASSERT_TRUE(orthographic.project(point, pixel));
    EXPECT_NEAR(pixel[1], 100 * std::sin(t), 1e-13);
    ASSERT_TRUE(panorama.project(point, pixel));
    EXPECT_NEAR(pixel[1], 100 * t, 1e-13);
  }
}

TEST(CameraRelation, DirectionsOfAPanorama) {
  const Camera camera = Camera::fromParameters("equirectangular", 1920, 960, {});
  Vec2d pixel;
  ASSERT_TRUE(camera.project({0, 0, 5}, pixel));
  EXPECT_LE((pixel - Vec2d{959.5, 479.5}).norm(), 1e-12);
  ASSERT_TRUE(camera.project({2, 0, 0}, pixel));  // right
  EXPECT_LE((pixel - Vec2d{1439.5, 479.5}).norm(), 1e-12);
  ASSERT_TRUE(camera.project({0, 3, 3}, pixel));  // down
  EXPECT_LE((pixel - Vec2d{959.5, 719.5}).norm(), 1e-12);
  EXPECT_FALSE(camera.project({0, 1, 0}, pixel));  // a pole
}

}  // namespace
