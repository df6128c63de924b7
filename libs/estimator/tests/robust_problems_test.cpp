// The mathematics of the robust problems: kernels of all variants, derivatives, surfaces.
#include <gslam/base/simd.h>
#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "robust/bearing_frame.h"
#include "robust/epipolar_matches.h"
#include "robust/essential_problem.h"
#include "robust/fundamental_problem.h"
#include "robust/pose_problem.h"
#include "robust_scenes.h"

namespace {

using namespace gslam;          // NOLINT(google-build-using-namespace)
using namespace gslam::detail;  // NOLINT(google-build-using-namespace)
using namespace robust_test;    // NOLINT(google-build-using-namespace)

struct Rays {
  std::vector<Vec3d> first, second;
  std::vector<Mat<double, 3, 2>> first_by_pixel, second_by_pixel;
};

Rays raysOf(const MatchedPixels& views, const Camera& camera) {
  Rays rays;
  rays.first.resize(views.first.size());
  rays.second.resize(views.first.size());
  rays.first_by_pixel.resize(views.first.size());
  rays.second_by_pixel.resize(views.first.size());
  for (std::size_t i = 0; i < views.first.size(); ++i) {
    EXPECT_TRUE(camera.unproject(views.first[i], rays.first[i], &rays.first_by_pixel[i]));
    EXPECT_TRUE(camera.unproject(views.second[i], rays.second[i], &rays.second_by_pixel[i]));
  }
  return rays;
}

// One set of matches of each kind.
std::vector<EpipolarMatches> allKinds(Generator& generator, const SceneRecipe& scene, SE3d* poses) {
  std::vector<EpipolarMatches> all;
  const RandomOrder order = randomOrder(scene.count, 3);
  const MatchedPixels flat = makeMatchedPixels(generator, pinhole(), unequalPinhole(), scene);
  const MatchedPixels round = makeMatchedPixels(generator, fisheye(), fisheye(), scene);
  const Rays rays = raysOf(round, fisheye());
  all.push_back(
      EpipolarMatches::fromPinholes(flat.first, flat.second, pinhole(), unequalPinhole(), order));
  all.push_back(EpipolarMatches::fromBearings(rays.first, rays.second, order));
  all.push_back(EpipolarMatches::fromFrames(rays.first, rays.second, rays.first_by_pixel,
                                            rays.second_by_pixel, order));
  poses[0] = flat.T_second_first;
  poses[1] = poses[2] = round.T_second_first;
  return all;
}

// J^T J and J^T r of numeric derivatives of sqrt-free residuals: the gradient of half the cost.
void expectNormalEquations(const Problem& problem, const ModelNumbers& model,
                           const std::vector<double>& weights, double tolerance) {
  const auto costAt = [&](const ModelNumbers& m) {
    NormalEquations sums;
    problem.accumulate(m, weights.data(), weights.size(), sums);
    return sums.cost;
  };
  NormalEquations sums;
  problem.accumulate(model, weights.data(), weights.size(), sums);
  double scale = 0;
  for (std::size_t k = 0; k < problem.dof(); ++k) {
    scale = std::max(scale, std::sqrt(sums.hessian[k * kMaxDof + k] * sums.cost));
  }
  for (std::size_t k = 0; k < problem.dof(); ++k) {
    std::vector<double> delta(problem.dof());
    const double step = 1e-6;
    delta[k] = step;
    const double more = costAt(problem.retract(model, delta.data()));
    delta[k] = -step;
    const double less = costAt(problem.retract(model, delta.data()));
    EXPECT_NEAR(sums.gradient[k], (more - less) / (4 * step), tolerance * scale) << k;
  }
}

// Single matches: sqrt of the cost is the residual, so the Hessian is that of its derivative.
void expectHessian(const Problem& problem, const ModelNumbers& model, std::size_t match) {
  std::vector<double> weights(problem.size());
  weights[match] = 1;
  NormalEquations sums;
  problem.accumulate(model, weights.data(), weights.size(), sums);
  for (std::size_t k = 0; k < problem.dof(); ++k) {
    // gradient = r J and hessian = J^2 for a residual of one dimension
    EXPECT_NEAR(sums.hessian[k * kMaxDof + k] * sums.cost, sums.gradient[k] * sums.gradient[k],
                1e-9 * (1 + sums.gradient[k] * sums.gradient[k]));
  }
}

TEST(RobustProblemsTest, ScoresAreExactResidualsInEveryVariant) {
  Generator generator(1);
  SceneRecipe scene;
  scene.count = 203;
  SE3d poses[3];
  const std::vector<EpipolarMatches> all = allKinds(generator, scene, poses);
  for (const Simd variant : availableSimd()) {
    const ScopedSimd scoped(variant);
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const ModelNumbers model =
          EssentialProblem::modelOf(poses[kind].rotation(), poses[kind].translation());
      Mat3d e;
      std::copy(model.begin(), model.begin() + 9, e.values);
      const Mat3d lines = all[kind].linesOf(e);
      std::vector<float> squared(scene.count, -1);
      const EssentialProblem problem(all[kind], 1);
      problem.squaredResiduals(model, 0, 100, squared.data());
      problem.squaredResiduals(model, 100, 103, squared.data() + 100);
      for (std::size_t i = 0; i < scene.count; ++i) {
        const double exact = std::sqrt(all[kind].squared(lines.values, i));
        const double unit = kind == 1 ? 1e-6 : 5e-3;  // radians, pixels
        EXPECT_NEAR(std::sqrt(squared[i]), exact, unit + 1e-4 * exact) << kind << ' ' << i;
      }
    }
  }
}

