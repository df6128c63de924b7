// Cost functions of everything but bundles.
#include <gtest/gtest.h>

#include <cmath>

#include "correspondence_cost.h"
#include "derivatives.h"
#include "edge_cost.h"
#include "known_point_cost.h"
#include "match_cost.h"
#include "scenes.h"
#include "solve.h"

namespace {

namespace by_ceres = gslam::detail::by_ceres;

using gslam::Camera;
using gslam::Mat3d;
using gslam::PoseGraphResidual;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::Vec2d;
using gslam::Vec3d;
using gslam::Vec4d;

template <class Group>
Group anyGroup(std::mt19937_64& generator, double size) {
  typename Group::Tangent tangent;
  for (double& value : tangent.values) value = scenes::noise(generator, size);
  return Group::exp(tangent);
}

template <std::size_t N>
gslam::Mat<double, N, N> anyInformation(std::mt19937_64& generator) {
  gslam::Mat<double, N, N> root;
  for (double& value : root.values) value = scenes::noise(generator, 1);
  return root.transpose() * root + gslam::Mat<double, N, N>::identity();
}

template <class Group>
double* numbersOf(Group& group) {
  return const_cast<double*>(group.data());
}

template <class Group>
class edge_derivatives : public testing::Test {};
using Groups = testing::Types<SE2d, SE3d, SIM3d>;
TYPED_TEST_SUITE(edge_derivatives, Groups, );

TYPED_TEST(edge_derivatives, are_right) {
  using Group = TypeParam;
  std::mt19937_64 generator(1);
  for (const PoseGraphResidual kind :
       {PoseGraphResidual::Logarithm, PoseGraphResidual::Quaternion, PoseGraphResidual::Chordal}) {
    if (kind == PoseGraphResidual::Chordal && std::is_same<Group, SIM3d>::value) continue;
    Group a = anyGroup<Group>(generator, 1), b = anyGroup<Group>(generator, 1);
    const Group between = a.inverse() * b * anyGroup<Group>(generator, 0.5);
    const auto information = anyInformation<Group::kFreedom>(generator);
    const by_ceres::GroupManifold<Group> manifold;
    by_ceres::EdgeCost<Group> both, only_from, only_to;
    constexpr int n = by_ceres::ambientSize<Group>();
    const by_ceres::EdgeEnd<Group> from = {a.data(), n}, to = {b.data(), n};
    both.set(kind, from, to, between, information);
    only_from.set(kind, from, {b.data(), 0}, between, information);
    only_to.set(kind, {a.data(), 0}, to, between, information);
    ceres::Problem problem(by_ceres::problemOptions());
    auto* const movable = const_cast<by_ceres::GroupManifold<Group>*>(&manifold);
    problem.AddParameterBlock(numbersOf(a), n, movable);
    problem.AddParameterBlock(numbersOf(b), n, movable);
    problem.AddResidualBlock(&both, nullptr, numbersOf(a), numbersOf(b));
    derivatives::expectRight(problem);
    ceres::Problem alone(by_ceres::problemOptions());
    alone.AddParameterBlock(numbersOf(a), n, movable);
    alone.AddResidualBlock(&only_from, nullptr, numbersOf(a));
    derivatives::expectRight(alone);
    ceres::Problem other(by_ceres::problemOptions());
    other.AddParameterBlock(numbersOf(b), n, movable);
    other.AddResidualBlock(&only_to, nullptr, numbersOf(b));
    derivatives::expectRight(other);
  }
}

template <class Group>
class correspondence_derivatives : public testing::Test {};
using Transforms = testing::Types<SE3d, SIM3d>;
TYPED_TEST_SUITE(correspondence_derivatives, Transforms, );

TYPED_TEST(correspondence_derivatives, are_right) {
  using Group = TypeParam;
  std::mt19937_64 generator(2);
  Group transform = anyGroup<Group>(generator, 1);
  const Vec3d b = {1, 2, 3}, a = {-1, 0.5, 2}, along = Vec3d{1, -2, 2} / 3;
  const Vec4d plane = {2.0 / 3, 2.0 / 3, 1.0 / 3, 0.7};
  const SE3d in_b = anyGroup<SE3d>(generator, 1), in_a = anyGroup<SE3d>(generator, 1);
  const Mat3d information = anyInformation<3>(generator);
  const auto of_pose = anyInformation<6>(generator);
  const double weight = 2.5;
  gslam::AlignmentProblem pairs;
  pairs.points_b = pairs.plane_points_b = pairs.line_points_b = {&b, 1};
  pairs.points_a = pairs.line_origins_a = {&a, 1};
  pairs.point_information = {&information, 1};
  pairs.planes_a = {&plane, 1};
  pairs.line_directions_a = {&along, 1};
  pairs.plane_information = pairs.line_information = {&weight, 1};
  pairs.T_b_body = {&in_b, 1};
  pairs.T_a_body = {&in_a, 1};
  pairs.pose_information = {&of_pose, 1};
  using by_ceres::Correspondence;
  by_ceres::CorrespondenceCost<Group> costs[4];
  by_ceres::GroupManifold<Group> manifold;
  ceres::Problem problem(by_ceres::problemOptions());
  problem.AddParameterBlock(numbersOf(transform), by_ceres::ambientSize<Group>(), &manifold);
  std::size_t i = 0;
  for (const Correspondence kind :
       {Correspondence::Point, Correspondence::Plane, Correspondence::Line, Correspondence::Pose}) {
    costs[i].set(pairs, kind, 0);
    problem.AddResidualBlock(&costs[i++], nullptr, numbersOf(transform));
  }
  derivatives::expectRight(problem);
}

TEST(known_point_derivatives, are_right) {
  const std::vector<Camera> cameras = {scenes::pinhole(), scenes::radtan()};
  const std::vector<SE3d> extrinsics = {SE3d::exp({0.1, -0.2, 0.3, 0.1, 0.2, -0.1}),
                                        SE3d::exp({-0.1, 0.2, 0.1, -0.1, 0.1, 0.1})};
  const std::vector<Vec3d> points = {{0.5, -0.3, 4}, {1, 0.5, 6}, {-1, 0.2, 5}};
  const std::vector<Vec2d> pixels = {{300, 200}, {350, 250}, {250, 240}};
  const std::vector<double> right_u = {280, -1, std::nan("")}, information = {2, 3, 0.5};
  const std::vector<std::uint32_t> camera_of = {0, 1, 1};
  gslam::PoseProblem known;
  known.points = points;
  known.pixels = pixels;
  known.information = information;
  known.right_u = right_u;
  known.baseline = 0.2;
  known.cameras = cameras;
  known.T_body_camera = extrinsics;
  known.camera_of = camera_of;
  SE3d pose = SE3d::exp({0.1, 0.2, -0.1, 0.05, -0.1, 0.1});
  by_ceres::GroupManifold<SE3d> manifold;
  by_ceres::KnownPointCost costs[3];
  ceres::Problem problem(by_ceres::problemOptions());
  problem.AddParameterBlock(numbersOf(pose), 7, &manifold);
  int rows = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    costs[i].set(known, i);
    rows += costs[i].num_residuals();
    problem.AddResidualBlock(&costs[i], nullptr, numbersOf(pose));
  }
  EXPECT_EQ(3 + 3 + 2, rows);
  derivatives::expectRight(problem);
}

