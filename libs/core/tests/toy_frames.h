// Frames in which nothing is zero, for the toy plugin's digest.
#ifndef GSLAM_CORE_TESTS_TOY_FRAMES_H
#define GSLAM_CORE_TESTS_TOY_FRAMES_H

#include <gslam/core/frame.h>
#include <gslam/core/rig.h>

#include <cstdint>
#include <memory>
#include <random>
#include <string>

inline gslam::Image randomImage(int width, int height, gslam::PixelType type, int channels,
                                std::mt19937& random) {
  gslam::Image image(width, height, type, channels);
  for (int y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < image.rowBytes(); ++x) {
      image.bytes(y)[x] = static_cast<std::uint8_t>(random());
    }
  }
  return image;
}

inline gslam::SE3d randomPose(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  gslam::SE3d::Tangent tangent;
  for (std::size_t i = 0; i < 6; ++i) tangent[i] = number(random);
  return gslam::SE3d::exp(tangent);
}

inline gslam::ImuCalibration randomImu(std::mt19937& random) {
  gslam::ImuCalibration imu;
  imu.T_body_imu = randomPose(random);
  imu.rate = 200;
  imu.gyro_noise = 1e-3;
  imu.accel_noise = 2e-3;
  imu.gyro_bias_walk = 3e-5;
  imu.accel_bias_walk = 4e-5;
  return imu;
}

inline gslam::SensorRig toyRig() {
  std::mt19937 random(5);
  gslam::SensorRig rig;
  rig.cameras.resize(2);
  rig.cameras[0].name = "left";
  rig.cameras[0].camera = gslam::Camera::fromParameters("pinhole", 31, 17, {20.5, 21, 15.25, 8});
  rig.cameras[0].T_body_camera = randomPose(random);
  rig.cameras[0].rate = 20;
  rig.cameras[1].name = "depth";
  rig.cameras[1].kind = gslam::ImageKind::depth;
  rig.cameras[1].depth_scale = 0.001;
  rig.has_imu = true;
  rig.imu = randomImu(random);
  rig.has_gnss = true;
  rig.gnss_antenna = {0.1, 0.2, 0.3};
  return rig;
}

/// A frame with images of several types, one of which is a view with gaps between its rows.
inline std::shared_ptr<gslam::Frame> toyFrame(std::uint64_t id, int scale = 1) {
  std::mt19937 random(static_cast<std::uint32_t>(id) + 1);
  const auto frame = std::make_shared<gslam::Frame>();
  frame->id = id;
  frame->stamp = std::int64_t(id) * 50000000 + 1;
  frame->images.resize(4);
  gslam::CameraImage& left = frame->images[0];
  left.image = randomImage(31 * scale, 17 * scale, gslam::PixelType::u8, 1, random);
  left.camera = gslam::Camera::fromParameters("pinhole", 31, 17, {20.5, 21, 15.25, 8});
  left.T_body_camera = randomPose(random);
  left.exposure = 5000000;
  left.name = "left";
  frame->images[1].image = randomImage(13, 7, gslam::PixelType::u16, 1, random);
  frame->images[1].kind = gslam::ImageKind::depth;
  frame->images[1].depth_scale = 0.001;
  frame->images[2].image = randomImage(19, 23, gslam::PixelType::f32, 3, random).view(2, 3, 11, 13);
  frame->images[2].kind = gslam::ImageKind::rgb;
  frame->images[3].name = "none";  // a camera that gave no image
  for (int i = 0; i < 10; ++i) {
    frame->imu.push_back({frame->stamp - 10 + i, {0.1, 0.2, double(i)}, {0, 0, 9.81}});
  }
  frame->imu_calibration = randomImu(random);
  gslam::GnssSample gnss = {};
  gnss.stamp = frame->stamp;
  gnss.position = {0.5, 0.25, 100};
  gnss.covariance(0, 0) = 2;
  gnss.fix = gslam::GnssFix::rtk_fixed;
  frame->gnss.push_back(gnss);
  frame->has_prior = true;
  gslam::SE3d::Jacobian covariance = {};
  for (std::size_t i = 0; i < 6; ++i) covariance(i, i) = double(i + 1);
  frame->prior = gslam::PoseWithCovariance<gslam::SE3d>(randomPose(random), covariance);
  return frame;
}

#endif  // GSLAM_CORE_TESTS_TOY_FRAMES_H