// Sampson's error is the length of the least correction, to first order: of small errors it is that
// of the best correction there is, found by search along the gradient with Newton's method.
TEST(RobustProblemsTest, SampsonIsTheLeastCorrectionOfPixels) {
  Generator generator(2);
  SceneRecipe scene;
  scene.outliers = 0;
  scene.sigma = 0.1;
  const Camera camera = fisheye();
  const MatchedPixels views = makeMatchedPixels(generator, camera, camera, scene);
  const Rays rays = raysOf(views, camera);
  const RandomOrder order = randomOrder(scene.count, 3);
  const EpipolarMatches matches = EpipolarMatches::fromFrames(
      rays.first, rays.second, rays.first_by_pixel, rays.second_by_pixel, order);
  const SE3d& pose = views.T_second_first;
  const Mat3d e = SO3d::hat(pose.translation()) * pose.rotation().matrix();
  for (std::size_t i = 0; i < scene.count; ++i) {
    Vec2d p[2] = {views.first[order[i]], views.second[order[i]]};
    const Vec2d start[2] = {p[0], p[1]};
    for (int step = 0; step < 5; ++step) {  // projects on the linearised surface, from the start
      Vec3d a, b;
      Mat<double, 3, 2> ja, jb;
      ASSERT_TRUE(camera.unproject(p[0], a, &ja) && camera.unproject(p[1], b, &jb));
      const Vec2d ga = ja.transpose() * (e.transpose() * b), gb = jb.transpose() * (e * a);
      const double value = b.dot(e * a) + ga.dot(start[0] - p[0]) + gb.dot(start[1] - p[1]);
      const double factor = value / (ga.squaredNorm() + gb.squaredNorm());
      p[0] = start[0] - factor * ga;
      p[1] = start[1] - factor * gb;
    }
    const double least = (p[0] - start[0]).squaredNorm() + (p[1] - start[1]).squaredNorm();
    EXPECT_NEAR(std::sqrt(matches.squared(e.values, i)), std::sqrt(least), 1e-2 * std::sqrt(least));
  }
}