TEST(match_derivatives, are_right) {
  const std::vector<Vec2d> pixels = {{300, 200}, {350, 250}};
  const std::vector<double> information = {2, 0.5};
  gslam::TwoViewProblem views;
  views.second = pixels;
  views.information = information;
  views.second_camera = scenes::radtan();
  for (const bool keeps_length : {false, true}) {
    SE3d pose = SE3d::exp({0.7, 0.2, -0.1, 0.05, -0.1, 0.1});
    double inverse[] = {0.2, 0.1};
    by_ceres::GroupManifold<SE3d> free;
    by_ceres::FixedLengthManifold held;
    by_ceres::InverseManifold depth;
    by_ceres::MatchCost costs[2];
    by_ceres::DepthCost known;
    known.set(0.15, 4);
    ceres::Problem problem(by_ceres::problemOptions());
    ceres::Manifold* const manifold =
        keeps_length ? static_cast<ceres::Manifold*>(&held) : static_cast<ceres::Manifold*>(&free);
    problem.AddParameterBlock(numbersOf(pose), 7, manifold);
    for (std::size_t i = 0; i < 2; ++i) {
      costs[i].set(views, i, Vec3d{0.1, -0.2 * double(i), 1}.normalized(), keeps_length, true);
      problem.AddParameterBlock(inverse + i, 1, &depth);
      problem.AddResidualBlock(&costs[i], nullptr, numbersOf(pose), inverse + i);
    }
    problem.AddResidualBlock(&known, nullptr, inverse);
    derivatives::expectRight(problem);
  }
}

}  // namespace
