// What holds for every camera model: there and back, resized and cropped.
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

TYPED_TEST(CameraContract, FloatIsTheSame) {
  using Float = typename TypeParam::Float;
  const Float narrow = make<Float>(TypeParam::values());
  for (const Vec2d& pixel : pixels<TypeParam>()) {
    Vec3d bearing;
    if (!this->camera.unproject(pixel, bearing)) continue;
    gslam::Vec3f rough;
    gslam::Vec2f back;
    // not the last pixels before a limit, where few digits decide
    Vec3d beyond;
    const Vec2d outward =
        pixel + (pixel - Vec2d{TypeParam::kWidth / 2., TypeParam::kHeight / 2.}) * 0.02;
    if (!this->camera.unproject(outward, beyond)) continue;
    ASSERT_TRUE(narrow.unproject({float(pixel[0]), float(pixel[1])}, rough)) << pixel;
    const Vec3d wide = {double(rough[0]), double(rough[1]), double(rough[2])};
    ASSERT_LE((wide - bearing).norm(), 2e-5) << pixel;
    ASSERT_TRUE(narrow.project(rough, back)) << pixel;
    ASSERT_LE((Vec2d{double(back[0]), double(back[1])} - pixel).norm(), 5e-3) << pixel;
  }
}

TYPED_TEST(CameraContract, TheAxisIsSeenExactly) {
  Vec2d centre, near;
  ASSERT_TRUE(this->camera.project({0, 0, 1}, centre));
  for (const double tiny : {1e-300, 1e-200, 1e-160, 1e-154, 1e-100, 1e-20, 1e-12}) {
    ASSERT_TRUE(this->camera.project({tiny, -tiny, 1}, near)) << tiny;
    ASSERT_LE((near - centre).norm(), 1e-9 * (1 + tiny * 1e12)) << tiny;
  }
  Vec3d bearing;
  ASSERT_TRUE(this->camera.unproject(centre, bearing));
  EXPECT_LE((bearing - Vec3d{0, 0, 1}).norm(), 1e-15);
}

TYPED_TEST(CameraContract, ResizedAndCroppedCamerasSeeTheSame) {
  for (const Vec2d& pixel : pixels<TypeParam>(37)) {
    Vec3d bearing;
    if (!this->camera.unproject(pixel, bearing)) continue;
    Vec2d resized, cropped;
    ASSERT_TRUE(this->camera.resized(0.5, 0.25).project(bearing, resized));
    EXPECT_NEAR(resized[0] + 0.5, (pixel[0] + 0.5) * 0.5, 1e-10);
    EXPECT_NEAR(resized[1] + 0.5, (pixel[1] + 0.5) * 0.25, 1e-10);
    ASSERT_TRUE(this->camera.cropped(40, -7).project(bearing, cropped));
    EXPECT_LE((cropped - pixel - Vec2d{-40, 7}).norm(), 1e-10);
    Vec3d again;
    ASSERT_TRUE(this->camera.resized(0.5, 0.25).unproject(resized, again));
    EXPECT_LE((again - bearing).norm(), 1e-12);
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
