// Cameras of files that OpenCV writes, and of Kalibr's, see points where OpenCV does.
#include <gslam/datasets/calibration_file.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "test_data.h"

namespace {

using gslam::Calibration;
using gslam::Camera;
using gslam::Vec2d;

std::vector<cv::Point3d> pointsAhead(double reach) {
  std::vector<cv::Point3d> points;
  for (double x = -reach; x <= reach; x += reach / 5) {
    for (double y = -reach; y <= reach; y += reach / 5) points.emplace_back(x, y, 1 + 0.1 * x * y);
  }
  return points;
}

void expectSame(const Camera& camera, const std::vector<cv::Point3d>& points,
                const std::vector<cv::Point2d>& pixels) {
  ASSERT_EQ(points.size(), pixels.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vec2d pixel;
    ASSERT_TRUE(camera.project({{points[i].x, points[i].y, points[i].z}}, pixel)) << points[i];
    EXPECT_NEAR(pixel[0], pixels[i].x, 1e-9);
    EXPECT_NEAR(pixel[1], pixels[i].y, 1e-9);
  }
}

cv::Matx33d matrixOf(const Camera& camera) {
  const std::vector<double> p = camera.parameters();
  return {p[0], 0, p[2], 0, p[1], p[3], 0, 0, 1};
}

std::vector<double> coefficientsOf(const Camera& camera) {
  const std::vector<double> p = camera.parameters();
  return {p.begin() + 4, p.end()};
}

// The file of OpenCV's sample calibration.cpp, in memory.
std::string fileOf(const cv::Mat& matrix, const cv::Mat& coefficients, bool is_xml,
                   bool is_fisheye) {
  cv::FileStorage file(is_xml ? ".xml" : ".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  file << "calibration_time"
       << "Thu Nov 26 12:00:00 2026"
       << "image_width" << 640 << "image_height" << 480 << "flags" << 0;
  if (is_fisheye) file << "fisheye_model" << 1;
  file << "camera_matrix" << matrix << "distortion_coefficients" << coefficients
       << "avg_reprojection_error" << 0.31;
  return file.releaseAndGetString();
}

TEST(calibrationOfOpenCv, SeesWhereOpenCvDoes) {
  const cv::Matx33d matrix(500, 0, 320.25, 0, 501, 240.5, 0, 0, 1);
  const std::vector<double> all = {0.1,    -0.02, 0.001, -0.002, 0.003,  0.11, -0.01,
                                   0.0025, 0.002, 0.001, -0.001, 0.0005, 0.01, -0.02};
  const std::vector<cv::Point3d> points = pointsAhead(0.4);
  for (int count : {0, 4, 5, 8, 12, 14}) {
    for (bool is_xml : {false, true}) {
      const cv::Mat k(std::vector<double>(all.begin(), all.begin() + count), true);
      const Calibration found =
          gslam::parseCalibration(fileOf(cv::Mat(matrix), k, is_xml, false), "file");
      EXPECT_EQ(found.format, "opencv");
      std::vector<cv::Point2d> pixels;
      cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix, k, pixels);
      expectSame(found.rig.cameras[0].camera, points, pixels);
    }
  }
}

TEST(calibrationOfOpenCv, FisheyeSeesWhereOpenCvDoes) {
  const cv::Matx33d matrix(300, 0, 320.25, 0, 301, 240.5, 0, 0, 1);
  const cv::Vec4d k(0.1, -0.02, 0.003, -0.0004);
  const Calibration found =
      gslam::parseCalibration(fileOf(cv::Mat(matrix), cv::Mat(k), false, true), "file");
  const std::vector<cv::Point3d> points = pointsAhead(1);
  std::vector<cv::Point2d> pixels;
  cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), matrix, k);
  expectSame(found.rig.cameras[0].camera, points, pixels);
}

TEST(calibrationOfOpenCv, KalibrsFilesToo) {
  NEEDS_TEST_DATA();
  const std::string folder = test_data::folder() + "calibrations/kalibr/";
  const std::vector<cv::Point3d> points = pointsAhead(0.4);
  for (const char* name : {"euroc_mav", "rs_d455", "tum_vi"}) {
    const Calibration found = gslam::readCalibration(folder + name + "/kalibr_imucam_chain.yaml");
    for (const gslam::CameraSensor& sensor : found.rig.cameras) {
      const std::vector<double> k = coefficientsOf(sensor.camera);
      std::vector<cv::Point2d> pixels;
      if (sensor.camera.modelName() == "radtan") {
        cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrixOf(sensor.camera), k, pixels);
      } else {
        cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(),
                                   matrixOf(sensor.camera), k);
      }
      expectSame(sensor.camera, points, pixels);
    }
  }
}

TEST(calibrationOfOpenCv, ThePairOfStereoCalib) {
  cv::Matx33d rotation;
  cv::Rodrigues(cv::Vec3d(0.02, -0.3, 0.1), rotation);
  const cv::Vec3d translation(-0.11, 0.002, 0.003);
  cv::FileStorage file(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  const cv::Matx33d matrix(500, 0, 320, 0, 501, 240, 0, 0, 1);
  const std::vector<double> k = {0.1, -0.02, 0.001, -0.002, 0.003};
  file << "M1" << cv::Mat(matrix) << "D1" << cv::Mat(k) << "M2" << cv::Mat(matrix) << "D2"
       << cv::Mat(k) << "R" << cv::Mat(rotation) << "T" << cv::Mat(translation);
  gslam::CalibrationOptions options;
  options.width = 640;
  options.height = 480;
  const Calibration found = gslam::parseCalibration(file.releaseAndGetString(), "file", options);
  ASSERT_EQ(found.rig.cameras.size(), 2U);
  std::vector<cv::Point2d> pixels;
  cv::Vec3d turn;
  cv::Rodrigues(rotation, turn);
  const std::vector<cv::Point3d> points = pointsAhead(0.3);
  cv::projectPoints(points, turn, translation, matrix, k, pixels);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const gslam::CameraSensor& right = found.rig.cameras[1];
    Vec2d pixel;
    ASSERT_TRUE(right.camera.project(
        right.T_body_camera.inverse() * gslam::Vec3d{{points[i].x, points[i].y, points[i].z}},
        pixel));
    EXPECT_NEAR(pixel[0], pixels[i].x, 1e-8);
    EXPECT_NEAR(pixel[1], pixels[i].y, 1e-8);
  }
}

