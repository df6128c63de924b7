// What holds for every camera model: there and back.
#include <cmath>

#include "camera_cases.h"

namespace {

using camera_cases::make;
using camera_cases::pixels;
using gslam::Vec2d;
using gslam::Vec3d;

template <class Case>
class CameraContract : public testing::Test {
 public:
  using Camera = typename Case::Double;
  CameraContract() : camera(make<Camera>(Case::values())) {}
  Camera camera;
};
TYPED_TEST_SUITE(CameraContract, camera_cases::All, );

TYPED_TEST(CameraContract, PixelsComeBack) {
  std::size_t seen = 0, all = 0;
  for (const Vec2d& pixel : pixels<TypeParam>(5)) {
    ++all;
    Vec3d bearing;
    if (!this->camera.unproject(pixel, bearing)) continue;
    ++seen;
    ASSERT_NEAR(bearing.norm(), 1, 4e-16);
    for (const double distance : {1.0, 0.013, 4711.0}) {
      Vec2d back;
      ASSERT_TRUE(this->camera.project(bearing * distance, back)) << pixel;
      ASSERT_LE((back - pixel).norm(), 1e-10) << pixel;
    }
  }
  EXPECT_GE(double(seen), 0.7 * double(all));
}

TYPED_TEST(CameraContract, BearingsComeBack) {
  for (const Vec2d& pixel : pixels<TypeParam>()) {
    Vec3d bearing, back;
    Vec2d projected;
    if (!this->camera.unproject(pixel, bearing)) continue;
    ASSERT_TRUE(this->camera.project(bearing, projected));
    ASSERT_TRUE(this->camera.unproject(projected, back)) << pixel;
    ASSERT_LE((back - bearing).norm(), 2e-13) << pixel;
  }
}

// Where a point is seen, its pixel has that direction: no two directions share a pixel.
TYPED_TEST(CameraContract, NoTwoDirectionsShareAPixel) {
  std::size_t seen = 0;
  for (int longitude = -180; longitude < 180; longitude += 7) {
    for (int theta = 1; theta < 180; theta += 2) {
      const double a = longitude * 0.017453292519943295, t = theta * 0.017453292519943295;
      const Vec3d bearing = {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
      Vec2d pixel;
      Vec3d back;
      if (!this->camera.project(bearing, pixel)) continue;
      ++seen;
      ASSERT_TRUE(this->camera.unproject(pixel, back)) << bearing << " at " << pixel;
      ASSERT_LE((back - bearing).norm(), 1e-9) << bearing << " at " << pixel;
    }
  }
  EXPECT_GT(seen, 500U);
}

}  // namespace
