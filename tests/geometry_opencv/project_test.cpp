// project() and unproject() against projectPoints() and undistortPoints().
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "opencv_cameras.h"

namespace {

using gslam::Camera;
using gslam::Vec2d;
using gslam::Vec3d;
using namespace opencv_cameras;  // NOLINT(google-build-using-namespace)

const cv::Vec3d kNoMotion(0, 0, 0);

void expectPixels(const Camera& camera, const std::vector<cv::Point3d>& points,
                  const std::vector<cv::Point2d>& expected) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vec2d pixel;
    ASSERT_TRUE(camera.project(vec(points[i]), pixel));
    ASSERT_NEAR(pixel[0], expected[i].x, 1e-10) << camera;
    ASSERT_NEAR(pixel[1], expected[i].y, 1e-10) << camera;
  }
}

TEST(AgainstOpenCV, ProjectPinhole) {
  const Camera camera = Camera::fromParameters("pinhole", 1226, 370, {707, 708, 601, 183});
  const std::vector<cv::Point3d> points = pointsInImage(camera, 1000);
  std::vector<cv::Point2d> expected;
  cv::projectPoints(points, kNoMotion, kNoMotion, cameraMatrix(camera), cv::noArray(), expected);
  expectPixels(camera, points, expected);
}

TEST(AgainstOpenCV, ProjectRadtan) {
  for (const Camera& camera : radtanCameras()) {
    const std::vector<cv::Point3d> points = pointsInImage(camera, 1000);
    std::vector<cv::Point2d> expected;
    cv::projectPoints(points, kNoMotion, kNoMotion, cameraMatrix(camera), coefficients(camera),
                      expected);
    expectPixels(camera, points, expected);
  }
}

TEST(AgainstOpenCV, JacobiansOfRadtan) {
  for (const Camera& camera : radtanCameras()) {
    const std::vector<cv::Point3d> points = pointsInImage(camera, 50);
    std::vector<cv::Point2d> pixels;
    cv::Mat expected;  // by rotation, translation, fx, fy, cx, cy, coefficients
    cv::projectPoints(points, kNoMotion, kNoMotion, cameraMatrix(camera), coefficients(camera),
                      pixels, expected);
    const std::size_t count = camera.parameterCount();
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec2d pixel;
      gslam::Mat<double, 2, 3> by_point;
      std::vector<double> by_parameters(2 * count);
      ASSERT_TRUE(camera.project(vec(points[i]), pixel, &by_point, by_parameters.data()));
      for (int row = 0; row < 2; ++row) {
        const double* const from = expected.ptr<double>(static_cast<int>(2 * i) + row);
        const std::size_t r = static_cast<std::size_t>(row);
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_NEAR(by_point(r, c), from[3 + c], 1e-9 * (1 + std::fabs(from[3 + c])));
        }
        for (std::size_t c = 0; c < count; ++c) {
          ASSERT_NEAR(by_parameters[r * count + c], from[6 + c],
                      1e-9 * (1 + std::fabs(from[6 + c])))
              << camera << "\n"
              << camera.parameterNames()[c];
        }
      }
    }
  }
}

void expectBearings(const Camera& camera, const std::vector<cv::Point2d>& pixels,
                    const std::vector<cv::Point2d>& expected, double tolerance) {
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    Vec3d bearing;
    ASSERT_TRUE(camera.unproject({pixels[i].x, pixels[i].y}, bearing));
    ASSERT_NEAR(bearing[0] / bearing[2], expected[i].x, tolerance) << camera;
    ASSERT_NEAR(bearing[1] / bearing[2], expected[i].y, tolerance) << camera;
  }
}

std::vector<cv::Point2d> grid(const Camera& camera) {
  std::vector<cv::Point2d> pixels;
  for (int v = 0; v < camera.height(); v += 17) {
    for (int u = 0; u < camera.width(); u += 17) pixels.emplace_back(u, v);
  }
  return pixels;
}

TEST(AgainstOpenCV, UnprojectRadtan) {
  for (const Camera& camera : radtanCameras()) {
    const std::vector<cv::Point2d> pixels = grid(camera);
    std::vector<cv::Point2d> expected;
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 1000, 1e-14);
    cv::undistortPoints(pixels, expected, cameraMatrix(camera), coefficients(camera), cv::noArray(),
                        cv::noArray(), until);
    expectBearings(camera, pixels, expected, 1e-10);
  }
}

std::vector<Camera> fisheyes() {
  return {Camera::fromParameters("kannala_brandt", 512, 512,
                                 {190.97847715128717, 190.9733070521226, 254.93170605935475,
                                  256.8974428996504, 0.0034823894022493434, 0.0007150348452162257,
                                  -0.0020532361418706202, 0.00020293673591811182}),
          Camera::fromParameters(
              "kannala_brandt", 960, 540,
              {441.730011169, 442.520822476, 480.35667528, 275.490228646, -3.068701296607466433e-02,
               -3.343454364086094217e-03, -2.881735840896060968e-03, -5.917420310474077278e-04})};
}

TEST(AgainstOpenCV, ProjectFisheye) {
  for (const Camera& camera : fisheyes()) {
    std::vector<cv::Point3d> points;  // OpenCV's knows no points beside or behind the camera
    for (const cv::Point3d& point : pointsInImage(camera, 1000)) {
      if (point.z > 0) points.push_back(point);
    }
    ASSERT_GT(points.size(), 500U);
    std::vector<cv::Point2d> expected;
    cv::fisheye::projectPoints(points, expected, kNoMotion, kNoMotion, cameraMatrix(camera),
                               coefficients(camera));
    expectPixels(camera, points, expected);
  }
}

TEST(AgainstOpenCV, UnprojectFisheye) {
  for (const Camera& camera : fisheyes()) {
    std::vector<cv::Point2d> pixels;
    for (const cv::Point2d& pixel : grid(camera)) {
      Vec3d bearing;
      if (camera.unproject({pixel.x, pixel.y}, bearing) && bearing[2] > 0.2) {
        pixels.push_back(pixel);
      }
    }
    std::vector<cv::Point2d> expected;
    cv::fisheye::undistortPoints(pixels, expected, cameraMatrix(camera), coefficients(camera));
    expectBearings(camera, pixels, expected, 1e-7);  // its iteration stops at steps of 1e-8
  }
}

}  // namespace
