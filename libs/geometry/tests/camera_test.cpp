// Camera: any model behind one type.
#include <gmock/gmock.h>
#include <gslam/geometry/camera.h>

#include <cmath>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "refusal.h"

namespace {

using gslam::Camera;
using gslam::Span;
using gslam::Vec2d;
using gslam::Vec3d;
using testing::ElementsAre;
using testing::HasSubstr;

const double kPi = 3.14159265358979323846;

static_assert(std::is_trivially_copyable<Camera>::value, "may be copied byte by byte");
static_assert(std::is_standard_layout<Camera>::value, "may cross the border to a plugin");
static_assert(sizeof(Camera) == 400, "the layout is fixed");

std::string cameraRefusal(const std::string& model, int width, int height,
                          const std::vector<double>& values) {
  return refusal([&] { (void)Camera::fromParameters(model, width, height, values); });
}

TEST(Camera, NoCameraSeesNothing) {
  const Camera none;
  Vec2d pixel = {3, 4};
  Vec3d bearing = {5, 6, 7};
  EXPECT_FALSE(none.isValid());
  EXPECT_FALSE(none.project({0, 0, 1}, pixel));
  EXPECT_FALSE(none.unproject({0, 0}, bearing));
  EXPECT_EQ(pixel, (Vec2d{3, 4}));
  EXPECT_EQ(bearing, (Vec3d{5, 6, 7}));
  EXPECT_EQ(none.width(), 0);
  EXPECT_EQ(none.modelName(), "");
  EXPECT_TRUE(none.parameters().empty());
  EXPECT_FALSE(none.isInImage({0, 0}));
  std::vector<std::uint8_t> is_valid = {1};
  EXPECT_EQ(none.projectMany(std::vector<Vec3d>(1), Span<Vec2d>(&pixel, 1), is_valid), 0U);
  EXPECT_EQ(is_valid[0], 0);
  EXPECT_EQ(none.unprojectMany(std::vector<Vec2d>(1), Span<Vec3d>(&bearing, 1), is_valid), 0U);
  EXPECT_THAT(refusal([&] { (void)none.scaled(0.5); }), HasSubstr("camera is none"));
  EXPECT_EQ(none, Camera());
  EXPECT_NE(none, Camera::fromParameters("pinhole", 4, 3, {1, 1, 0, 0}));
}

TEST(Camera, NamesAndNumbers) {
  EXPECT_THAT(Camera::modelNames(),
              ElementsAre("pinhole", "radtan", "kannala_brandt", "fov", "ocam", "double_sphere",
                          "eucm", "ucm", "mei", "equirectangular", "orthographic"));
  const Camera camera = Camera::fromParameters("double_sphere", 640, 480, {1, 2, 3, 4, .5, .6});
  EXPECT_THAT(camera.parameterNames(), ElementsAre("fx", "fy", "cx", "cy", "xi", "alpha"));
  EXPECT_EQ(camera.parameter("alpha"), 0.6);
  EXPECT_THAT(refusal([&] { (void)camera.parameter("k1"); }),
              HasSubstr("name is \"k1\", expected a parameter of double_sphere: fx fy cx cy xi"));
  std::ostringstream text;
  text << camera;
  EXPECT_EQ(text.str(), "double_sphere 640 x 480 fx 1 fy 2 cx 3 cy 4 xi 0.5 alpha 0.6");
}

TEST(Camera, OtherNamesOfModels) {
  const std::vector<double> values = {1, 1, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(Camera::fromParameters("equidistant", 4, 3, values).modelName(), "kannala_brandt");
  EXPECT_EQ(Camera::fromParameters("fisheye", 4, 3, values).modelName(), "kannala_brandt");
  EXPECT_EQ(Camera::fromParameters("atan", 4, 3, {1, 1, 0, 0, 0.9}).modelName(), "fov");
}

TEST(Camera, WhatIsRefused) {
  const double nan = std::nan("");
  EXPECT_THAT(cameraRefusal("pinhoel", 4, 3, {1, 1, 0, 0}),
              HasSubstr("model is \"pinhoel\", expected one of pinhole, radtan, kannala_brandt, "));
  EXPECT_EQ(cameraRefusal("pinhole", 4, 3, {1, 1, 0}),
            "values are 3 numbers, expected 4 for pinhole: fx fy cx cy");
  EXPECT_THAT(
      cameraRefusal("radtan", 4, 3, {1, 1, 0}),
      HasSubstr("expected 8 or 9 or 12 or 16 or 18 for radtan: fx fy cx cy k1 k2 p1 p2 k3"));
  EXPECT_EQ(cameraRefusal("pinhole", 0, 3, {1, 1, 0, 0}), "width is 0, expected 1 pixel or more");
  EXPECT_EQ(cameraRefusal("pinhole", 4, -3, {1, 1, 0, 0}),
            "height is -3, expected 1 pixel or more");
  EXPECT_EQ(cameraRefusal("pinhole", 4, 3, {-1, 1, 0, 0}),
            "fx is -1, expected a positive number of pixels");
  EXPECT_EQ(cameraRefusal("pinhole", 4, 3, {1, 0, 0, 0}),
            "fy is 0, expected a positive number of pixels");
  EXPECT_EQ(cameraRefusal("pinhole", 4, 3, {1, 1, nan, 0}), "cx is nan, expected a finite number");
  EXPECT_EQ(cameraRefusal("fov", 4, 3, {1, 1, 0, 0, 3.2}),
            "w is 3.2, expected 0 or more and less than pi");
  EXPECT_EQ(cameraRefusal("ucm", 4, 3, {1, 1, 0, 0, 1.5}), "alpha is 1.5, expected 0 to 1");
  EXPECT_EQ(cameraRefusal("eucm", 4, 3, {1, 1, 0, 0, 0.5, 0}),
            "beta is 0, expected a positive number");
  EXPECT_EQ(cameraRefusal("double_sphere", 4, 3, {1, 1, 0, 0, 1, 0.5}),
            "xi is 1, expected more than -1 and less than 1");
  EXPECT_EQ(cameraRefusal("mei", 4, 3, {1, 1, 0, 0, -0.1, 0, 0, 0, 0}),
            "xi is -0.1, expected 0 or more");
  EXPECT_EQ(cameraRefusal("ocam", 4, 3, {2, 1, 1, 0, 0, 300, 0, 0, 0, 0}),
            "a0 is 300, expected a negative number of pixels");
  EXPECT_EQ(cameraRefusal("ocam", 4, 3, {2, 1, 0, 0, 0, -300, 0, 0, 0, 0}),
            "c is 0, expected more than d e");
  std::vector<double> tilted(18);
  tilted[0] = tilted[1] = 300;
  tilted[16] = 1.6;
  EXPECT_EQ(cameraRefusal("radtan", 4, 3, tilted), "taux is 1.6, expected an angle below pi / 2");
}

TEST(Camera, NamedParametersThatAreMissing) {
  const auto named = [](const std::map<std::string, double>& values) {
    return refusal([&] { (void)Camera::fromNamedParameters("pinhole", 4, 3, values); });
  };
  EXPECT_EQ(named({{"fx", 1}, {"fy", 1}, {"cx", 1}, {"cy", 1}}), "taken");
  EXPECT_EQ(named({{"fx", 1}, {"fy", 1}, {"cx", 1}, {"xi", 1}}),
            "cy is missing, expected pinhole: fx fy cx cy");
  EXPECT_EQ(named({{"fx", 1}}), "values are 1 numbers, expected 4 for pinhole: fx fy cx cy");
}

TEST(Camera, BatchesOfOtherSizesAreRefused) {
  const Camera camera = Camera::fromParameters("pinhole", 4, 3, {1, 1, 0, 0});
  std::vector<Vec3d> points(3);
  std::vector<Vec2d> pixels(2);
  std::vector<std::uint8_t> is_valid(3);
  EXPECT_EQ(refusal([&] { (void)camera.projectMany(points, pixels, is_valid); }),
            "pixels has 2 elements, expected 3, one for each that is given");
  EXPECT_EQ(
      refusal([&] { (void)camera.unprojectMany(pixels, Span<Vec3d>(points.data(), 2), is_valid); }),
      "is_valid has 3 elements, expected 2, one for each that is given");
}

TEST(Camera, FieldOfViewOfAPinhole) {
  const Camera camera = Camera::fromParameters("pinhole", 640, 480, {320, 240, 319.5, 239.5});
  const gslam::FieldOfView view = camera.fieldOfView();
  EXPECT_NEAR(view.horizontal, kPi / 2, 1e-14);
  EXPECT_NEAR(view.vertical, kPi / 2, 1e-14);
  EXPECT_NEAR(view.diagonal, 2 * std::atan(std::sqrt(2.0)), 1e-14);
  // what is left of the principal point
  EXPECT_NEAR(camera.cropped(0, 0, 320, 480).fieldOfView().horizontal, kPi / 4, 1e-14);
  EXPECT_NEAR(camera.cropped(0, 0, 160, 480).fieldOfView().horizontal, kPi / 4 - std::atan(0.5),
              1e-14);
  EXPECT_NEAR(camera.scaled(0.25).fieldOfView().diagonal, view.diagonal, 1e-14);
}

TEST(Camera, FieldOfViewBeyondHalfATurn) {
  const gslam::FieldOfView sphere =
      Camera::fromParameters("equirectangular", 1920, 960, {}).fieldOfView();
  EXPECT_NEAR(sphere.horizontal, 2 * kPi, 1e-9);
  EXPECT_NEAR(sphere.vertical, kPi, 1e-9);
  // equidistant, 100 pixels per radian; the image ends at 2 radians, or never
  const std::vector<double> fisheye = {100, 100, 199.5, 199.5, 0, 0, 0, 0};
  EXPECT_NEAR(Camera::fromParameters("fisheye", 400, 400, fisheye).fieldOfView().horizontal, 4,
              1e-12);
  EXPECT_NEAR(Camera::fromParameters("fisheye", 400, 400, fisheye).fieldOfView().diagonal,
              4 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(Camera::fromParameters("fisheye", 400, 400, {50, 50, 199.5, 199.5, 0, 0, 0, 0})
                  .fieldOfView()
                  .horizontal,
              2 * kPi, 1e-9);
}

TEST(Camera, SizesAfterResizingAndCropping) {
  const Camera camera = Camera::fromParameters("pinhole", 1226, 370, {700, 700, 600, 180});
  EXPECT_EQ(camera.scaled(0.25).width(), 307);  // 306.5
  EXPECT_EQ(camera.scaled(0.25).parameter("fx"), 175);
  EXPECT_EQ(camera.resized(613, 185), camera.scaled(0.5));
  EXPECT_EQ(camera.resized(1226, 740).parameter("fx"), 700);
  EXPECT_EQ(camera.resized(1226, 740).parameter("fy"), 1400);
  EXPECT_EQ(camera.resized(1226, 740).parameter("cy"), 360.5);
  EXPECT_EQ(camera.cropped(10, 20, 100, 90),
            Camera::fromParameters("pinhole", 100, 90, {700, 700, 590, 160}));
  EXPECT_THAT(refusal([&] { (void)camera.scaled(0); }), HasSubstr("factor is 0, expected"));
  EXPECT_THAT(refusal([&] { (void)camera.scaled(1e-9); }), HasSubstr("one that leaves an image"));
  EXPECT_THAT(refusal([&] { (void)camera.scaled(1e8); }), HasSubstr("one that leaves an image"));
  EXPECT_THAT(refusal([&] { (void)camera.scaled(std::nan("")); }), HasSubstr("factor is nan"));
  EXPECT_THAT(refusal([&] { (void)camera.cropped(0, 0, 0, 1); }), HasSubstr("width is 0"));
}

TEST(Camera, PixelsOfTheImage) {
  const Camera camera = Camera::fromParameters("pinhole", 4, 3, {1, 1, 0, 0});
  EXPECT_TRUE(camera.isInImage({-0.5, -0.5}));
  EXPECT_TRUE(camera.isInImage({3.49, 2.49}));
  EXPECT_FALSE(camera.isInImage({3.5, 0}));
  EXPECT_FALSE(camera.isInImage({0, 2.5}));
  EXPECT_FALSE(camera.isInImage({-0.51, 0}));
  EXPECT_FALSE(camera.isInImage({std::nan(""), 0}));
}

}  // namespace
