// Where camera models end, and what iterations do there.
#include <gslam/geometry/camera.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "camera_steps.h"

namespace {

using gslam::DoubleSphereCamera;
using gslam::KannalaBrandtCamera;
using gslam::OcamCamera;
using gslam::RadtanCamera;
using gslam::Vec2d;
using gslam::Vec3d;

using Radtan4 = RadtanCamera<double, 4>;
using Radtan8 = RadtanCamera<double, 8>;

TEST(CameraLimit, DistortionThatFoldsBack) {
  const Radtan4 camera({100, 100, 0, 0, -0.3, 0, 0, 0});  // d(r g)/dr = 1 - 0.9 r^2
  const double limit = std::sqrt(1 / 0.9);
  EXPECT_NEAR(camera.projection().maxRadius(), limit, 1e-12);
  Vec2d pixel;
  Vec3d bearing;
  EXPECT_TRUE(camera.project({limit - 1e-9, 0, 1}, pixel));
  EXPECT_FALSE(camera.project({limit + 1e-9, 0, 1}, pixel));
  EXPECT_FALSE(camera.project({1.5, 0, 1}, pixel));  // would be at 48.75, where 0.63 is, too
  const double end = 100 * limit * 2 / 3;
  EXPECT_TRUE(camera.unproject({end - 1e-6, 0}, bearing));
  EXPECT_FALSE(camera.unproject({end + 1e-6, 0}, bearing));
  EXPECT_FALSE(camera.unproject({500, 0}, bearing));
}

TEST(CameraLimit, DistortionThatNeverFolds) {
  const Radtan4 euroc({458.654, 457.296, 367.215, 248.375, -0.28340811, 0.07395907, 0, 0});
  EXPECT_EQ(euroc.projection().maxRadius(), std::numeric_limits<double>::infinity());
  // with tangential terms it folds where nobody looks
  const Radtan4 tangential({458.654, 457.296, 367.215, 248.375, 0, 0, 1e-4, 0});
  EXPECT_NEAR(tangential.projection().maxRadius(), 1 / 6e-4, 1e-6);
}

TEST(CameraLimit, PolesOfRationalDistortion) {
  const Radtan8 camera({100, 100, 0, 0, 0, 0, 0, 0, 0, -0.25, 0, 0});  // 1 / (1 - r^2 / 4)
  EXPECT_NEAR(camera.projection().maxRadius(), 2, 1e-12);
  Vec2d pixel;
  EXPECT_TRUE(camera.project({1.99, 0, 1}, pixel));
  EXPECT_FALSE(camera.project({2.01, 0, 1}, pixel));
}

// Inside the limit no two points share a pixel, whatever the coefficients are.
TEST(CameraLimit, DistortionIsOneToOneInsideItsLimit) {
  const std::vector<std::vector<double>> all = {
      {-0.3, 0.02, 0.02, -0.03}, {0.4, -0.6, 0.01, 0.05}, {-0.1, 0, 0.2, 0}, {-0.9, 0.9, 0, 0.1}};
  for (const std::vector<double>& k : all) {
    const Radtan4 camera({100, 100, 0, 0, k[0], k[1], k[2], k[3]});
    const double limit = std::min(camera.projection().maxRadius(), 3.0);
    ASSERT_GT(limit, 0.3);
    for (const double r : steps(0.02, limit, 0.02)) {
      for (const double phi : steps(0, 6.3, 0.2)) {
        const Vec2d point = {r * std::cos(phi), r * std::sin(phi)};
        Vec2d pixel;
        Vec3d bearing;
        gslam::Mat<double, 2, 3> j;
        ASSERT_TRUE(camera.project({point[0], point[1], 1}, pixel, &j));
        ASSERT_GT(j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0), 0);
        ASSERT_TRUE(camera.unproject(pixel, bearing)) << pixel;
        ASSERT_NEAR(bearing[0] / bearing[2], point[0], 1e-9);
        ASSERT_NEAR(bearing[1] / bearing[2], point[1], 1e-9);
      }
    }
  }
}

