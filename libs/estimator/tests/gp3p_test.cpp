// The pose of a rig from three rays, against the truth, against a search along the first ray, and
// against P3P.
#include <gslam/estimator/solvers/gp3p.h>
#include <gslam/estimator/solvers/p3p.h>
#include <gtest/gtest.h>

#include "absolute_pose_scenes.h"
#include "instances.h"

namespace {

using namespace absolute_pose;
using gslam::gp3p;
using gslam::p3p;
using gslam::SO3d;
using gslam::Span;
using RigPoses = std::array<SE3d, 8>;

PoseScene rigScene(Generator& generator, double size, double near = 1, double far = 10) {
  std::array<Vec3d, 3> origins, points;
  for (std::size_t k = 0; k < 3; ++k) {
    origins[k] = size * gslam::randomNormal<double, 3>(generator);
    points[k] = origins[k] + gslam::randomUniform(generator, near, far) *
                                 gslam::randomDirection<double>(generator);
  }
  return sceneOf(generator, points, origins);
}

std::size_t solve(const PoseScene& scene, RigPoses& poses) {
  return gp3p(scene.origins, scene.bearings, scene.points, poses);
}

// Errors of the best solution; each must lie on the rays.
template <class Make>
std::vector<double> errorsOf(std::size_t instances, unsigned seed, double on_ray, Make make) {
  Generator generator(seed);
  std::vector<double> errors;
  RigPoses poses;
  for (std::size_t i = 0; i < instances; ++i) {
    const PoseScene scene = make(generator);
    const std::size_t count = solve(scene, poses);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_LT(rayError(poses[k], scene), on_ray) << "instance " << i << " solution " << k;
      for (std::size_t l = 0; l < k; ++l) EXPECT_GT(poseError(poses[k], poses[l]), 0) << i;
    }
    errors.push_back(errorOf(poses.data(), count, scene.T_camera_world));
  }
  return errors;
}

long countLost(const std::vector<double>& errors, double allowed = 1e-6) {
  return std::count_if(errors.begin(), errors.end(), [&](double e) { return !(e < allowed); });
}

TEST(Gp3p, FindsThePose) {
  const std::vector<double> errors =
      errorsOf(solver_test::instances(), 1, 1e-9, [](Generator& g) { return rigScene(g, 1); });
  EXPECT_EQ(countLost(errors), 0);
  EXPECT_LT(quantile(errors, 0.5), 2e-14);
  EXPECT_LT(quantile(errors, 0.99), 5e-12);
}

// From rigs as large as the scene to such that are nearly cameras.
TEST(Gp3p, FindsThePoseWithRigsOfEverySize) {
  for (double size : {10.0, 0.1, 1e-2, 1e-4, 1e-8, 1e-12, 1e-15}) {
    const std::vector<double> errors = errorsOf(solver_test::instances(500), 2, 1e-9,
                                                [&](Generator& g) { return rigScene(g, size); });
    EXPECT_EQ(countLost(errors), 0) << size;
  }
}

TEST(Gp3p, AgreesWithP3pWhereAllRaysStartInOnePlace) {
  Generator generator(3);
  RigPoses poses;
  std::array<SE3d, 4> expected;
  for (std::size_t i = 0; i < solver_test::instances(1000); ++i) {
    PoseScene scene = randomPoseScene(generator);
    const Vec3d origin = gslam::randomNormal<double, 3>(generator);
    scene.origins = {origin, origin, origin};
    const std::size_t count = solve(scene, poses);
    ASSERT_EQ(count, p3p(scene.bearings, scene.points, expected));
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_LT(rayError(poses[k], scene), 1e-9);
      EXPECT_EQ(poses[k].translation(), expected[k].translation() + origin);
    }
  }
}

TEST(Gp3p, FindsThePoseWhereTwoRaysStartInOnePlace) {
  for (std::size_t same = 0; same < 3; ++same) {
    const std::vector<double> errors =
        errorsOf(solver_test::instances(1000), 4, 1e-9, [&](Generator& g) {
          PoseScene scene = rigScene(g, 1);
          std::array<Vec3d, 3> points;
          for (std::size_t k = 0; k < 3; ++k) {
            points[k] = scene.T_camera_world * scene.points[k];
          }
          scene.origins[same] = scene.origins[(same + 1) % 3];
          return sceneOf(g, points, scene.origins);
        });
    EXPECT_EQ(countLost(errors), 0);
  }
}

