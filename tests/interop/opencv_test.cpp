// OpenCV's small types and ours are the same things: elements, actions, rotation vectors.
#include <gslam/geometry/opencv.h>
#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

namespace {

using gslam::fromOpenCv;
using gslam::fromRodrigues;
using gslam::Mat;
using gslam::randomOf;
using gslam::SE3d;
using gslam::SO3d;
using gslam::toOpenCv;
using gslam::toRodrigues;
using gslam::Vec3d;

TEST(OpenCv, VectorsAndMatrices) {
  const Mat<double, 2, 3> m = {11, 12, 13, 21, 22, 23};
  const cv::Matx<double, 2, 3> c = toOpenCv(m);
  EXPECT_EQ(c(0, 2), 13);
  EXPECT_EQ(c(1, 0), 21);
  EXPECT_EQ(fromOpenCv(c), m);
  const cv::Vec3d v = toOpenCv(Vec3d{1, 2, 3});
  EXPECT_EQ(v[2], 3);
  EXPECT_EQ(fromOpenCv(v), (Vec3d{1, 2, 3}));
  EXPECT_EQ(fromOpenCv(cv::Point2f(4, 5)), (gslam::Vec2f{4, 5}));
  EXPECT_EQ(fromOpenCv(cv::Point3d(4, 5, 6)), (Vec3d{4, 5, 6}));
  EXPECT_EQ(fromOpenCv(toOpenCv(gslam::Vec4f{1, 2, 3, 4})), (gslam::Vec4f{1, 2, 3, 4}));
}

TEST(OpenCv, Poses) {
  std::mt19937 generator(1);
  for (int i = 0; i < 200; ++i) {
    const SE3d a = randomOf<SE3d>(generator), b = randomOf<SE3d>(generator);
    const Vec3d p = gslam::randomDirection<double>(generator);
    ASSERT_TRUE(fromOpenCv(toOpenCv(a)).isApprox(a, 1e-15));
    ASSERT_LE((fromOpenCv(toOpenCv(a) * toOpenCv(p)) - a * p).norm(), 1e-15);
    ASSERT_TRUE(fromOpenCv(toOpenCv(a) * toOpenCv(b)).isApprox(a * b, 4e-15));
    ASSERT_EQ(fromOpenCv(toOpenCv(a.rotation())), a.rotation().matrix());
  }
}

TEST(OpenCv, RotationVectors) {
  std::mt19937 generator(1);
  for (int i = 0; i < 200; ++i) {
    const SO3d r = randomOf<SO3d>(generator);
    cv::Matx33d matrix;
    cv::Rodrigues(toRodrigues(r), matrix);
    ASSERT_TRUE(SO3d::fromMatrix(fromOpenCv(matrix)).isApprox(r, 1e-14));
    ASSERT_TRUE(fromRodrigues(toRodrigues(r)).isApprox(r, 1e-14));
  }
}

// What solvePnP finds is the transform that was put in.
TEST(OpenCv, SolvePnp) {
  const SE3d T_camera_object(SO3d::exp({0.3, -0.2, 0.5}), {0.1, 0.2, 4});
  const std::vector<cv::Point3d> points = {{-1, -1, 0}, {1, -1, 0.3},  {1, 1, -0.2},
                                           {-1, 1, 0},  {0.2, 0.5, 1}, {-0.4, 0.1, -1}};
  std::vector<cv::Point2d> pixels;
  for (const cv::Point3d& point : points) {
    const Vec3d p = T_camera_object * fromOpenCv(point);
    pixels.emplace_back(p[0] / p[2], p[1] / p[2]);
  }
  cv::Mat rvec, tvec;
  ASSERT_TRUE(cv::solvePnP(points, pixels, cv::Matx33d::eye(), cv::noArray(), rvec, tvec));
  EXPECT_TRUE(fromRodrigues(cv::Vec3d(rvec), cv::Vec3d(tvec)).isApprox(T_camera_object, 1e-6));
}

TEST(OpenCv, WhatIsNoPoseIsRefused) {
  cv::Affine3d sheared;
  sheared.matrix(0, 1) = 0.5;
  EXPECT_THROW((void)fromOpenCv(sheared), gslam::ArgumentError);
  EXPECT_THROW((void)fromRodrigues(cv::Vec3d(0, NAN, 0)), gslam::ArgumentError);
}

}  // namespace
