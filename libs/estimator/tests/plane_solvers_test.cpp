#include <gslam/estimator/solvers/plane.h>
#include <gslam/estimator/solvers/plane_frame.h>
#include <gtest/gtest.h>

#include "closed_form_helpers.h"
#include "instances.h"

namespace {

using namespace gslam;
using namespace solver_test;

double distanceFrom(const Vec4d& plane, const Vec3d& p) {
  return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3];
}

TEST(PlaneFromPoints, FindsTheTruth) {
  std::mt19937 generator(1);
  for (const std::size_t n : {std::size_t(3), std::size_t(4), std::size_t(30)}) {
    const std::size_t count = instances(n == 3 ? 10000 : 1000);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const SE3d T_world_plane = randomOf<SE3d>(generator, 3.0);
      std::vector<Vec3d> points;
      for (std::size_t j = 0; j < n; ++j) {
        points.push_back(T_world_plane * Vec3d{{randomUniform<double>(generator, -1, 1),
                                                randomUniform<double>(generator, -1, 1), 0}});
      }
      const Vec3d normal = T_world_plane.rotation() * Vec3d{{0, 0, 1}};
      Vec4d plane;
      if (planeFromPoints(points, plane) == 0) {
        ++lost;
        continue;
      }
      lost += !(normal.cross(plane.segment<3>(0)).norm() < 1e-6);
      EXPECT_NEAR(plane.segment<3>(0).norm(), 1, 1e-14);
      EXPECT_GE(plane[3], 0);
      for (const Vec3d& p : points) EXPECT_NEAR(distanceFrom(plane, p), 0, 1e-10);
    }
    EXPECT_LE(lost, count / 10000) << n;
  }
}

TEST(PlaneFromPoints, IsLeastSquares) {
  std::mt19937 generator(2);
  for (int i = 0; i < 300; ++i) {
    auto points = randomPoints<3>(generator, 4 + static_cast<std::size_t>(i) % 20, 1);
    for (Vec3d& p : points) p[1] *= 0.3;
    Vec4d plane;
    ASSERT_EQ(planeFromPoints(points, plane), 1u);
    const auto cost = [&](const Vec4d& q) {
      double sum = 0;
      for (const Vec3d& p : points) sum += distanceFrom(q, p) * distanceFrom(q, p);
      return sum / q.segment<3>(0).squaredNorm();
    };
    for (int k = 0; k < 100; ++k) {
      Vec4d other = plane + (k < 50 ? 1e-3 : 1.0) * randomNormal<double, 4>(generator);
      EXPECT_GE(cost(other), cost(plane) * (1 - 1e-12));
    }
  }
}

TEST(PlaneFromPoints, KeepsDigitsOfThinAndFarSets) {
  std::mt19937 generator(3);
  for (const std::size_t n : {std::size_t(3), std::size_t(10)}) {
    for (int i = 0; i < 500; ++i) {
      const SO3d turn = randomOf<SO3d>(generator);
      std::vector<Vec3d> points = randomPoints<3>(generator, n, 1);
      const double sine = (points[1] - points[0]).cross(points[2] - points[0]).norm();
      if (sine < 0.01) continue;
      for (Vec3d& p : points) p = turn * Vec3d{{p[0], 1e-4 * p[1], 0}};
      Vec4d plane;
      ASSERT_EQ(planeFromPoints(points, plane), 1u);
      // Second moments have the square of the width.
      EXPECT_LT(plane.segment<3>(0).cross(turn * Vec3d{{0, 0, 1}}).norm(), n == 3 ? 1e-8 : 1e-6);
      for (Vec3d& p : points) p = 1e4 * (turn * p) + Vec3d{{1e4, 1e4, -1e4}};
      ASSERT_EQ(planeFromPoints(points, plane), 1u);
      EXPECT_LT(plane.segment<3>(0).cross(turn * (turn * Vec3d{{0, 0, 1}})).norm(),
                n == 3 ? 1e-8 : 1e-6);
    }
  }
}

