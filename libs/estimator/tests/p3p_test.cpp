// The three solvers of P3P against the truth, against a search along the first ray, and against
// OpenCV's.
#include <gslam/estimator/solvers/p3p.h>
#include <gslam/estimator/solvers/p3p_gao.h>
#include <gslam/estimator/solvers/p3p_kneip.h>
#include <gtest/gtest.h>

#include <string>

#include "absolute_pose_scenes.h"
#include "instances.h"

#ifdef GSLAM_HAS_OPENCV
#include <opencv2/calib3d.hpp>
#endif

namespace {

using namespace absolute_pose;
using gslam::SO3d;
using gslam::Span;
using P3pPoses = std::array<SE3d, 4>;

struct P3pSolver {
  const char* name;
  std::size_t (*solve)(Span<const Vec3d>, Span<const Vec3d>, P3pPoses&);
  double lost;            // part of random instances
  double flat;            // median error for points within 1e-4 of a line
  double flat_lost;       // part of those
  double symmetric_lost;  // part of isosceles triangles seen from their plane of symmetry
};

class P3p : public testing::TestWithParam<P3pSolver> {
 public:
  std::size_t solve(const PoseScene& scene, P3pPoses& poses) const {
    return GetParam().solve(scene.bearings, scene.points, poses);
  }

  // Errors of the best solution; each must lie on the rays.
  template <class Make>
  std::vector<double> errors(std::size_t instances, unsigned seed, double on_ray, Make make) const {
    Generator generator(seed);
    std::vector<double> errors;
    for (std::size_t i = 0; i < instances; ++i) {
      const PoseScene scene = make(generator);
      P3pPoses poses;
      const std::size_t count = solve(scene, poses);
      for (std::size_t k = 0; k < count; ++k) {
        EXPECT_LT(rayError(poses[k], scene), on_ray) << "instance " << i << " solution " << k;
      }
      errors.push_back(errorOf(poses.data(), count, scene.T_camera_world));
    }
    return errors;
  }
};

double partLost(const std::vector<double>& errors, double allowed = 1e-6) {
  return static_cast<double>(std::count_if(errors.begin(), errors.end(),
                                           [&](double e) { return !(e < allowed); })) /
         static_cast<double>(errors.size());
}

TEST_P(P3p, FindsThePose) {
  const std::vector<double> found =
      errors(solver_test::instances(), 1, 1e-9, [](Generator& g) { return randomPoseScene(g); });
  EXPECT_LE(partLost(found), GetParam().lost);
  EXPECT_LT(quantile(found, 0.5), 2e-14);
  EXPECT_LT(quantile(found, 0.99), 2e-12);
}

TEST_P(P3p, KeepsItsDigitsForNearlyCollinearPoints) {
  const std::vector<double> found = errors(solver_test::instances(2000), 2, 1e-8,
                                           [](Generator& g) { return flatScene(g, 1e-4); });
  EXPECT_LT(quantile(found, 0.5), GetParam().flat);
  EXPECT_LE(partLost(found), GetParam().flat_lost);
}

TEST_P(P3p, GivesOnlySolutionsForCollinearPoints) {
  errors(solver_test::instances(1000), 3, 1e-6, [](Generator& g) { return flatScene(g, 0); });
}

// The place of the camera and its attitude, with the world's origin far away as in UTM coordinates.
TEST_P(P3p, LosesNothingToLargeCoordinates) {
  Generator generator(4);
  std::vector<double> turns, places;
  for (std::size_t i = 0; i < solver_test::instances(2000); ++i) {
    const SO3d R = gslam::randomOf<SO3d>(generator);
    const Vec3d centre = {{5e5 + 0.25, 5.4e6 + 0.5, 300}};
    PoseScene scene;
    for (std::size_t k = 0; k < 3; ++k) {
      scene.points[k] = centre + R.inverse() * inView(generator);
      scene.bearings[k] = (R * (scene.points[k] - centre)).normalized();
    }
    P3pPoses poses;
    const std::size_t count = solve(scene, poses);
    double turn = 10, place = 1e9;
    for (std::size_t k = 0; k < count; ++k) {
      turn = std::min(turn, (poses[k].rotation().inverse() * R).angle());
      place = std::min(place, (poses[k].inverse().translation() - centre).norm());
    }
    turns.push_back(turn);
    places.push_back(place);
  }
  EXPECT_LT(quantile(turns, 0.5), 1e-14);
  EXPECT_LT(quantile(turns, 0.99), 1e-12);
  // The translation, of 5e6 m, is rounded to 1e-9.
  EXPECT_LT(quantile(places, 0.5), 3e-9);
  EXPECT_LT(quantile(places, 0.98), 1e-8);
}

TEST_P(P3p, FindsAFarCluster) {
  const std::vector<double> found = errors(solver_test::instances(1000), 5, 1e-9, [](Generator& g) {
    const Vec3d centre = {{0, 0, 1e4}};
    const Vec3d a = centre + gslam::randomDirection<double>(g);
    const Vec3d b = centre + gslam::randomDirection<double>(g);
    const Vec3d c = centre + gslam::randomDirection<double>(g);
    return sceneOf(g, {a, b, c});
  });
  // Rounding of the bearings alone is 1e-12 of the triangle, and 1e-8 of the distance.
  if (std::string(GetParam().name) == "p3p") {
    EXPECT_LT(quantile(found, 0.5), 1e-6);
    EXPECT_LT(partLost(found, 1e-3), 0.01);
  }
}

TEST_P(P3p, RefusesPointsBehindTheCamera) {
  Generator generator(6);
  for (std::size_t i = 0; i < solver_test::instances(1000); ++i) {
    PoseScene scene = randomPoseScene(generator);
    const SE3d truth = scene.T_camera_world;
    if (i % 2 == 0) {
      for (Vec3d& bearing : scene.bearings) bearing = -bearing;
    } else {
      scene.bearings[i / 2 % 3] = -scene.bearings[i / 2 % 3];
    }
    P3pPoses poses;
    const std::size_t count = solve(scene, poses);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_LT(rayError(poses[k], scene), 1e-9);
      EXPECT_GT(poseError(poses[k], truth), 1e-6);
    }
  }
}