// An older implementation took 5 fixed-point steps without a look at the result, and gave (-1, -1)
// where it failed.
TEST(CameraLimit, DistortionThatFiveStepsDoNotUndo) {
  const Radtan4 camera({300, 300, 320, 240, -0.3, 0, 0.001, -0.002});
  Vec2d pixel;
  Vec3d bearing;
  const Vec3d point = {0.8, 0.6, 1};
  ASSERT_TRUE(camera.project(point, pixel));
  ASSERT_TRUE(camera.unproject(pixel, bearing));
  EXPECT_NEAR(bearing[0] / bearing[2], point[0], 1e-13);
  EXPECT_NEAR(bearing[1] / bearing[2], point[1], 1e-13);
  const Vec2d m = {(pixel[0] - 320) / 300, (pixel[1] - 240) / 300};
  Vec2d p = m;
  for (int i = 0; i < 5; ++i) {
    const double s = p.squaredNorm(), g = 1 - 0.3 * s;
    p = {(m[0] - 2 * 0.001 * p[0] * p[1] + 0.002 * (s + 2 * p[0] * p[0])) / g,
         (m[1] - 0.001 * (s + 2 * p[1] * p[1]) + 2 * 0.002 * p[0] * p[1]) / g};
  }
  EXPECT_GT((p - Vec2d{point[0], point[1]}).norm() * 300, 10) << "the old steps are good enough";
}

