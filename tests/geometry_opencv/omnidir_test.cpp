// The camera of Mei against OpenCV's omnidir.
#include <gtest/gtest.h>

#include <opencv2/ccalib/omnidir.hpp>

#include "opencv_cameras.h"

namespace {

using gslam::Camera;
using gslam::Vec2d;
using gslam::Vec3d;
using namespace opencv_cameras;  // NOLINT(google-build-using-namespace)

std::vector<Camera> cameras() {
  return {Camera::fromParameters("mei", 1280, 960,
                                 {1430, 1433, 638, 481, 1.31, -0.12, 0.31, 0.0004, -0.0011}),
          Camera::fromParameters("mei", 752, 480,
                                 {700, 702, 370, 245, 0.81, -0.19, 0.14, 0.0004, -0.0011})};
}

std::vector<double> distortion(const Camera& camera) {
  const std::vector<double> all = coefficients(camera);
  return {all.begin() + 1, all.end()};
}

TEST(AgainstOpenCV, ProjectOmnidir) {
  for (const Camera& camera : cameras()) {
    const std::vector<cv::Point3d> points = pointsInImage(camera, 1000);
    cv::Mat expected;
    cv::omnidir::projectPoints(cv::Mat(points), expected, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0),
                               cv::Mat(cameraMatrix(camera)), camera.parameter("xi"),
                               distortion(camera));
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec2d pixel;
      ASSERT_TRUE(camera.project(vec(points[i]), pixel));
      const cv::Point2d there = expected.at<cv::Point2d>(static_cast<int>(i));
      ASSERT_NEAR(pixel[0], there.x, 1e-10);
      ASSERT_NEAR(pixel[1], there.y, 1e-10);
    }
  }
}

TEST(AgainstOpenCV, UnprojectOmnidir) {
  for (const Camera& camera : cameras()) {
    std::vector<cv::Point2d> pixels;
    std::vector<Vec3d> bearings;
    for (const cv::Point3d& point : pointsInImage(camera, 1000)) {
      Vec2d pixel;
      ASSERT_TRUE(camera.project(vec(point), pixel));
      pixels.emplace_back(pixel[0], pixel[1]);
      Vec3d bearing;
      ASSERT_TRUE(camera.unproject(pixel, bearing));
      bearings.push_back(bearing);
    }
    cv::Mat expected;  // on the unit sphere, divided by its z
    cv::omnidir::undistortPoints(cv::Mat(pixels), expected, cv::Mat(cameraMatrix(camera)),
                                 distortion(camera), cv::Mat(1, 1, CV_64F, camera.parameter("xi")),
                                 cv::Matx33d::eye());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const cv::Point2d there = expected.at<cv::Point2d>(static_cast<int>(i));
      if (bearings[i][2] < 0.1) continue;
      ASSERT_NEAR(bearings[i][0] / bearings[i][2], there.x, 2e-4) << pixels[i];
      ASSERT_NEAR(bearings[i][1] / bearings[i][2], there.y, 2e-4) << pixels[i];
    }
  }
}

}  // namespace