// On the axis of an equilateral triangle the coefficients at both ends of the cubic vanish. One
// solution sees all corners at one distance; three more see two of them so, if they are in front.
TEST_P(P3p, SolvesSymmetricTriangles) {
  Generator generator(7);
  for (double distance : {0.3, 0.5, 1.0, 2.0, 3.0}) {
    const double s = std::sqrt(0.75);
    const PoseScene scene = sceneOf(
        generator, {Vec3d{{1, 0, distance}}, {{-0.5, s, distance}}, {{-0.5, -s, distance}}});
    P3pPoses poses;
    const std::size_t count = solve(scene, poses);
    EXPECT_LT(errorOf(poses.data(), count, scene.T_camera_world), 1e-10 * (1 + distance * distance))
        << distance;
    // They see the third corner at 2 cos - 1 of that distance. The classics may miss some of them:
    // two have the same root.
    if (std::string(GetParam().name) == "p3p") {
      EXPECT_EQ(count, distance > std::sqrt(2.0) ? 4u : 1u) << distance;
    }
    for (std::size_t k = 0; k < count; ++k) EXPECT_LT(rayError(poses[k], scene), 1e-10);
  }
}

TEST_P(P3p, SolvesIsoscelesTriangles) {
  const std::vector<double> found = errors(solver_test::instances(1000), 7, 1e-9, [](Generator& g) {
    const double x = gslam::randomUniform(g, 0.1, 2.0);
    const double z = gslam::randomUniform(g, 1.0, 5.0);
    const double y = gslam::randomUniform(g, -2.0, 2.0);
    return sceneOf(g,
                   {Vec3d{{x, 0, z}}, {{-x, 0, z}}, {{0, y, gslam::randomUniform(g, 1.0, 5.0)}}});
  });
  EXPECT_LE(partLost(found), GetParam().symmetric_lost);
}

