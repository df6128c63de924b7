// The two solvers of two points, against the truth and against what defines their solutions.
#include <gslam/estimator/solvers/p2p_known_rotation.h>
#include <gslam/estimator/solvers/p2p_known_vertical.h>
#include <gtest/gtest.h>

#include "absolute_pose_scenes.h"
#include "instances.h"

namespace {

using namespace absolute_pose;
using gslam::p2pKnownRotation;
using gslam::p2pKnownVertical;
using gslam::SO3d;
using gslam::Span;

Span<const Vec3d> two(const std::array<Vec3d, 3>& three) {
  return {three.data(), 2};
}

TEST(P2pKnownRotation, FindsThePose) {
  Generator generator(1);
  std::vector<double> errors;
  for (std::size_t i = 0; i < solver_test::instances(); ++i) {
    const PoseScene scene = randomPoseScene(generator);
    SE3d pose;
    ASSERT_EQ(p2pKnownRotation(two(scene.bearings), two(scene.points),
                               scene.T_camera_world.rotation(), pose),
              1u);
    errors.push_back(poseError(pose, scene.T_camera_world));
    EXPECT_LT(errors.back(), 1e-9);
    EXPECT_EQ(pose.rotation().quaternion(), scene.T_camera_world.rotation().quaternion());
  }
  EXPECT_LT(quantile(errors, 0.5), 5e-15);
}

// With rays that do not meet: no place near the one that is given is nearer to both.
TEST(P2pKnownRotation, IsLeastSquares) {
  Generator generator(2);
  for (std::size_t i = 0; i < solver_test::instances(300); ++i) {
    const PoseScene scene = randomPoseScene(generator);
    const SO3d R = SO3d::exp(0.01 * gslam::randomDirection<double>(generator)) *
                   scene.T_camera_world.rotation();
    SE3d pose;
    if (p2pKnownRotation(two(scene.bearings), two(scene.points), R, pose) == 0) continue;
    const auto cost = [&](const Vec3d& t) {
      double sum = 0;
      for (std::size_t k = 0; k < 2; ++k) {
        sum += (R * scene.points[k] + t).cross(scene.bearings[k]).squaredNorm();
      }
      return sum;
    };
    const double least = cost(pose.translation());
    for (std::size_t k = 0; k < 6; ++k) {
      Vec3d step{};
      step[k / 2] = k % 2 == 0 ? 1e-4 : -1e-4;
      EXPECT_GT(cost(pose.translation() + step), least);
    }
  }
}

TEST(P2pKnownRotation, KeepsItsDigits) {
  Generator generator(3);
  for (std::size_t i = 0; i < solver_test::instances(300); ++i) {
    // A narrow bundle: 1 m at 1e4 m.
    const Vec3d off = {{gslam::randomUniform(generator, 0.5, 1.0), 0.3, 0.7}};
    PoseScene scene =
        sceneOf(generator, {Vec3d{{0, 0, 1e4}}, Vec3d{{0, 0, 1e4}} + off, {{0, 0, 1}}});
    SE3d pose;
    ASSERT_EQ(p2pKnownRotation(two(scene.bearings), two(scene.points),
                               scene.T_camera_world.rotation(), pose),
              1u);
    // Rounding of the bearings, 1e-16, by (distance / baseline) distance.
    EXPECT_LT(poseError(pose, scene.T_camera_world), 1e-6);
    // UTM coordinates.
    const Vec3d centre = {{5e5 + 0.25, 5.4e6 + 0.5, 300}};
    const SO3d R = scene.T_camera_world.rotation();
    for (std::size_t k = 0; k < 2; ++k) {
      scene.points[k] = centre + R.inverse() * inView(generator);
      scene.bearings[k] = (R * (scene.points[k] - centre)).normalized();
    }
    ASSERT_EQ(p2pKnownRotation(two(scene.bearings), two(scene.points), R, pose), 1u);
    EXPECT_LT((pose.inverse().translation() - centre).norm(), 2e-8);
  }
}

TEST(P2pKnownRotation, RefusesWhatHasNoSolution) {
  Generator generator(4);
  SE3d pose;
  for (int i = 0; i < 100; ++i) {
    PoseScene scene = randomPoseScene(generator);
    const SO3d R = scene.T_camera_world.rotation();
    const std::array<Vec3d, 3> seen = scene.bearings;
    scene.bearings[0] = -seen[0];  // behind
    scene.bearings[1] = -seen[1];
    EXPECT_EQ(p2pKnownRotation(two(scene.bearings), two(scene.points), R, pose), 0u);
    scene.bearings[0] = scene.bearings[1] = seen[0];  // parallel
    EXPECT_EQ(p2pKnownRotation(two(scene.bearings), two(scene.points), R, pose), 0u);
    scene.bearings = seen;
    scene.points[1] = scene.points[0];  // depths of 0
    EXPECT_EQ(p2pKnownRotation(two(scene.bearings), two(scene.points), R, pose), 0u);
    for (double odd : oddNumbers()) {
      PoseScene bad = scene;
      (i % 2 == 0 ? bad.points : bad.bearings)[static_cast<std::size_t>(i / 2 % 2)]
                                              [static_cast<std::size_t>(i / 4 % 3)] = odd;
      if (p2pKnownRotation(two(bad.bearings), two(bad.points), R, pose) == 1) {
        EXPECT_TRUE(isFinite(pose));
      }
    }
  }
}

TEST(P2pKnownRotation, RefusesOtherSizes) {
  Generator generator(5);
  const PoseScene s = randomPoseScene(generator);
  SE3d pose;
  EXPECT_THROW(p2pKnownRotation(s.bearings, two(s.points), SO3d(), pose), gslam::ArgumentError);
  EXPECT_THROW(p2pKnownRotation(two(s.bearings), s.points, SO3d(), pose), gslam::ArgumentError);
}

struct Upright {
  PoseScene scene;
  Vec3d in_camera, in_world;
};

Upright uprightOf(const PoseScene& scene, const Vec3d& gravity_world) {
  const Vec3d in_camera = (scene.T_camera_world.rotation() * gravity_world).normalized();
  return {scene, in_camera, gravity_world};
}

void expectSolutions(const Upright& u, const std::array<SE3d, 2>& poses, std::size_t count,
                     double on_ray = 1e-9) {
  ASSERT_LE(count, 2u);
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_LT(rayError(poses[k], u.scene, 2), on_ray);
    EXPECT_LT((poses[k].rotation() * u.in_world - u.in_camera).norm(), 1e-14);
  }
}