TEST(RobustProblemsTest, DerivativesOfEssentialMatricesAreThoseOfTheCost) {
  Generator generator(3);
  SceneRecipe scene;
  scene.count = 70;
  SE3d poses[3];
  const std::vector<EpipolarMatches> all = allKinds(generator, scene, poses);
  for (const Simd variant : availableSimd()) {
    const ScopedSimd scoped(variant);
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const EssentialProblem problem(all[kind], 1);
      const ModelNumbers model =
          EssentialProblem::modelOf(poses[kind].rotation(), poses[kind].translation());
      std::vector<double> weights(scene.count);
      for (double& w : weights) w = randomUniform<double>(generator, -0.3, 1);
      expectNormalEquations(problem, model, weights, 1e-6);
      for (std::size_t i = 0; i < scene.count; i += 7) expectHessian(problem, model, i);
    }
  }
}

TEST(RobustProblemsTest, DerivativesOfFundamentalMatricesAreThoseOfTheCost) {
  Generator generator(4);
  SceneRecipe scene;
  scene.count = 70;
  const MatchedPixels views = makeMatchedPixels(generator, pinhole(), pinhole(), scene);
  const EpipolarMatches matches =
      EpipolarMatches::fromPoints(views.first, views.second, randomOrder(scene.count, 1));
  const FundamentalProblem problem(matches);
  for (int trial = 0; trial < 20; ++trial) {
    ModelNumbers model{};
    for (std::size_t k = 0; k < 9; ++k) model[k] = randomNormal<double, 1>(generator)[0];
    ASSERT_TRUE(toRankTwo(model.data()));
    std::vector<double> weights(scene.count);
    for (double& w : weights) w = randomUniform<double>(generator, -0.3, 1);
    expectNormalEquations(problem, model, weights, 1e-6);
    expectHessian(problem, model, 5);
  }
}

TEST(RobustProblemsTest, TangentsOfRankTwoAreOrthonormalAndStayOnTheSurface) {
  Generator generator(5);
  for (int trial = 0; trial < 100; ++trial) {
    double f[9];
    for (double& x : f) x = randomNormal<double, 1>(generator)[0];
    ASSERT_TRUE(toRankTwo(f));
    Mat3d m;
    std::copy(f, f + 9, m.values);
    EXPECT_NEAR(m.row(0).dot(m.row(1).cross(m.row(2))), 0, 1e-15);
    const Mat<double, 9, 7> t = rankTwoTangents(f);
    const Mat<double, 7, 7> square = t.transpose() * t;
    for (std::size_t r = 0; r < 7; ++r) {
      for (std::size_t c = 0; c < 7; ++c) EXPECT_NEAR(square(r, c), r == c ? 1 : 0, 1e-13);
      double along = 0;
      for (std::size_t k = 0; k < 9; ++k) along += f[k] * t(k, r);
      EXPECT_NEAR(along, 0, 1e-13);
      // The determinant changes by the second order only.
      const double step = 1e-5;
      Mat3d moved = m;
      for (std::size_t k = 0; k < 9; ++k) moved.values[k] += step * t(k, r);
      EXPECT_NEAR(moved.row(0).dot(moved.row(1).cross(moved.row(2))), 0, 10 * step * step);
    }
  }
}

TEST(RobustProblemsTest, FactorsOfEssentialMatricesMultiplyBack) {
  Generator generator(6);
  for (int trial = 0; trial < 1000; ++trial) {
    const SO3d rotation = randomOf<SO3d>(generator);
    const Vec3d t = randomDirection<double>(generator);
    const Mat3d e = SO3d::hat(t) * rotation.matrix() * randomUniform<double>(generator, -5, 5);
    SO3d rotations[2];
    Vec3d found;
    ASSERT_TRUE(factoriseEssential(e, rotations, found));
    EXPECT_NEAR(std::abs(found.dot(t)), 1, 1e-12);
    EXPECT_NEAR(std::min((rotations[0].inverse() * rotation).angle(),
                         (rotations[1].inverse() * rotation).angle()),
                0, 1e-7);
  }
  SO3d rotations[2];
  Vec3d found;
  EXPECT_FALSE(factoriseEssential(Mat3d{}, rotations, found));
  Mat3d bad{};
  bad(0, 0) = std::nan("");
  EXPECT_FALSE(factoriseEssential(bad, rotations, found));
}

