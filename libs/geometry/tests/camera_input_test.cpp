// What every camera model refuses, and what it keeps.
#include <cmath>
#include <string>

#include "camera_cases.h"
#include "not_finite.h"

namespace {

using camera_cases::make;
using gslam::Vec2d;
using gslam::Vec3d;

template <class Case>
class CameraInput : public testing::Test {
 public:
  using Camera = typename Case::Double;
  CameraInput() : camera(make<Camera>(Case::values())) {}
  Camera camera;
};
TYPED_TEST_SUITE(CameraInput, camera_cases::All, );

TYPED_TEST(CameraInput, ParametersAreKept) {
  const auto parameters = this->camera.parameters();
  ASSERT_EQ(parameters.size(), TypeParam::values().size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    EXPECT_EQ(parameters[i], TypeParam::values()[i]) << this->camera.parameterName(i);
  }
}

TYPED_TEST(CameraInput, WhatIsNotFiniteIsRefused) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3d point = {0.1, 0.2, 1};
      point[i] = bad;
      Vec2d pixel = {-7, -8};
      const bool is_seen = this->camera.project(point, pixel);
      // a pinhole sees the infinitely far point on its axis
      if (bad > 0 && i == 2 && is_seen) continue;
      EXPECT_FALSE(is_seen) << point << " at " << pixel;
      EXPECT_EQ(pixel, (Vec2d{-7, -8}));
    }
    for (std::size_t i = 0; i < 2; ++i) {
      Vec2d pixel = {100, 100};
      pixel[i] = bad;
      Vec3d bearing = {7, 8, 9};
      EXPECT_FALSE(this->camera.unproject(pixel, bearing)) << pixel;
      EXPECT_EQ(bearing, (Vec3d{7, 8, 9}));
    }
  }
}

TYPED_TEST(CameraInput, PointsWithoutDirectionAreRefused) {
  Vec2d pixel;
  EXPECT_FALSE(this->camera.project({0, 0, 0}, pixel));
  const bool sees_all = std::string(this->camera.name()) == "equirectangular";
  EXPECT_EQ(this->camera.project({0, 0, -1}, pixel), sees_all);
  EXPECT_FALSE(this->camera.project({0, sees_all ? 1.0 : 0.0, -0.0}, pixel));
}

TYPED_TEST(CameraInput, WrongParametersAreNamed) {
  using Double = typename TypeParam::Double;
  for (std::size_t i = 0; i < Double::parameterCount(); ++i) {
    for (const double bad : {kNan, kInfinity}) {
      std::vector<double> values = TypeParam::values();
      values[i] = bad;
      try {
        (void)make<Double>(values);
        ADD_FAILURE() << Double::parameterName(i) << " taken";
      } catch (const gslam::ArgumentError& error) {
        EXPECT_EQ(error.argument(), Double::parameterName(i));
      }
    }
  }
}

}  // namespace