TEST(P2pKnownVertical, FindsThePose) {
  Generator generator(6);
  std::vector<double> errors;
  std::array<SE3d, 2> poses;
  for (std::size_t i = 0; i < solver_test::instances(); ++i) {
    const Upright u =
        uprightOf(randomPoseScene(generator), gslam::randomDirection<double>(generator));
    const std::size_t count = p2pKnownVertical(two(u.scene.bearings), two(u.scene.points),
                                               u.in_camera, u.in_world, poses);
    expectSolutions(u, poses, count);
    errors.push_back(errorOf(poses.data(), count, u.scene.T_camera_world));
    EXPECT_LT(errors.back(), 1e-6) << i;
  }
  EXPECT_LT(quantile(errors, 0.5), 2e-14);
  EXPECT_LT(quantile(errors, 0.99), 2e-12);
}

// Every angle between the two frames, the half turn too, and every heading.
TEST(P2pKnownVertical, FindsEveryAttitude) {
  Generator generator(7);
  std::array<SE3d, 2> poses;
  const Vec3d down = {{0, 0, -1}};
  const Vec3d in_camera[3] = {{{2, 1, 5}}, {{-1, 2, 6}}, {{0, 0, 1}}};
  for (double tilt : {0.0, 1e-9, 1e-4, 1.0, 3.1415, 3.14159265358979}) {
    for (double heading : {0.0, 1e-9, 1.5, 3.14159265, 3.14159265358979, -2.0}) {
      PoseScene scene;
      scene.T_camera_world = SE3d(SO3d::exp({{tilt, 0, 0}}) * SO3d::exp({{0, 0, heading}}),
                                  gslam::randomDirection<double>(generator));
      for (std::size_t k = 0; k < 3; ++k) {
        scene.points[k] = scene.T_camera_world.inverse() * in_camera[k];
        scene.bearings[k] = in_camera[k].normalized();
      }
      const Upright u = uprightOf(scene, down);
      const std::size_t count =
          p2pKnownVertical(two(scene.bearings), two(scene.points), u.in_camera, u.in_world, poses);
      expectSolutions(u, poses, count);
      EXPECT_LT(errorOf(poses.data(), count, scene.T_camera_world), 1e-12) << tilt << heading;
    }
  }
}

