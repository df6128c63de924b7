// Quaternions w x y z, and matrices as rows or columns of numbers.
#include <gmock/gmock.h>
#include <gslam/geometry/layout.h>

#include <vector>

#include "reference.h"

namespace {

using gslam::SE3d;
using gslam::SO3d;

TEST(Layout, QuaternionsWithTheRealPartFirst) {
  const SO3d r = gslam::fromQuaternionWxyz(0.5, -0.5, 0.5, 0.5);
  EXPECT_EQ(r.w(), 0.5);
  EXPECT_EQ(r.x(), -0.5);
  EXPECT_EQ(gslam::quaternionWxyzOf(r), (gslam::Vec4d{0.5, -0.5, 0.5, 0.5}));
}

TEST(Layout, RowsAndColumns) {
  reference::Random<double> random;
  const SE3d pose(random.rotation(), {1, 2, 3});
  const gslam::Mat4d m = pose.matrix();
  const std::vector<double> rows(m.values, m.values + 16);
  EXPECT_TRUE(gslam::fromRowMajor<double>(rows).isApprox(pose, 1e-15));
  const std::vector<double> kitti(m.values, m.values + 12);
  EXPECT_TRUE(gslam::fromRowMajor<double>(kitti).isApprox(pose, 1e-15));
  const gslam::Vec<double, 16> columns = gslam::columnMajorOf(pose);
  EXPECT_EQ(columns[1], m(1, 0));
  EXPECT_EQ(columns[12], 1);
  EXPECT_TRUE(gslam::fromColumnMajor<double>(columns).isApprox(pose, 1e-15));
}

TEST(Layout, WhatIsRefused) {
  const std::vector<double> eleven(11, 0.0);
  std::vector<double> m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1};
  EXPECT_TRUE(gslam::fromColumnMajor<double>(m).isApprox(SE3d({}, {7, 8, 9}), 0));
  EXPECT_THROW((void)gslam::fromRowMajor<double>(m), gslam::ArgumentError);  // the other order
  EXPECT_THROW((void)gslam::fromRowMajor<double>(eleven), gslam::ArgumentError);
  m.resize(12);
  EXPECT_THROW((void)gslam::fromColumnMajor<double>(m), gslam::ArgumentError);
  m[5] = -1;
  try {
    (void)gslam::fromRowMajor<double>(m);
    FAIL();
  } catch (const gslam::ArgumentError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("reflection"));
  }
}

}  // namespace
