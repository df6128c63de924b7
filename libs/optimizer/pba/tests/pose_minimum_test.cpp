#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "pose_reference.h"
#include "pose_scene.h"
#include "pose_tools.h"
#include "solvers.h"

#ifdef GSLAM_HAS_OPENCV
#include <opencv2/calib3d.hpp>
#endif

namespace {

using gslam::Camera;
using gslam::LossKind;
using gslam::OptimizedPose;
using gslam::OptimizerOptions;
using gslam::OptimizerStatus;
using gslam::PoseProblem;
using gslam::SE3d;
using gslam::Vec3d;
using gslam::detail::pba::solvePose;
using pose_scene::makeScene;
using pose_scene::PoseScene;
using pose_tools::distance;
using pose_tools::kLosses;
using pose_tools::withLoss;

// With the default tolerances, too, the cost is that of the minimum.
void expectMinimum(PoseScene& scene, const gslam::PosePrior* prior, LossKind kind) {
  PoseProblem problem = scene.problem();
  problem.prior = prior;
  const OptimizerOptions options = withLoss(kind);
  const OptimizedPose result = solvePose(problem, scene.start, options);
  ASSERT_TRUE(result.is_usable);
  EXPECT_EQ(result.status, OptimizerStatus::Converged);
  const SE3d& pose = result.T_world_body;
  const auto full = pose_reference::at(problem, scene.start, pose, options.loss, 2);
  const double cost = static_cast<double>(full.cost);
  EXPECT_LE(pose_reference::aboveMinimum(full), 1e-12L * full.cost);
  EXPECT_NEAR(result.final_cost, cost, 1e-12 * cost);
  EXPECT_EQ(result.inliers, full.inliers);
  EXPECT_EQ(result.observations, full.seen);
  const auto weighted = pose_reference::at(problem, scene.start, pose, options.loss, 0);
  long double covariance[6][6];
  ASSERT_TRUE(pose_reference::invert(weighted.hessian, covariance));
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      const long double size = std::sqrt(covariance[i][i] * covariance[j][j]);
      EXPECT_NEAR(result.covariance(i, j), static_cast<double>(covariance[i][j]),
                  1e-8 * static_cast<double>(size));
    }
  }
}

TEST(pose, is_the_minimum_for_every_model_and_loss) {
  for (const Camera& camera : pose_scene::camerasOfAllModels()) {
    SCOPED_TRACE(camera.modelName());
    for (const LossKind kind : kLosses) {
      SCOPED_TRACE(gslam::nameOf(kind));
      PoseScene scene = makeScene({camera}, 60, 1.0, kind == LossKind::Squared ? 0.0 : 0.1);
      if (kind == LossKind::Tukey || kind == LossKind::GemanMcClure) {
        scene.start = scene.truth * SE3d::exp({0.003, 0.002, -0.003, 0.001, 0.001, -0.001});
      }
      expectMinimum(scene, nullptr, kind);
    }
  }
}

TEST(pose, is_the_minimum_for_rigs_stereo_information_and_priors) {
  PoseScene scene = makeScene({pose_scene::pinhole(), pose_scene::radtan(5),
                               pose_scene::camerasOfAllModels()[6], pose_scene::radtan(8)},
                              300, 1.0, 0.1);
  pose_scene::addRight(scene, 1.0);
  pose_scene::addInformation(scene);
  gslam::PosePrior prior{scene.truth * SE3d::exp({0.01, 0.01, 0, 0, 0, 0.01}),
                         1e4 * gslam::Mat<double, 6, 6>::identity()};
  for (const LossKind kind : {LossKind::Squared, LossKind::Huber, LossKind::Cauchy}) {
    expectMinimum(scene, nullptr, kind);
    expectMinimum(scene, &prior, kind);
  }
}

TEST(pose, finds_inliers_among_half_outliers) {
  for (const std::size_t n : {40u, 200u, 1000u}) {
    PoseScene scene = makeScene({pose_scene::pinhole()}, n, 0.5, 0.5);
    for (const LossKind kind : {LossKind::Huber, LossKind::Cauchy, LossKind::GemanMcClure}) {
      SCOPED_TRACE(gslam::nameOf(kind));
      const OptimizedPose coarse = solvePose(scene.problem(), scene.start, withLoss(kind, 2));
      ASSERT_TRUE(coarse.is_usable);
      const OptimizedPose fine =
          solvePose(scene.problem(), coarse.T_world_body, withLoss(LossKind::Tukey, 10));
      ASSERT_TRUE(fine.is_usable);
      EXPECT_LT(distance(fine.T_world_body, scene.truth), 0.2 / std::sqrt(double(n)));
      EXPECT_NEAR(double(fine.inliers), 0.5 * double(n), 3.5 * std::sqrt(0.25 * double(n)));
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3d p = fine.T_world_body.inverse() * scene.points[i];
        gslam::Vec2d pixel{};
        ASSERT_TRUE(scene.cameras[0].project(p, pixel));
        const double s = (pixel - scene.pixels[i]).squaredNorm() / 100;
        EXPECT_EQ(scene.inliers[i], s < 1 - std::sqrt(0.5) ? 1 : 0);
      }
    }
  }
}

TEST(pose, converges_from_far) {
  std::size_t found = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    PoseScene scene = makeScene({pose_scene::pinhole()}, 50, 0.5, 0, seed);
    scene.start = scene.truth * SE3d::exp({0.5, -0.6, 0.4, 0.2, -0.3, 0.25});
    const OptimizedPose result = solvePose(scene.problem(), scene.start, {});
    EXPECT_TRUE(result.is_usable);
    EXPECT_LE(result.final_cost, result.initial_cost);
    if (distance(result.T_world_body, scene.truth) < 0.02) ++found;
  }
  EXPECT_GE(found, 45u);
}

#ifdef GSLAM_HAS_OPENCV
TEST(pose, is_where_opencv_ends) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Camera camera =
        Camera::fromParameters("radtan", 640, 480, {400, 410, 320, 240, -0.2, 0.03, 1e-3, -2e-3});
    PoseScene scene = makeScene({camera}, 100, 1, 0, seed);
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      points.emplace_back(scene.points[i][0], scene.points[i][1], scene.points[i][2]);
      pixels.emplace_back(scene.pixels[i][0], scene.pixels[i][1]);
    }
    const SE3d T = scene.start.inverse();
    const Vec3d v = T.rotation().log(), t = T.translation();
    cv::Mat rvec = (cv::Mat_<double>(3, 1) << v[0], v[1], v[2]);
    cv::Mat tvec = (cv::Mat_<double>(3, 1) << t[0], t[1], t[2]);
    const cv::Matx33d k(400, 0, 320, 0, 410, 240, 0, 0, 1);
    cv::solvePnPRefineLM(points, pixels, k, std::vector<double>{-0.2, 0.03, 1e-3, -2e-3}, rvec,
                         tvec, cv::TermCriteria(3, 100, 1e-14));
    const SE3d other(gslam::SO3d::exp({rvec.at<double>(0), rvec.at<double>(1), rvec.at<double>(2)}),
                     {tvec.at<double>(0), tvec.at<double>(1), tvec.at<double>(2)});
    const OptimizedPose result = solvePose(scene.problem(), scene.start, {});
    EXPECT_LT(distance(result.T_world_body, other.inverse()), 1e-6);
    const double cost = static_cast<double>(
        pose_reference::at(scene.problem(), scene.start, other.inverse(), {}, 0).cost);
    EXPECT_LE(result.final_cost, cost * (1 + 1e-12));
  }
}
#endif

}  // namespace