// The other solution is one, too: as many as a search over the heading finds.
TEST(P2pKnownVertical, FindsEverySolutionThatASearchFinds) {
  Generator generator(8);
  std::array<SE3d, 2> poses;
  const double pi = 3.14159265358979;
  for (std::size_t i = 0; i < solver_test::instances(200); ++i) {
    const Upright u =
        uprightOf(randomPoseScene(generator), gslam::randomDirection<double>(generator));
    const std::size_t count = p2pKnownVertical(two(u.scene.bearings), two(u.scene.points),
                                               u.in_camera, u.in_world, poses);
    // With the heading known, the rays meet where this triple product vanishes.
    const SO3d truth = u.scene.T_camera_world.rotation();
    const Vec3d normal = u.scene.bearings[0].cross(u.scene.bearings[1]);
    const Vec3d step = u.scene.points[1] - u.scene.points[0];
    const auto function = [&](double turn) {
      return normal.dot(SO3d::exp(turn * u.in_camera) * (truth * step));
    };
    std::size_t searched = 0;
    constexpr int kSteps = 500;
    for (int k = 0; k < kSteps; ++k) {
      double low = 0.1 + 2 * pi * k / kSteps, high = 0.1 + 2 * pi * (k + 1) / kSteps;
      const bool is_positive = function(low) > 0;
      if (is_positive == (function(high) > 0)) continue;
      for (int half = 0; half < 50; ++half) {
        const double middle = 0.5 * (low + high);
        ((function(middle) > 0) == is_positive ? low : high) = middle;
      }
      const SO3d R = SO3d::exp(low * u.in_camera) * truth;
      SE3d pose;
      if (p2pKnownRotation(two(u.scene.bearings), two(u.scene.points), R, pose) == 0) continue;
      ++searched;
      EXPECT_LT(errorOf(poses.data(), count, pose), 1e-5) << i;
    }
    EXPECT_LE(searched, count);
  }
}

TEST(P2pKnownVertical, GivesNoNumberThatIsNone) {
  Generator generator(9);
  std::array<SE3d, 2> poses;
  const auto check = [&](const Upright& u) {
    const std::size_t count = p2pKnownVertical(two(u.scene.bearings), two(u.scene.points),
                                               u.in_camera, u.in_world, poses);
    EXPECT_LE(count, 2u);
    for (std::size_t k = 0; k < count; ++k) EXPECT_TRUE(isFinite(poses[k]));
    return count;
  };
  for (double odd : oddNumbers()) {
    for (std::size_t i = 0; i < 12; ++i) {
      Upright u = uprightOf(randomPoseScene(generator), gslam::randomDirection<double>(generator));
      const Upright good = u;
      (i < 6 ? u.scene.points : u.scene.bearings)[i / 3 % 2][i % 3] = odd;
      check(u);
      u = good;
      (i < 6 ? u.in_camera : u.in_world)[i % 3] = odd;
      check(u);
    }
  }
  for (int i = 0; i < 100; ++i) {
    Upright u = uprightOf(randomPoseScene(generator), gslam::randomDirection<double>(generator));
    Upright same = u;
    same.scene.points[1] = same.scene.points[0];
    EXPECT_EQ(check(same), 0u);
    same = u;
    same.scene.bearings[1] = same.scene.bearings[0];
    check(same);
    same = u;  // one above the other
    same.scene.points[1] = same.scene.points[0] + u.in_world;
    check(same);
  }
}

// The length of the two directions does not count; without one there is no solution.
TEST(P2pKnownVertical, TakesDirectionsOfAnyLength) {
  Generator generator(11);
  for (std::size_t i = 0; i < solver_test::instances(300); ++i) {
    const Upright u =
        uprightOf(randomPoseScene(generator), gslam::randomDirection<double>(generator));
    std::array<SE3d, 2> poses;
    for (const double scale : {1e-120, 1e-3, 9.81, 1e120}) {
      const std::size_t count =
          p2pKnownVertical(two(u.scene.bearings), two(u.scene.points), scale * u.in_camera,
                           (1 / scale) * u.in_world, poses);
      ASSERT_LT(errorOf(poses.data(), count, u.scene.T_camera_world), 1e-6) << scale;
      for (std::size_t k = 0; k < count; ++k) {
        ASSERT_NEAR(poses[k].rotation().quaternion().norm(), 1, 1e-14) << scale;
      }
    }
    for (const Vec3d& none : {Vec3d{}, Vec3d{{1e-200, 0, 0}}, Vec3d{{0, std::nan(""), 1}}}) {
      ASSERT_EQ(
          p2pKnownVertical(two(u.scene.bearings), two(u.scene.points), none, u.in_world, poses),
          0u);
      ASSERT_EQ(
          p2pKnownVertical(two(u.scene.bearings), two(u.scene.points), u.in_camera, none, poses),
          0u);
    }
  }
}

TEST(P2pKnownVertical, RefusesOtherSizes) {
  Generator generator(10);
  const PoseScene s = randomPoseScene(generator);
  const Vec3d down = {{0, 0, -1}};
  std::array<SE3d, 2> poses;
  EXPECT_THROW(p2pKnownVertical(s.bearings, two(s.points), down, down, poses),
               gslam::ArgumentError);
  EXPECT_THROW(p2pKnownVertical(two(s.bearings), s.points, down, down, poses),
               gslam::ArgumentError);
}

}  // namespace
