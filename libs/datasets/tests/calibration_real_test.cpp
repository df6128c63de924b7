// The calibrations of several projects for the same cameras agree.
#include <cmath>

#include "calibration_text.h"
#include "test_data.h"

namespace {

using namespace calibration_text;  // NOLINT(google-build-using-namespace)
using gslam::Calibration;
using gslam::CameraSensor;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

Calibration real(const std::string& name, const gslam::CalibrationOptions& options = {}) {
  return gslam::readCalibration(test_data::folder() + name, options);
}

const char* const kKalibrTumVi = "calibrations/kalibr/tum_vi/kalibr_imucam_chain.yaml";
const char* const kKalibrEuroc = "calibrations/kalibr/euroc_mav/kalibr_imucam_chain.yaml";

// Where camera i is in the coordinates of camera 0.
SE3d placeOf(const Calibration& calibration, std::size_t i) {
  return calibration.rig.cameras.at(0).T_body_camera.inverse() *
         calibration.rig.cameras.at(i).T_body_camera;
}

void expectNear(const SE3d& a, const SE3d& b, double metres, double radians) {
  EXPECT_LT((a.translation() - b.translation()).norm(), metres);
  EXPECT_LT((a.rotation().inverse() * b.rotation()).angle(), radians);
}

// Median distance in pixels between what two cameras see of the same directions, as far as `angle`
// from the axis. The two may be turned against each other: calibrations leave that to extrinsics.
double medianDistance(const CameraSensor& a, const CameraSensor& b, double angle) {
  std::vector<double> distances;
  for (double theta = 0; theta < angle; theta += angle / 12) {
    for (double phi = 0; phi < 6.28; phi += 0.3) {
      const Vec3d ray{
          {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)}};
      const Vec3d in_b = b.T_body_camera.rotation().inverse() * (a.T_body_camera.rotation() * ray);
      Vec2d pa, pb;
      if (!a.camera.project(ray, pa) || !b.camera.project(in_b, pb)) continue;
      if (a.camera.isInImage(pa)) distances.push_back((pa - pb).norm());
    }
  }
  EXPECT_GT(distances.size(), 100U);
  std::sort(distances.begin(), distances.end());
  return distances.empty() ? 1e9 : distances[distances.size() / 2];
}

TEST(realCalibration, OrbSlam3AndKalibrDescribeTumViAlike) {
  NEEDS_TEST_DATA();
  const Calibration kalibr = real(kKalibrTumVi);
  const Calibration orbslam = real("calibrations/equidistant/ORB_SLAM3_TUM-VI_KB8.yaml");
  ASSERT_EQ(orbslam.rig.cameras.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(kalibr.rig.cameras[i].camera, orbslam.rig.cameras[i].camera);
  }
  EXPECT_TRUE(says(orbslam.remarks, "there is no Stereo.T_c1_c2"));
}

TEST(realCalibration, DsosFileOfTumVi) {
  NEEDS_TEST_DATA();
  gslam::CalibrationOptions options;
  options.bare_model = "EquiDistant";
  const CameraSensor dso =
      real("calibrations/equidistant/dso_camera_tumvi_cam0.txt", options).rig.cameras[0];
  CameraSensor kalibr = real(kKalibrTumVi).rig.cameras[0];
  kalibr.T_body_camera = SE3d();
  EXPECT_LT(medianDistance(dso, kalibr, 1.4), 1e-8);
  // What DSO itself takes these numbers for is another camera.
  const CameraSensor radtan =
      real("calibrations/equidistant/dso_camera_tumvi_cam0.txt").rig.cameras[0];
  EXPECT_GT(medianDistance(radtan, kalibr, 1), 5);
}

TEST(realCalibration, OpenVinsAndAslDescribeEurocAlike) {
  NEEDS_TEST_DATA();
  const Calibration kalibr = real(kKalibrEuroc);
  const std::string folder = "sequences/euroc_V1_01_easy/mav0/";
  for (std::size_t i = 0; i < 2; ++i) {
    const CameraSensor asl =
        real(folder + "cam" + std::to_string(i) + "/sensor.yaml").rig.cameras[0];
    EXPECT_EQ(asl.camera, kalibr.rig.cameras[i].camera);
    expectNear(asl.T_body_camera, kalibr.rig.cameras[i].T_body_camera, 1e-12, 1e-7);
    EXPECT_EQ(asl.rate, 20);
  }
  const Calibration asl_imu = real(folder + "imu0/sensor.yaml");
  const Calibration imu = real("calibrations/kalibr/euroc_mav/kalibr_imu_chain.yaml");
  EXPECT_TRUE(asl_imu.rig.has_imu && imu.rig.has_imu);
  EXPECT_EQ(asl_imu.rig.imu.gyro_noise, 1.6968e-04);
  EXPECT_EQ(asl_imu.rig.imu.gyro_noise, imu.rig.imu.gyro_noise);
  EXPECT_EQ(asl_imu.rig.imu.gyro_bias_walk, imu.rig.imu.gyro_bias_walk);
  EXPECT_EQ(asl_imu.rig.imu.accel_noise, imu.rig.imu.accel_noise);
  EXPECT_EQ(asl_imu.rig.imu.accel_bias_walk, imu.rig.imu.accel_bias_walk);
  EXPECT_EQ(asl_imu.rig.imu.rate, 200);
  EXPECT_EQ(imu.rig.imu.rate, 200);
}