TEST(RobustProblemsTest, OtherPosesOfAPlaneHaveTheSameHomography) {
  Generator generator(7);
  int others = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const SO3d rotation = SO3d::exp(0.5 * randomDirection<double>(generator));
    const Vec3d t = randomUniform<double>(generator, 0.05, 2) * randomDirection<double>(generator);
    const Vec3d n = randomUniform<double>(generator, 0.1, 0.4) * randomDirection<double>(generator);
    SE3d poses[2];
    const std::size_t count = otherPosesOfPlane(rotation, t, n, poses);
    for (std::size_t k = 0; k < count; ++k) {
      // H = R' + t' n'^T: R'^T H - I has rank 1 along R'^T t'.
      const Mat3d h = rotation.matrix() + outer(t, n);
      const Mat3d rest = h - poses[k].rotation().matrix();
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_LT(rest.col(c).cross(poses[k].translation()).norm(), 1e-9);
      }
      others += (poses[k].rotation().inverse() * rotation).angle() > 1e-6;
    }
  }
  EXPECT_GT(others, 900);
}

TEST(RobustProblemsTest, ScoresAndDerivativesOfPosesAreExact) {
  Generator generator(8);
  SceneRecipe scene;
  scene.count = 101;
  scene.sigma = 0.3;
  for (const Camera& camera : {unequalPinhole(), radtan(), fisheye(), panorama()}) {
    const PosedPoints posed = makePosedPoints(generator, camera, scene);
    std::vector<PoseObservation> observations(scene.count);
    for (std::size_t i = 0; i < scene.count; ++i) {
      Mat<double, 3, 2> by_pixel;
      observations[i].pixel = posed.pixels[i];
      ASSERT_TRUE(camera.unproject(posed.pixels[i], observations[i].bearing, &by_pixel));
      observations[i].frame = frameOfPixel(by_pixel);
    }
    RandomOrder order(scene.count);
    for (std::uint32_t i = 0; i < scene.count; ++i) order[i] = i;
    const PoseProblem problem(observations, posed.points, {{&camera, SE3d(), SE3d()}}, order);
    // The truth about the mean of the points.
    Vec3d mean{};
    for (const Vec3d& p : posed.points) mean += p / static_cast<double>(scene.count);
    const SE3d centred(posed.T_world_camera.rotation(), posed.T_world_camera.translation() - mean);
    const SE3d inverse = centred.inverse();
    ModelNumbers model{};
    std::copy(inverse.data(), inverse.data() + 7, model.begin());
    EXPECT_TRUE(problem.worldPoseOf(model).isApprox(posed.T_world_camera, 1e-9));
    std::vector<double> exact(scene.count);
    problem.exactSquaredResiduals(model, exact.data());
    for (const Simd variant : availableSimd()) {
      const ScopedSimd scoped(variant);
      std::vector<float> squared(scene.count);
      problem.squaredResiduals(model, 0, scene.count, squared.data());
      std::vector<double> weights(scene.count);
      for (std::size_t i = 0; i < scene.count; ++i) {
        if (!(exact[i] < 9)) continue;
        weights[i] = randomUniform<double>(generator, 0, 1);
        EXPECT_NEAR(std::sqrt(squared[i]), std::sqrt(exact[i]), 0.02) << camera.modelName();
      }
      expectNormalEquations(problem, model, weights, 1e-6);
    }
    // From the camera's own projection, numerically: the derivative by the right tangent.
    std::vector<double> weights(scene.count);
    weights[3] = exact[3] < 9 ? 1 : 0;
    NormalEquations sums;
    problem.accumulate(model, weights.data(), weights.size(), sums);
    EXPECT_NEAR(sums.cost, weights[3] * exact[3], 0.01);
  }
}

}  // namespace