// On the cylinder through the points, at right angles to their plane, two solutions fall together.
TEST_P(P3p, FindsDoubleSolutions) {
  const std::vector<double> found = errors(solver_test::instances(2000), 8, 1e-6, [](Generator& g) {
    const double pi = 3.14159265358979;
    std::array<Vec3d, 3> p;
    const double angle = gslam::randomUniform(g, -pi, pi);
    const Vec3d centre = {{std::cos(angle), std::sin(angle), gslam::randomUniform(g, 0.5, 3.0)}};
    const SO3d turn = gslam::randomOf<SO3d>(g);
    for (std::size_t i = 0; i < 3; ++i) {
      const double at = gslam::randomUniform(g, -0.8, 0.8) + 2 * pi / 3 * static_cast<double>(i);
      p[i] = turn * (Vec3d{{std::cos(at), std::sin(at), 0}} - centre);
    }
    return sceneOf(g, p);
  });
  EXPECT_LT(quantile(found, 0.5), 2e-7);
  EXPECT_LT(partLost(found, 1e-3), 0.01);
}

TEST_P(P3p, TakesMinimalCoordinates) {
  PoseScene scene;
  scene.points = {Vec3d{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}};
  scene.T_camera_world = SE3d(SO3d(), Vec3d{{0, 0, 1}});
  for (std::size_t i = 0; i < 3; ++i) {
    scene.bearings[i] = (scene.T_camera_world * scene.points[i]).normalized();
  }
  P3pPoses poses;
  const std::size_t count = solve(scene, poses);
  EXPECT_LT(errorOf(poses.data(), count, scene.T_camera_world), 1e-7);
}

TEST_P(P3p, GivesNoNumberThatIsNone) {
  Generator generator(9);
  P3pPoses poses;
  const auto check = [&](const PoseScene& scene) {
    const std::size_t count = solve(scene, poses);
    ASSERT_LE(count, 4u);
    for (std::size_t k = 0; k < count; ++k) EXPECT_TRUE(isFinite(poses[k]));
  };
  for (double odd : oddNumbers()) {
    for (std::size_t i = 0; i < 18; ++i) {
      PoseScene scene = randomPoseScene(generator);
      (i < 9 ? scene.points : scene.bearings)[i / 3 % 3][i % 3] = odd;
      check(scene);
      for (std::size_t k = 0; k < 3; ++k) {
        (i < 9 ? scene.points : scene.bearings)[k] = {{odd, i % 2 == 0 ? odd : 1, odd}};
      }
      check(scene);
    }
  }
  for (int i = 0; i < 100; ++i) {
    PoseScene scene = randomPoseScene(generator);
    scene.points[1] = scene.points[0];
    check(scene);
    scene.points[2] = scene.points[0];
    check(scene);
    scene = randomPoseScene(generator);
    scene.bearings[2] = scene.bearings[0];
    check(scene);
    scene.bearings[1] = scene.bearings[0];
    check(scene);
  }
}

TEST_P(P3p, RefusesOtherSizes) {
  Generator generator(10);
  const PoseScene scene = randomPoseScene(generator);
  P3pPoses poses;
  const Span<const Vec3d> bearings(scene.bearings), points(scene.points);
  EXPECT_THROW(GetParam().solve(bearings.subspan(1), points, poses), gslam::ArgumentError);
  EXPECT_THROW(GetParam().solve(bearings, points.subspan(1), poses), gslam::ArgumentError);
  EXPECT_THROW(GetParam().solve({}, {}, poses), gslam::ArgumentError);
}

// The distance of the third equation along the first ray, for one of the two roots that each of the
// others has.
struct AlongFirstRay {
  double m[3], squares[3];  // cosines and squared sides 01, 02, 12

  explicit AlongFirstRay(const PoseScene& s)
      : m{s.bearings[0].dot(s.bearings[1]), s.bearings[0].dot(s.bearings[2]),
          s.bearings[1].dot(s.bearings[2])},
        squares{(s.points[0] - s.points[1]).squaredNorm(),
                (s.points[0] - s.points[2]).squaredNorm(),
                (s.points[1] - s.points[2]).squaredNorm()} {}

  double operator()(double d, int branch, double& d1, double& d2) const {
    const double r1 = std::sqrt(squares[0] - d * d * (1 - m[0] * m[0]));
    const double r2 = std::sqrt(squares[1] - d * d * (1 - m[1] * m[1]));
    d1 = d * m[0] + (branch < 2 ? r1 : -r1);
    d2 = d * m[1] + (branch % 2 == 0 ? r2 : -r2);
    return d1 * d1 + d2 * d2 - 2 * m[2] * d1 * d2 - squares[2];
  }
};

