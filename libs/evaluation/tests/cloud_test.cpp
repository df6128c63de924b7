#include <gslam/base/error.h>
#include <gslam/evaluation/cloud.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "made_trajectory.h"

namespace {

using gslam::CloudErrors;
using gslam::cloudErrors;
using gslam::CloudOptions;
using gslam::MapPoint;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::Vec3d;
using Cloud = std::vector<MapPoint>;

MapPoint pointAt(const Vec3d& position) {
  MapPoint point;
  point.position = position;
  return point;
}

Cloud somePoints(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    cloud.push_back(pointAt({{3 * uniform(random), 2 * uniform(random), uniform(random)}}));
  }
  return cloud;
}

Cloud moved(const SIM3d& s, Cloud cloud) {
  for (MapPoint& point : cloud) point.position = s * point.position;
  return cloud;
}

TEST(cloud, distances_are_those_of_trying_all) {
  const Cloud reference = somePoints(700, 1), cloud = somePoints(300, 2);
  CloudOptions options;
  options.threshold = 0.2;
  const CloudErrors errors = cloudErrors(reference, cloud, options);
  const auto nearest = [](const MapPoint& point, const Cloud& others) {
    double least = std::numeric_limits<double>::infinity();
    for (const MapPoint& other : others) {
      least = std::min(least, (other.position - point.position).norm());
    }
    return least;
  };
  std::vector<double> distances;
  double near = 0, complete = 0;
  for (const MapPoint& point : cloud) {
    distances.push_back(nearest(point, reference));
    near += distances.back() <= 0.2 ? 1 : 0;
  }
  for (const MapPoint& point : reference) complete += nearest(point, cloud) <= 0.2 ? 1 : 0;
  const gslam::Statistics expected = gslam::statisticsOf(distances);
  EXPECT_NEAR(errors.distance.rmse, expected.rmse, 1e-12);
  EXPECT_NEAR(errors.distance.median, expected.median, 1e-12);
  EXPECT_NEAR(errors.distance.max, expected.max, 1e-12);
  EXPECT_DOUBLE_EQ(errors.accuracy, near / 300);
  EXPECT_DOUBLE_EQ(errors.completeness, complete / 700);
  EXPECT_NEAR(errors.f_score,
              2 * errors.accuracy * errors.completeness / (errors.accuracy + errors.completeness),
              1e-12);
}

// A wall, and a cloud in front of it.
TEST(cloud, a_wall_that_is_off_is_off_by_that) {
  Cloud wall, cloud;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      const Vec3d place = {{0.02 * i, 0.02 * j, 0}};
      wall.push_back(pointAt(place));
      if (i % 2 == 0) cloud.push_back(pointAt(place + Vec3d{{0, 0, 0.03}}));
    }
  }
  const CloudErrors errors = cloudErrors(wall, cloud);
  EXPECT_NEAR(errors.distance.mean, 0.03, 1e-12);
  EXPECT_NEAR(errors.distance.std, 0, 1e-12);
  EXPECT_EQ(errors.accuracy, 1);
  EXPECT_EQ(errors.completeness, 1);
}

TEST(cloud, the_alignment_counts_and_is_refined) {
  const Cloud reference = somePoints(3000, 3);
  const SIM3d truth(SE3d(gslam::SO3d::exp({{0.2, -0.5, 1}}), {{5, 6, 7}}), 1.5);
  const Cloud cloud = moved(truth.inverse(), Cloud(reference.begin(), reference.begin() + 800));
  CloudOptions options;
  options.S_world_cloud = truth;
  EXPECT_LT(cloudErrors(reference, cloud, options).distance.max, 1e-12);
  // A little off; the scale as well.
  for (const bool has_scale : {false, true}) {
    const SIM3d off(SE3d(gslam::SO3d::exp({{0.004, 0.003, -0.005}}), {{0.01, -0.01, 0.02}}),
                    has_scale ? 1.004 : 1);
    options.S_world_cloud = off * truth;
    options.icp_rounds = 0;
    EXPECT_GT(cloudErrors(reference, cloud, options).distance.rmse, 0.01);
    options.icp_rounds = 100;
    options.icp_has_scale = has_scale;
    const CloudErrors errors = cloudErrors(reference, cloud, options);
    EXPECT_TRUE(errors.reason.empty()) << errors.reason;
    EXPECT_LT(errors.distance.max, 1e-9);
    EXPECT_TRUE(errors.S_world_cloud.isApprox(truth, 1e-9));
    EXPECT_LT(errors.icp_rounds, 100U);
  }
}

TEST(cloud, outliers_are_counted_and_left_out) {
  const Cloud reference = somePoints(500, 4);
  Cloud cloud(reference.begin(), reference.begin() + 100);
  cloud.push_back(pointAt({{50, 0, 0}}));
  cloud.push_back(pointAt({{0, std::nan(""), 0}}));
  CloudOptions options;
  options.max_distance = 1;
  const CloudErrors errors = cloudErrors(reference, cloud, options);
  EXPECT_EQ(errors.outliers, 2U);
  EXPECT_EQ(errors.distance.count, 100U);
  EXPECT_EQ(errors.distance.max, 0);
  EXPECT_DOUBLE_EQ(errors.accuracy, 100.0 / 102);
}

TEST(cloud, refining_that_cannot_be_says_why) {
  const Cloud reference = somePoints(50, 5);
  const Cloud one = {pointAt({{0, 0, 0}})};
  CloudOptions options;
  options.icp_rounds = 5;
  EXPECT_FALSE(cloudErrors(reference, one, options).reason.empty());
  options.max_distance = 1e-9;
  const CloudErrors far = cloudErrors(reference, somePoints(20, 6), options);
  EXPECT_NE(far.reason.find("no point is within"), std::string::npos);
  EXPECT_EQ(far.outliers, 20U);
}

TEST(cloud, refuses_wrong_arguments) {
  const Cloud some = somePoints(5, 7), none;
  EXPECT_THROW(cloudErrors(none, some), gslam::ArgumentError);
  EXPECT_THROW(cloudErrors(some, none), gslam::ArgumentError);
  const Cloud no_number = {pointAt({{0, 0, std::nan("")}})};
  EXPECT_THROW(cloudErrors(some, no_number), gslam::ArgumentError);
  CloudOptions options;
  options.threshold = 0;
  EXPECT_THROW(cloudErrors(some, some, options), gslam::ArgumentError);
}

}  // namespace