TEST(PlaneFromPoints, RefusesCollinearPoints) {
  std::mt19937 generator(4);
  for (const std::size_t n : {std::size_t(3), std::size_t(4), std::size_t(20)}) {
    for (int i = 0; i < 1000; ++i) {
      std::vector<Vec3d> points = randomPoints<3>(generator, n, 1);
      for (std::size_t j = 2; j < n; ++j) {
        points[j] = points[0] + randomUniform<double>(generator, -1, 1) * (points[1] - points[0]);
      }
      Vec4d plane{};
      EXPECT_EQ(planeFromPoints(points, plane), 0u);
      EXPECT_EQ(plane, Vec4d{});
      const std::vector<Vec3d> same(n, points[0]);
      EXPECT_EQ(planeFromPoints(same, plane), 0u);
    }
  }
}

TEST(PlaneSolvers, AreNeverNan) {
  std::mt19937 generator(5);
  for (const std::size_t n : {std::size_t(3), std::size_t(6)}) {
    for (const double value : absurdValues()) {
      for (std::size_t at = 0; at < 3 * n; ++at) {
        std::vector<Vec3d> points = randomPoints<3>(generator, n, 1);
        points[at / 3][at % 3] = value;
        Vec4d plane;
        if (planeFromPoints(points, plane) == 1) {
          EXPECT_TRUE(isFinite(plane)) << plane;
        }
        for (Vec3d& p : points) p *= value;
        if (planeFromPoints(points, plane) == 1) {
          EXPECT_TRUE(isFinite(plane)) << plane;
        }
        Vec4d q = {{0.1, 0.2, 0.3, 0.4}};
        Vec3d near = {{1, 2, 3}};
        (at % 7 < 4 ? q[at % 7] : near[at % 7 - 4]) = value;
        SE3d t;
        if (planeFrame(q, near, t) == 1) {
          EXPECT_TRUE(isFinite(t)) << t;
        }
      }
    }
  }
  const std::vector<Vec3d> two(2);
  Vec4d plane;
  EXPECT_THROW(planeFromPoints(two, plane), ArgumentError);
}

TEST(PlaneFrame, HasThePlaneAsItsXyPlane) {
  std::mt19937 generator(6);
  for (std::size_t i = 0; i < instances(2000); ++i) {
    Vec3d n = randomDirection<double>(generator);
    if (i % 3 == 0) {  // near z, and near its opposite
      const double side = std::pow(10.0, randomUniform<double>(generator, -18, 0));
      n = Vec3d{{side * n[0], side * n[1], n[2] > 0 ? 1.0 : -1.0}}.normalized();
    }
    const double length = std::pow(10.0, randomUniform<double>(generator, -3, 3));
    const double d = randomUniform<double>(generator, -2, 2);
    const Vec3d near = 3 * randomDirection<double>(generator);
    SE3d t;
    ASSERT_EQ(planeFrame({{length * n[0], length * n[1], length * n[2], length * d}}, near, t), 1u);
    EXPECT_LT((t.rotation() * Vec3d{{0, 0, 1}} - n).norm(), 1e-14);
    EXPECT_NEAR(n.dot(t.translation()) + d, 0, 1e-13);
    EXPECT_LT((near - t.translation()).cross(n).norm(), 1e-13);
    // The shortest way: the angle is that between z and n.
    EXPECT_NEAR(t.rotation().angle(), std::atan2(std::hypot(n[0], n[1]), n[2]), 1e-13);
  }
  SE3d t;
  ASSERT_EQ(planeFrame({{0, 0, -1, 0}}, {{0, 0, 0}}, t), 1u);
  EXPECT_EQ(t.rotation() * (Vec3d{{0, 0, 1}}), (Vec3d{{0, 0, -1}}));
  EXPECT_EQ(planeFrame({{0, 0, 0, 1}}, {{0, 0, 0}}, t), 0u);
}

}  // namespace
