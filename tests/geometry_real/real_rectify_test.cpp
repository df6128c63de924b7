// Rectification of EuRoC's stereo camera against the rotations that stella_vslam publishes for it.
#include <gslam/datasets/calibration_file.h>
#include <gslam/geometry/rectify.h>
#include <gslam/svar.h>
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <string>

#include "test_data.h"

namespace {

using gslam::Camera;
using gslam::SO3d;
using gslam::Svar;
using gslam::Vec2d;
using gslam::Vec3d;

TEST(RealRectification, OfEuroc) {
  NEEDS_TEST_DATA();
  const std::string folder = test_data::folder() + "sequences/euroc_V1_01_easy/mav0/";
  const gslam::CameraSensor cam0 =
      gslam::readCalibration(folder + "cam0/sensor.yaml").rig.cameras[0];
  const gslam::CameraSensor cam1 =
      gslam::readCalibration(folder + "cam1/sensor.yaml").rig.cameras[0];
  const Camera left = cam0.camera, right = cam1.camera;
  const gslam::SE3d T_left_right = cam0.T_body_camera.inverse() * cam1.T_body_camera;
  const SO3d R_left_right = T_left_right.rotation();
  const Vec3d t_left_right = T_left_right.translation();
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