// stella_vslam's file has the rectification; undone, it is the pair as EuRoC has it.
TEST(realCalibration, StellasRectifiedPairIsEurocs) {
  NEEDS_TEST_DATA();
  const Calibration stella = real("calibrations/stella_vslam/euroc/EuRoC_stereo.yaml");
  const Calibration kalibr = real(kKalibrEuroc);
  ASSERT_EQ(stella.rig.cameras.size(), 2U);
  expectNear(placeOf(stella, 1), placeOf(kalibr, 1), 1e-5, 1e-5);
  const Calibration tumvi = real("calibrations/stella_vslam/tum_vi/TUM_VI_stereo.yaml");
  const Calibration chain = real(kKalibrTumVi);
  EXPECT_EQ(tumvi.rig.cameras[1].camera, chain.rig.cameras[1].camera);
  expectNear(placeOf(tumvi, 1), placeOf(chain, 1), 1e-4, 1e-4);
}

// Their own calibrations of the same cameras, by other models and other images.
TEST(realCalibration, BasaltAndKalibrAreAFewPixelsApart) {
  NEEDS_TEST_DATA();
  const struct {
    const char* kalibr;
    const char* basalt;
    double angle;
    double metres;
  } pairs[] = {{kKalibrEuroc, "calibrations/basalt/euroc_ds_calib.json", 0.7, 0.01},
               {kKalibrEuroc, "calibrations/basalt/euroc_eucm_calib.json", 0.7, 0.01},
               {kKalibrTumVi, "calibrations/basalt/tumvi_512_ds_calib.json", 1.3, 0.003},
               {kKalibrTumVi, "calibrations/basalt/tumvi_512_eucm_calib.json", 1.3, 0.003}};
  for (const auto& pair : pairs) {
    const Calibration kalibr = real(pair.kalibr), basalt = real(pair.basalt);
    ASSERT_EQ(basalt.rig.cameras.size(), 2U);
    EXPECT_EQ(basalt.body, "the IMU");
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LT(medianDistance(kalibr.rig.cameras[i], basalt.rig.cameras[i], pair.angle), 4)
          << pair.basalt;
      expectNear(kalibr.rig.cameras[i].T_body_camera, basalt.rig.cameras[i].T_body_camera,
                 pair.metres, 0.02);
    }
    // The other camera's would be seen.
    EXPECT_GT(medianDistance(kalibr.rig.cameras[0], basalt.rig.cameras[1], pair.angle), 4);
    expectNear(placeOf(kalibr, 1), placeOf(basalt, 1), 0.002, 0.005);
  }
}

TEST(realCalibration, TimeShiftOfTheD455) {
  NEEDS_TEST_DATA();
  const Calibration found = real("calibrations/kalibr/rs_d455/kalibr_imucam_chain.yaml");
  EXPECT_EQ(found.time_offsets, (std::vector<std::int64_t>{2524378}));
  EXPECT_TRUE(says(found.remarks, "2524378 ns"));
}

// The toolbox' inverse polynomial, which it fits to the direct one, to some thousandths of a pixel.
TEST(realCalibration, OcamcalibsOwnInverse) {
  NEEDS_TEST_DATA();
  const gslam::Camera camera = real("calibrations/calib_results_640x480.txt").rig.cameras[0].camera;
  EXPECT_EQ(camera.width(), 640);
  const double inverse[] = {407.216320,   159.672870,   -53.191585,   -211.811262,
                            -963.324864,  -2189.874282, -3125.470126, -2753.680698,
                            -1427.890554, -398.461428,  -46.187761};
  for (double angle = 0.1; angle < 1.2; angle += 0.1) {
    for (double phi = 0; phi < 6.28; phi += 0.5) {
      // World2cam() of the toolbox: x down, y right, z backwards.
      const Vec3d ours{
          {std::sin(angle) * std::sin(phi), std::sin(angle) * std::cos(phi), std::cos(angle)}};
      const double x = ours[1], y = ours[0], z = -ours[2], norm = std::hypot(x, y);
      const double theta = std::atan(z / norm);
      double rho = 0, power = 1;
      for (double a : inverse) {
        rho += a * power;
        power *= theta;
      }
      const double px = x / norm * rho, py = y / norm * rho;
      const double row = px * 1.001968 + py * 0.001400 + 261.744395;
      const double column = px * 0.000113 + py + 326.939156;
      Vec2d pixel;
      ASSERT_TRUE(camera.project(ours, pixel));
      EXPECT_NEAR(pixel[0], column, 0.1);
      EXPECT_NEAR(pixel[1], row, 0.1);
    }
  }
}

TEST(realCalibration, EveryFileIsRead) {
  NEEDS_TEST_DATA();
  const struct {
    const char* format;
    std::vector<std::string> names;
  } files[] = {{"kalibr", {"kalibr/tum_vi/kalibr_imu_chain", "kalibr/rs_d455/kalibr_imu_chain"}},
               {"stella",
                {"stella_vslam/aist/equirectangular", "stella_vslam/aist/fisheye",
                 "stella_vslam/euroc/EuRoC_mono", "stella_vslam/tum_rgbd/TUM_RGBD_rgbd_1",
                 "stella_vslam/kitti/KITTI_stereo_03", "stella_vslam/tum_vi/TUM_VI_mono"}},
               {"svo", {"rpg_svo_camera_atan"}}};
  for (const auto& each : files) {
    for (const std::string& name : each.names) {
      EXPECT_EQ(real("calibrations/" + name + ".yaml").format, each.format) << name;
    }
  }
  EXPECT_THROW(real("calibrations/kalibr/tum_vi/estimator_config.yaml"), gslam::ParseError);
}

}  // namespace