TEST(Gp3p, KeepsItsDigitsForNearlyCollinearPoints) {
  const std::vector<double> errors =
      errorsOf(solver_test::instances(1000), 5, 1e-8, [](Generator& g) {
        const Vec3d a = inView(g), b = inView(g);
        const double part = gslam::randomUniform(g, 0.1, 0.9);
        const Vec3d off = (1e-4 * (b - a).norm()) * gslam::randomDirection<double>(g);
        std::array<Vec3d, 3> origins;
        for (Vec3d& origin : origins) origin = 0.3 * gslam::randomNormal<double, 3>(g);
        return sceneOf(g, {a, b, (1 - part) * a + part * b + off}, origins);
      });
  EXPECT_LT(quantile(errors, 0.5), 1e-10);
  EXPECT_LE(countLost(errors), static_cast<long>(errors.size() / 200));
}

TEST(Gp3p, GivesOnlySolutionsWhereThereAreInfinitelyMany) {
  errorsOf(solver_test::instances(300), 6, 1e-6, [](Generator& g) {  // collinear points
    const Vec3d a = inView(g), b = inView(g);
    return sceneOf(g, {a, b, 0.5 * (a + b)}, {Vec3d{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}});
  });
  errorsOf(solver_test::instances(300), 7, 1e-6, [](Generator& g) {  // parallel rays
    PoseScene scene = rigScene(g, 1);
    std::array<Vec3d, 3> points;
    for (std::size_t k = 0; k < 3; ++k) {
      points[k] = scene.origins[k] + Vec3d{{0, 0, gslam::randomUniform(g, 1.0, 5.0)}};
    }
    return sceneOf(g, points, scene.origins);
  });
}

TEST(Gp3p, RefusesPointsBehindTheOrigins) {
  Generator generator(8);
  RigPoses poses;
  for (std::size_t i = 0; i < solver_test::instances(500); ++i) {
    PoseScene scene = rigScene(generator, 1);
    const SE3d truth = scene.T_camera_world;
    scene.bearings[i % 3] = -scene.bearings[i % 3];
    const std::size_t count = solve(scene, poses);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_LT(rayError(poses[k], scene), 1e-9);
      EXPECT_GT(poseError(poses[k], truth), 1e-6);
    }
  }
}

// The residual of the third distance along the first ray, for one of the two roots that each of the
// others has.
double residualAt(const PoseScene& s, double d, int branch, Vec3d (&seen)[3], double (&depths)[3]) {
  depths[0] = d;
  seen[0] = s.origins[0] + d * s.bearings[0];
  for (std::size_t k = 1; k < 3; ++k) {
    const Vec3d apart = s.origins[k] - seen[0];
    const double half = s.bearings[k].dot(apart);
    const double root =
        std::sqrt(half * half - apart.squaredNorm() + (s.points[k] - s.points[0]).squaredNorm());
    depths[k] = -half + ((k == 1 ? branch < 2 : branch % 2 == 0) ? root : -root);
    seen[k] = s.origins[k] + depths[k] * s.bearings[k];
  }
  return (seen[2] - seen[1]).squaredNorm() - (s.points[2] - s.points[1]).squaredNorm();
}