TEST(CameraLimit, AngleWhereAFisheyeStopsToGrow) {
  const KannalaBrandtCamera<double> camera({100, 100, 0, 0, -0.1, 0, 0, 0});  // 1 - 0.3 theta^2
  const double limit = std::sqrt(1 / 0.3);
  EXPECT_NEAR(camera.projection().maxAngle(), limit, 1e-12);
  Vec2d pixel;
  Vec3d bearing;
  EXPECT_TRUE(camera.project({std::sin(1.8), 0, std::cos(1.8)}, pixel));
  EXPECT_FALSE(camera.project({std::sin(1.9), 0, std::cos(1.9)}, pixel));
  EXPECT_TRUE(camera.unproject({100 * limit * 2 / 3 - 1e-6, 0}, bearing));
  EXPECT_FALSE(camera.unproject({100 * limit * 2 / 3 + 1e-6, 0}, bearing));
  const KannalaBrandtCamera<double> whole({100, 100, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(whole.project({1e-6, 0, -1}, pixel));
  EXPECT_TRUE(whole.unproject({0, 314.159}, bearing));
  EXPECT_FALSE(whole.unproject({0, 314.16}, bearing));
}

// The paper's bound on z / d1 ends more than a degree before the cone does.
TEST(CameraLimit, ConeOfTheDoubleSphere) {
  for (const Vec2d& p : {Vec2d{-0.2, 0.59}, Vec2d{-0.2, 0.4}, Vec2d{0.35, 0.31}, Vec2d{0.3, 0.7}}) {
    const double xi = p[0], alpha = p[1];
    const DoubleSphereCamera<double> camera({200, 200, 0, 0, xi, alpha});
    const double w1 = alpha > 0.5 ? (1 - alpha) / alpha : alpha / (1 - alpha);
    const double w2 = (w1 + xi) / std::sqrt(2 * w1 * xi + xi * xi + 1);
    const double published = std::acos(-w2);
    double angle = published - 0.05, last = 0;
    Vec2d pixel;
    Vec3d bearing;
    for (; camera.project({std::sin(angle), 0, std::cos(angle)}, pixel); angle += 1e-5) {
      ASSERT_GT(pixel[0], last);
      last = pixel[0];
      if (!camera.unproject(pixel, bearing)) continue;  // within rounding of the end
      ASSERT_NEAR(std::atan2(bearing[0], bearing[2]), angle, 1e-7);
    }
    EXPECT_GT(angle, published + 0.01);
    // beyond, the formula comes back to pixels that it had, or has none
    const auto formula = [&](double a) {
      const double x = std::sin(a), k = xi + std::cos(a), d2 = std::sqrt(x * x + k * k);
      return 200 * x / (alpha * d2 + (1 - alpha) * k);
    };
    EXPECT_LT(formula(angle + 1e-3), last);
  }
}

TEST(CameraLimit, PolynomialOfTheToolboxAgainstItsInverse) {
  // OCamCalib's example calibration; the inverse is a fit of the toolbox up to the corners of the
  // image.
  const OcamCamera<double> camera({326.939156, 261.744395, 1.001968, 0.001400, 0.000113,
                                   -3.258881e+02, 0, 8.612196e-04, -3.553896e-08, 6.737619e-09});
  const std::vector<double> inverse = {407.216320,   159.672870,   -53.191585,   -211.811262,
                                       -963.324864,  -2189.874282, -3125.470126, -2753.680698,
                                       -1427.890554, -398.461428,  -46.187761};
  double largest = 0;
  for (const double theta : steps(0.01, 1.51, 0.01)) {
    const double elevation = theta - 1.57079632679489661923;  // from the toolbox' plane z = 0
    double rho = 0, power = 1;
    for (const double b : inverse) {
      rho += b * power;
      power *= elevation;
    }
    for (const double phi : steps(0, 6.2, 0.5)) {
      const double right = std::cos(phi), down = std::sin(phi);
      const Vec2d expected = {0.000113 * rho * down + rho * right + 326.939156,
                              1.001968 * rho * down + 0.001400 * rho * right + 261.744395};
      Vec2d pixel;
      ASSERT_TRUE(camera.project({std::sin(theta) * right, std::sin(theta) * down, std::cos(theta)},
                                 pixel));
      largest = std::max(largest, (pixel - expected).norm());
    }
  }
  EXPECT_LT(largest, 0.004);
}

TEST(CameraLimit, AngleWhereAnOcamStopsToGrow) {
  // depth 100 - rho^2 / 100 ... the angle grows while 100 + a2 rho^2 > 0
  const OcamCamera<double> camera({0, 0, 1, 0, 0, -100, 0, -0.01, 0, 0});
  EXPECT_NEAR(camera.maxRadius(), 100, 1e-9);
  Vec2d pixel;
  Vec3d bearing;
  EXPECT_TRUE(camera.unproject({99.9, 0}, bearing));
  EXPECT_FALSE(camera.unproject({100.1, 0}, bearing));
  EXPECT_TRUE(camera.project({99, 0, 198.01}, pixel));
  EXPECT_FALSE(camera.project({1, 0, 1}, pixel));
}

// Close to the plane of the camera the derivatives overflow, where the pixel does not.
TEST(CameraLimit, DerivativesAreFiniteOrNone) {
  for (const char* model : {"pinhole", "radtan", "fov"}) {
    std::vector<double> values = {200, 200, 320, 240};
    if (model == std::string("radtan")) values.insert(values.end(), {0, 0, 0, 0});
    if (model == std::string("fov")) values.push_back(0.9);
    const gslam::Camera camera = gslam::Camera::fromParameters(model, 640, 480, values);
    for (const gslam::Vec3d& point : {gslam::Vec3d{0, 0, 1e-310}, gslam::Vec3d{1e-3, 0, 1e-160},
                                      gslam::Vec3d{1, 0, 1e-310}, gslam::Vec3d{0, 0, 1e-100}}) {
      gslam::Vec2d pixel;
      gslam::Mat<double, 2, 3> j;
      if (!camera.project(point, pixel, &j)) continue;
      for (const double value : j.values) EXPECT_TRUE(std::isfinite(value)) << model << point;
    }
  }
}

TEST(CameraLimit, ResizingThatLeavesTheRangeIsRefused) {
  const auto camera = gslam::Camera::fromParameters("pinhole", 2, 2, {1e305, 1e305, 0.5, 0.5});
  EXPECT_THROW(camera.scaled(1e6), gslam::ArgumentError);
}

}  // namespace
