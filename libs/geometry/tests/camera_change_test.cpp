// Every camera model in float, next to its axis, resized and cropped.
#include <cmath>

#include "camera_cases.h"

namespace {

using camera_cases::make;
using camera_cases::pixels;
using gslam::Vec2d;
using gslam::Vec3d;

template <class Case>
class CameraChange : public testing::Test {
 public:
  using Camera = typename Case::Double;
  CameraChange() : camera(make<Camera>(Case::values())) {}
  Camera camera;
};
TYPED_TEST_SUITE(CameraChange, camera_cases::All, );

TYPED_TEST(CameraChange, FloatIsTheSame) {
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

TYPED_TEST(CameraChange, TheAxisIsSeenExactly) {
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

TYPED_TEST(CameraChange, ResizedAndCroppedCamerasSeeTheSame) {
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

}  // namespace