TEST_P(P3p, FindsEverySolutionThatASearchFinds) {
  Generator generator(11);
  std::size_t searched = 0;
  for (std::size_t i = 0; i < solver_test::instances(100); ++i) {
    const PoseScene scene = randomPoseScene(generator);
    P3pPoses poses;
    const std::size_t count = solve(scene, poses);
    const AlongFirstRay function(scene);
    const double reach =
        std::min(std::sqrt(function.squares[0] / (1 - function.m[0] * function.m[0])),
                 std::sqrt(function.squares[1] / (1 - function.m[1] * function.m[1])));
    for (int branch = 0; branch < 4; ++branch) {
      double d1, d2, last = function(1e-9 * reach, branch, d1, d2);
      constexpr int kSteps = 1000;
      for (int step = 1; step < kSteps; ++step) {
        double low = reach * (step - 1) / kSteps, high = reach * step / kSteps;
        const double value = function(high, branch, d1, d2);
        const bool changes = (value > 0) != (last > 0);
        const bool rises = value > last;
        last = value;
        if (!changes) continue;
        for (int half = 0; half < 60; ++half) {
          const double middle = 0.5 * (low + high);
          ((function(middle, branch, d1, d2) > 0) == rises ? high : low) = middle;
        }
        function(low, branch, d1, d2);
        if (d1 <= 0 || d2 <= 0) continue;
        ++searched;
        double nearest = 1e9;
        for (std::size_t k = 0; k < count; ++k) {
          nearest = std::min(nearest, std::fabs((poses[k] * scene.points[0]).norm() - low) +
                                          std::fabs((poses[k] * scene.points[1]).norm() - d1) +
                                          std::fabs((poses[k] * scene.points[2]).norm() - d2));
        }
        EXPECT_LT(nearest, 1e-5) << "instance " << i << " depth " << low;
      }
    }
  }
  EXPECT_GT(searched, solver_test::instances(100));
}

#ifdef GSLAM_HAS_OPENCV
TEST_P(P3p, FindsWhatOpenCvFinds) {
  Generator generator(12);
  std::size_t found = 0, missed = 0;
  for (std::size_t i = 0; i < solver_test::instances(300); ++i) {
    const PoseScene scene = randomPoseScene(generator);
    P3pPoses poses;
    const std::size_t count = solve(scene, poses);
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d &p = scene.points[k], &x = scene.bearings[k];
      points.emplace_back(p[0], p[1], p[2]);
      pixels.emplace_back(x[0] / x[2], x[1] / x[2]);
    }
    for (int method : {int(cv::SOLVEPNP_AP3P), int(cv::SOLVEPNP_P3P)}) {
      std::vector<cv::Mat> rotations, translations;
      cv::solveP3P(points, pixels, cv::Matx33d::eye(), cv::noArray(), rotations, translations,
                   method);
      for (std::size_t k = 0; k < rotations.size(); ++k) {
        const cv::Vec3d r(rotations[k]), t(translations[k]);
        const SE3d pose(SO3d::exp({{r[0], r[1], r[2]}}), {{t[0], t[1], t[2]}});
        if (!(rayError(pose, scene) < 1e-7)) continue;  // theirs may be behind, or rough
        ++found;
        if (!(errorOf(poses.data(), count, pose) < 1e-4)) ++missed;
      }
    }
  }
  EXPECT_GT(found, 2 * solver_test::instances(300));
  EXPECT_LE(missed, found / 500);
}
#endif

INSTANTIATE_TEST_SUITE_P(
    Solvers, P3p,
    testing::Values(P3pSolver{"p3p", gslam::p3p, 0, 1e-10, 0.001, 0},
                    P3pSolver{"kneip", gslam::p3pKneip, 0.00033, 1e-10, 0.001, 0},
                    P3pSolver{"gao", gslam::p3pGao, 0.0031, 1e-10, 0.02, 0.01}),
    [](const testing::TestParamInfo<P3pSolver>& solver) { return std::string(solver.param.name); });

}  // namespace
