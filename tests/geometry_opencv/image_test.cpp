// Undistorted images against remap(), rectification against stereoRectify().
#include <gslam/geometry/rectify.h>
#include <gslam/geometry/undistort.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "opencv_cameras.h"

namespace {

using gslam::Camera;
using gslam::ImageSpan;
using gslam::Vec3d;
using namespace opencv_cameras;  // NOLINT(google-build-using-namespace)

cv::Mat smoothImage(int width, int height, int channels) {
  cv::Mat image(height, width, CV_8UC(channels));
  cv::theRNG().state = 5;
  cv::randu(image, 0, 256);
  cv::GaussianBlur(image, image, cv::Size(), 2);
  return image;
}

TEST(AgainstOpenCV, UndistortedImages) {
  for (const Camera& source : radtanCameras()) {
    const Camera target = Camera::fromParameters("pinhole", source.width(), source.height(),
                                                 {source.parameter("fx"), source.parameter("fy"),
                                                  source.parameter("cx"), source.parameter("cy")});
    const gslam::Undistorter undistorter(source, target);
    for (const int channels : {1, 3, 4}) {
      const cv::Mat in = smoothImage(source.width(), source.height(), channels);
      cv::Mat expected, out(in.size(), in.type());
      cv::undistort(in, expected, cameraMatrix(source), coefficients(source));
      undistorter.apply<std::uint8_t>(
          ImageSpan<const std::uint8_t>::dense(in.data, in.cols, in.rows, channels),
          ImageSpan<std::uint8_t>::dense(out.data, out.cols, out.rows, channels));
      double sum = 0;
      int count = 0;
      std::size_t i = 0;
      for (int v = 0; v < in.rows; ++v) {
        const std::uint8_t* ours = out.ptr(v);
        const std::uint8_t* theirs = expected.ptr(v);
        for (int u = 0; u < in.cols; ++u, ++i, ours += channels, theirs += channels) {
          if (undistorter.mask()[i] == 0) continue;
          const int difference = std::abs(int(*ours) - int(*theirs));
          ASSERT_LE(difference, 2) << u << " " << v;  // its positions are multiples of 1/32
          sum += difference;
          ++count;
        }
      }
      EXPECT_LT(sum / count, 0.2);
      EXPECT_GT(count, in.rows * in.cols / 2);
    }
  }
}

TEST(AgainstOpenCV, StereoRectify) {
  const Camera left = radtanCameras()[0];
  const Camera right = Camera::fromParameters(
      "radtan", 752, 480,
      {457.587, 456.134, 379.999, 255.238, -0.28368365, 0.07451284, -0.00010473, -3.555907e-05});
  for (const Vec3d& t : {Vec3d{0.11, -0.004, 0.006}, Vec3d{-0.2, 0.01, 0.02}, Vec3d{0.01, 0.3, 0},
                         Vec3d{0.02, -0.3, 0.01}}) {
    const gslam::SO3d R_left_right = gslam::SO3d::exp({0.02, -0.034, 0.015});
    const gslam::StereoRectification found = rectifyStereo(left, right, R_left_right, t);
    // OpenCV takes the transform from left to right
    const gslam::Mat3d to_right = R_left_right.inverse().matrix();
    const Vec3d left_in_right = R_left_right.inverse() * (-t);
    cv::Mat R1, R2, P1, P2, Q;
    cv::stereoRectify(cameraMatrix(left), coefficients(left), cameraMatrix(right),
                      coefficients(right), cv::Size(752, 480), cv::Matx33d(to_right.values),
                      cv::Vec3d(left_in_right.data()), R1, R2, P1, P2, Q);
    for (int row = 0; row < 3; ++row) {
      for (int c = 0; c < 3; ++c) {
        const std::size_t r = static_cast<std::size_t>(row), k = static_cast<std::size_t>(c);
        EXPECT_NEAR(found.R_rectified_left(r, k), R1.at<double>(row, c), 1e-12);
        EXPECT_NEAR(found.R_rectified_right(r, k), R2.at<double>(row, c), 1e-12);
      }
    }
    const double shift = P2.at<double>(found.is_vertical ? 1 : 0, 3);
    EXPECT_NEAR(found.baseline, -shift / P2.at<double>(0, 0), 1e-12);
  }
}

}  // namespace
