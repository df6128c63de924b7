// Rectification of EuRoC's stereo camera against the rotations that stella_vslam publishes for it.
#include <gslam/geometry/rectify.h>
#include <gslam/svar.h>
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <string>

#include "calibrations.h"
#include "test_data.h"

namespace {

using gslam::Camera;
using gslam::Mat3d;
using gslam::SO3d;
using gslam::Svar;
using gslam::Vec2d;
using gslam::Vec3d;

struct Extrinsics {
  SO3d R_body_camera;
  Vec3d t_body_camera;
};

Extrinsics extrinsics(const std::string& path) {
  const Svar data = gslam::loadYaml(path)["T_BS"]["data"];
  Mat3d rotation;
  Extrinsics result;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t c = 0; c < 3; ++c) rotation(row, c) = data[4 * row + c].as<double>();
    result.t_body_camera[row] = data[4 * row + 3].as<double>();
  }
  result.R_body_camera = SO3d::fromMatrix(rotation);
  return result;
}

TEST(RealRectification, OfEuroc) {
  NEEDS_TEST_DATA();
  const std::string folder = test_data::folder() + "sequences/euroc_V1_01_easy/mav0/";
  const Camera left = calibrations::euroc(folder + "cam0/sensor.yaml")[0].second;
  const Camera right = calibrations::euroc(folder + "cam1/sensor.yaml")[0].second;
  const Extrinsics of_left = extrinsics(folder + "cam0/sensor.yaml");
  const Extrinsics of_right = extrinsics(folder + "cam1/sensor.yaml");
  const SO3d R_left_right = of_left.R_body_camera.inverse() * of_right.R_body_camera;
  const Vec3d t_left_right =
      of_left.R_body_camera.inverse() * (of_right.t_body_camera - of_left.t_body_camera);
  const gslam::StereoRectification r = rectifyStereo(left, right, R_left_right, t_left_right);

  const Svar published = gslam::loadYaml(
      test_data::folder() + "calibrations/stella_vslam/euroc/EuRoC_stereo.yaml")["StereoRectifier"];
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(r.R_rectified_left.values[i], published["R_left"][i].as<double>(), 2e-5);
    EXPECT_NEAR(r.R_rectified_right.values[i], published["R_right"][i].as<double>(), 2e-5);
  }
  EXPECT_NEAR(r.baseline, 47.90639384423901 / 435.2046959714599, 1e-5);

  // Points of the scene, by way of the distorted images of both cameras.
  for (const double z : {0.5, 0.8, 1.7, 3.1, 10.0}) {
    for (const double x : {-0.5, -0.31, -0.1, 0.0, 0.12, 0.27, 0.48}) {
      for (const double y : {-0.3, -0.17, 0.0, 0.11, 0.29}) {
        const Vec3d in_left = {x * z, y * z, z};
        const Vec3d in_right = R_left_right.inverse() * (in_left - t_left_right);
        Vec2d pixel, u_left, u_right;
        Vec3d bearing;
        ASSERT_TRUE(left.project(in_left, pixel) && left.unproject(pixel, bearing));
        ASSERT_TRUE(r.camera.project(r.R_rectified_left * bearing, u_left));
        ASSERT_TRUE(right.project(in_right, pixel) && right.unproject(pixel, bearing));
        ASSERT_TRUE(r.camera.project(r.R_rectified_right * bearing, u_right));
        ASSERT_NEAR(u_left[1], u_right[1], 1e-9);
        ASSERT_GT(u_left[0], u_right[0]);
      }
    }
  }
}

}  // namespace