TEST(Gp3p, FindsEverySolutionThatASearchFinds) {
  Generator generator(9);
  RigPoses poses;
  std::size_t searched = 0, most = 0;
  for (std::size_t i = 0; i < solver_test::instances(100); ++i) {
    const PoseScene scene = rigScene(generator, 3);
    const std::size_t count = solve(scene, poses);
    most = std::max(most, count);
    for (int branch = 0; branch < 4; ++branch) {
      Vec3d seen[3];
      double depths[3], last = std::nan("");
      constexpr int kSteps = 1500;
      for (int step = 0; step <= kSteps; ++step) {
        double low = 30.0 * (step - 1) / kSteps, high = 30.0 * step / kSteps;
        const double value = residualAt(scene, high, branch, seen, depths);
        const bool changes = (value > 0 && last < 0) || (value < 0 && last > 0);
        const bool rises = value > last;
        last = value;
        if (!changes) continue;
        for (int half = 0; half < 60; ++half) {
          const double middle = 0.5 * (low + high);
          ((residualAt(scene, middle, branch, seen, depths) > 0) == rises ? high : low) = middle;
        }
        residualAt(scene, low, branch, seen, depths);
        if (low <= 0 || depths[1] <= 0 || depths[2] <= 0) continue;
        ++searched;
        double nearest = 1e9;
        for (std::size_t k = 0; k < count; ++k) {
          double difference = 0;
          for (std::size_t l = 0; l < 3; ++l) {
            difference += (poses[k] * scene.points[l] - seen[l]).norm();
          }
          nearest = std::min(nearest, difference);
        }
        EXPECT_LT(nearest, 1e-5) << "instance " << i << " depth " << low;
      }
    }
  }
  EXPECT_GE(searched, solver_test::instances(100));
  EXPECT_GE(most, 3u);
}

TEST(Gp3p, GivesNoNumberThatIsNone) {
  Generator generator(10);
  RigPoses poses;
  const auto check = [&](const PoseScene& scene) {
    const std::size_t count = solve(scene, poses);
    ASSERT_LE(count, 8u);
    for (std::size_t k = 0; k < count; ++k) EXPECT_TRUE(isFinite(poses[k]));
  };
  for (double odd : oddNumbers()) {
    for (std::size_t i = 0; i < 27; ++i) {
      PoseScene scene = rigScene(generator, 1);
      (i < 9 ? scene.points : (i < 18 ? scene.bearings : scene.origins))[i / 3 % 3][i % 3] = odd;
      check(scene);
    }
  }
  for (int i = 0; i < 50; ++i) {
    PoseScene scene = rigScene(generator, 1);
    scene.points[1] = scene.points[0];
    check(scene);
    scene.points[2] = scene.points[0];
    check(scene);
    scene = rigScene(generator, 1);
    scene.bearings[1] = scene.bearings[0];
    check(scene);
    scene.origins[1] = scene.origins[0];
    check(scene);
  }
}

// Central rays have a way of their own; the place where they start counts there, too.
TEST(Gp3p, GivesNoNumberThatIsNoneWhereRaysStartInOnePlace) {
  Generator generator(12);
  RigPoses poses;
  for (double odd : oddNumbers()) {
    for (std::size_t i = 0; i < 12; ++i) {
      PoseScene scene = rigScene(generator, 1);
      scene.origins[1] = scene.origins[2] = scene.origins[0] = Vec3d{};
      for (std::size_t k = 0; k < 3; ++k) {
        scene.bearings[k] = (scene.T_camera_world * scene.points[k]).normalized();
      }
      if (i < 9) {
        scene.origins[i / 3][i % 3] = odd;
      } else {
        for (Vec3d& origin : scene.origins) origin[i % 3] = odd;
      }
      const std::size_t count = solve(scene, poses);
      for (std::size_t k = 0; k < count; ++k) EXPECT_TRUE(isFinite(poses[k])) << odd << ' ' << i;
      if (!std::isfinite(odd)) {
        EXPECT_EQ(count, 0u) << odd << ' ' << i;
      }
    }
  }
}

TEST(Gp3p, RefusesOtherSizes) {
  Generator generator(11);
  const PoseScene s = rigScene(generator, 1);
  const Span<const Vec3d> origins(s.origins), bearings(s.bearings), points(s.points);
  RigPoses poses;
  EXPECT_THROW(gp3p(origins.subspan(1), bearings, points, poses), gslam::ArgumentError);
  EXPECT_THROW(gp3p(origins, bearings.subspan(1), points, poses), gslam::ArgumentError);
  EXPECT_THROW(gp3p(origins, bearings, points.subspan(1), poses), gslam::ArgumentError);
}

}  // namespace