cv::Matx33d rotationOf(double x, double y, double z) {
  cv::Matx33d rotation;
  cv::Rodrigues(cv::Vec3d(x, y, z), rotation);
  return rotation;
}

// Mei's camera as cv::omnidir has it (opencv_contrib, omnidir.cpp, projectPoints), which not every
// OpenCV has: onto the unit sphere, the plane at xi behind its centre, then k1 k2 p1 p2.
TEST(calibrationOfOpenCv, OmnidirectionalSeesWhereItsFormulaDoes) {
  cv::FileStorage file(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  const cv::Matx33d matrix(700, 0, 320.25, 0, 701, 240.5, 0, 0, 1);
  const cv::Vec4d k(0.1, -0.02, 0.001, -0.002);
  const double xi = 1.25;
  file << "image_width" << 640 << "image_height" << 480 << "camera_matrix" << cv::Mat(matrix)
       << "distortion_coefficients" << cv::Mat(k) << "xi" << xi;
  const Calibration found = gslam::parseCalibration(file.releaseAndGetString(), "file");
  EXPECT_EQ(found.rig.cameras[0].camera.modelName(), "mei");
  const std::vector<cv::Point3d> points = pointsAhead(0.8);
  std::vector<cv::Point3d> on_plane;
  for (const cv::Point3d& point : points) {
    on_plane.emplace_back(point.x, point.y, point.z + xi * cv::norm(point));
  }
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(on_plane, cv::Vec3d(), cv::Vec3d(), matrix, k, pixels);
  expectSame(found.rig.cameras[0].camera, points, pixels);
}

// A pair as OpenCV rectifies it, in ORB-SLAM2's file: undone, it is the pair.
TEST(calibrationOfOpenCv, TheRectifiedPairOfOrbSlam) {
  const cv::Matx33d left(458.5, 0, 367.2, 0, 457.25, 248.5, 0, 0, 1);
  const cv::Matx33d right(457.5, 0, 379.9, 0, 456.25, 255.5, 0, 0, 1);
  const std::vector<double> k_left = {-0.28, 0.07, 0.0002, 2e-5, 0},
                            k_right = {-0.27, 0.06, -0.0001, 3e-5, 0};
  const cv::Matx33d rotation = rotationOf(0.02, -0.03, 0.1);
  const cv::Vec3d translation(-0.11, 0.012, 0.007);  // of stereoCalibrate(): x_right = R x_left + t
  cv::Matx33d rectify_left, rectify_right;
  cv::Matx34d projection_left, projection_right;
  cv::Mat to_depth;
  cv::stereoRectify(left, k_left, right, k_right, {752, 480}, rotation, translation, rectify_left,
                    rectify_right, projection_left, projection_right, to_depth);
  std::string text = "%YAML:1.0\nCamera.fps: 20.0\n";
  const auto matrix = [&](const std::string& name, const cv::Mat& values) {
    text += name + ": !!opencv-matrix\n  rows: " + std::to_string(values.rows) +
            "\n  cols: " + std::to_string(values.cols) + "\n  dt: d\n  data: [";
    for (int i = 0; i < int(values.total()); ++i) {
      text += (i == 0 ? "" : ", ") + cv::format("%.17g", values.ptr<double>()[i]);
    }
    text += "]\n";
  };
  text += cv::format("Camera.fx: %.17g\nCamera.bf: %.17g\n", projection_right(0, 0),
                     -projection_right(0, 3));
  for (const std::string side : {"LEFT", "RIGHT"}) {
    text += side + ".width: 752\n" + side + ".height: 480\n";
    matrix(side + ".K", cv::Mat(side == "LEFT" ? left : right));
    matrix(side + ".D", cv::Mat(side == "LEFT" ? k_left : k_right).t());
    matrix(side + ".R", cv::Mat(side == "LEFT" ? rectify_left : rectify_right));
  }
  const Calibration found = gslam::parseCalibration(text, "file");
  EXPECT_EQ(found.format, "orbslam");
  ASSERT_EQ(found.rig.cameras.size(), 2U);
  const std::vector<cv::Point3d> points = pointsAhead(0.3);
  cv::Vec3d turn;
  cv::Rodrigues(rotation, turn);
  std::vector<cv::Point2d> seen_left, seen_right;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), left, k_left, seen_left);
  cv::projectPoints(points, turn, translation, right, k_right, seen_right);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const gslam::Vec3d point{{points[i].x, points[i].y, points[i].z}};
    for (std::size_t side = 0; side < 2; ++side) {
      const gslam::CameraSensor& sensor = found.rig.cameras[side];
      const cv::Point2d expected = side == 0 ? seen_left[i] : seen_right[i];
      Vec2d pixel;
      ASSERT_TRUE(sensor.camera.project(sensor.T_body_camera.inverse() * point, pixel));
      EXPECT_NEAR(pixel[0], expected.x, 1e-6);
      EXPECT_NEAR(pixel[1], expected.y, 1e-6);
    }
  }
}

}  // namespace
