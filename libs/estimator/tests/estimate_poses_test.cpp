// Poses of cameras and of rigs among outliers, end to end.
#include <gslam/estimator/estimate_absolute_pose.h>
#include <gslam/estimator/estimate_rig_pose.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include "robust_scenes.h"

namespace {

using namespace gslam;        // NOLINT(google-build-using-namespace)
using namespace robust_test;  // NOLINT(google-build-using-namespace)

std::vector<Camera> cameras() {
  return {pinhole(), unequalPinhole(), radtan(), fisheye(), panorama()};
}

void expectRight(const Estimate<SE3d, 6>& found, const SE3d& truth, const char* what) {
  ASSERT_EQ(found.status, EstimateStatus::Ok) << what << ' ' << found.message;
  EXPECT_LT(rotationError(found.model, truth), 0.5 * kDegree) << what;
  EXPECT_LT((found.model.translation() - truth.translation()).norm(), 0.1) << what;
}

TEST(EstimateAbsolutePoseTest, FindsThePoseForAllCameras) {
  for (const Camera& camera : cameras()) {
    for (const Vec3d& origin : {Vec3d{0, 0, 0}, Vec3d{4.5e5, 5.1e6, 312}}) {  // UTM
      Generator generator(1);
      for (int trial = 0; trial < trials(5); ++trial) {
        const PosedPoints posed = makePosedPoints(generator, camera, SceneRecipe(), origin);
        const AbsolutePoseEstimate found = estimateAbsolutePose(posed.pixels, camera, posed.points);
        expectRight(found, posed.T_world_camera, camera.modelName().c_str());
        EXPECT_EQ(found.degeneracy, Degeneracy::None);
        for (std::size_t i = 0; i < posed.points.size(); ++i) {  // the mask, from the definition
          Vec2d pixel;
          Vec3d bearing;
          if (!camera.unproject(posed.pixels[i], bearing)) {
            EXPECT_EQ(found.inliers[i], 0);
            continue;
          }
          const Vec3d in_camera = found.model.inverse() * posed.points[i];
          const bool is_seen = camera.project(in_camera, pixel);
          const double residual = is_seen ? (pixel - posed.pixels[i]).norm() : 1e9;
          if (std::abs(residual - found.threshold) < 1e-5) continue;
          EXPECT_EQ(found.inliers[i] != 0, residual < found.threshold)
              << residual << camera.modelName();
        }
        const AbsolutePoseEstimate by_bearings = [&] {
          EstimateOptions options;
          options.threshold = 0.02;
          return estimateAbsolutePose(bearingsOf(camera, posed.pixels), posed.points, options);
        }();
        expectRight(by_bearings, posed.T_world_camera, camera.modelName().c_str());
      }
    }
  }
}

TEST(EstimateAbsolutePoseTest, PlanesAreAsGood) {
  Generator generator(2);
  SceneRecipe scene;
  scene.planar = 1;
  for (int trial = 0; trial < trials(10); ++trial) {
    const PosedPoints posed = makePosedPoints(generator, pinhole(), scene);
    const AbsolutePoseEstimate found = estimateAbsolutePose(posed.pixels, pinhole(), posed.points);
    ASSERT_TRUE(found.ok());
    EXPECT_LT(rotationError(found.model, posed.T_world_camera), 1 * kDegree);
  }
}

TEST(EstimateAbsolutePoseTest, FlagsLinesAndSinglePoints) {
  Generator generator(3);
  for (int trial = 0; trial < trials(10); ++trial) {
    PosedPoints posed = makePosedPoints(generator, pinhole(), SceneRecipe());
    const SE3d inverse = posed.T_world_camera.inverse();
    const Vec3d a = posed.T_world_camera * Vec3d{-2, -1, 6};
    const Vec3d b = posed.T_world_camera * Vec3d{2, 1.5, 9};
    for (std::size_t i = 0; i < posed.points.size(); ++i) {
      const double s = randomUniform<double>(generator, 0, 1);
      posed.points[i] = (1 - s) * a + s * b;
      if (posed.is_true[i] == 0) continue;
      pinhole().project(inverse * posed.points[i], posed.pixels[i]);
      posed.pixels[i] += noise(generator, 1);
    }
    AbsolutePoseEstimate found = estimateAbsolutePose(posed.pixels, pinhole(), posed.points);
    EXPECT_EQ(found.status, EstimateStatus::Degenerate) << found.message;
    EXPECT_EQ(found.degeneracy, Degeneracy::Collinear) << found.message;
    // Only the inliers on the line.
    for (std::size_t i = 100; i < 200; ++i) {
      posed.points[i] = posed.T_world_camera *
                        (3 * randomOf<SE3d>(generator, 1.0).translation() + Vec3d{0, 0, 8});
    }
    found = estimateAbsolutePose(posed.pixels, pinhole(), posed.points);
    EXPECT_FALSE(found.ok()) << found.message;
    std::fill(posed.points.begin(), posed.points.end(), a);
    found = estimateAbsolutePose(posed.pixels, pinhole(), posed.points);
    EXPECT_EQ(found.degeneracy, Degeneracy::Coincident) << found.message;
  }
}

TEST(EstimateAbsolutePoseTest, CovarianceIsThatOfManyTrials) {
  SceneRecipe scene;
  scene.outliers = 0;
  scene.sigma = 0;
  scene.count = 100;
  for (const Camera& camera : {pinhole(), radtan(), fisheye()}) {
    Generator generator(4);
    const PosedPoints clean = makePosedPoints(generator, camera, scene);
    EstimateOptions options;
    options.threshold = 6;
    Vec<double, 6> squares{}, predicted{};
    const int count = 200;
    for (int trial = 0; trial < count; ++trial) {
      std::vector<Vec2d> pixels = clean.pixels;
      for (Vec2d& p : pixels) p += noise(generator, 1);
      const AbsolutePoseEstimate found =
          estimateAbsolutePose(pixels, camera, clean.points, options);
      ASSERT_TRUE(found.ok());
      const SE3d::Tangent error = (clean.T_world_camera.inverse() * found.model).log();
      for (std::size_t k = 0; k < 6; ++k) {
        squares[k] += error[k] * error[k] / count;
        predicted[k] += found.covariance(k, k) / count;
      }
    }
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_LT(squares[k], 2 * predicted[k]) << camera.modelName() << k;
      EXPECT_GT(squares[k], predicted[k] / 2) << camera.modelName() << k;
    }
  }
}

TEST(EstimateAbsolutePoseTest, NeverCallsAWrongPoseOk) {
  EstimateOptions options;
  options.max_iterations = 100;
  for (const double outliers : {0.9, 1.0}) {
    Generator generator(5);
    SceneRecipe scene;
    scene.outliers = outliers;
    for (int trial = 0; trial < trials(50); ++trial) {
      const PosedPoints posed = makePosedPoints(generator, pinhole(), scene);
      const AbsolutePoseEstimate found =
          estimateAbsolutePose(posed.pixels, pinhole(), posed.points, options);
      if (!found.ok()) continue;
      EXPECT_LT(outliers, 1) << found.message;
      EXPECT_LT(rotationError(found.model, posed.T_world_camera), 3 * kDegree) << found.message;
    }
  }
}

struct RigScene {
  std::vector<RigCamera> cameras;
  std::vector<std::uint32_t> camera_of_point;
  std::vector<Vec2d> pixels;
  std::vector<Vec3d> points;
  std::vector<Vec3d> origins, bearings;  // in the rig
  SE3d T_world_rig;
};

RigScene makeRig(Generator& generator, double reach, const Vec3d& origin) {
  RigScene rig;
  for (const Camera& camera : {pinhole(), radtan(), fisheye()}) {
    rig.cameras.push_back({camera, randomOf<SE3d>(generator, reach)});
    if (reach == 0) rig.cameras.back().T_rig_camera.setTranslation({0, 0, 0});
  }
  rig.T_world_rig = randomOf<SE3d>(generator, 5.0);
  rig.T_world_rig.setTranslation(rig.T_world_rig.translation() + origin);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const std::uint32_t c = i % 3;
    const Camera& camera = rig.cameras[c].camera;
    Vec3d bearing;
    Vec2d pixel = seenPixel(generator, camera, bearing);
    const double depth = randomUniform<double>(generator, 4, 12);
    rig.points.push_back(rig.T_world_rig * (rig.cameras[c].T_rig_camera * (depth * bearing)));
    Vec3d unused;
    pixel = i < 120 ? pixel + noise(generator, 0.5) : seenPixel(generator, camera, unused);
    rig.pixels.push_back(pixel);
    rig.camera_of_point.push_back(c);
    if (!camera.unproject(pixel, bearing)) bearing = {0, 0, 1};
    rig.origins.push_back(rig.cameras[c].T_rig_camera.translation());
    rig.bearings.push_back(rig.cameras[c].T_rig_camera.rotation() * bearing);
  }
  return rig;
}

TEST(EstimateRigPoseTest, FindsThePose) {
  for (const Vec3d& origin : {Vec3d{0, 0, 0}, Vec3d{4.5e5, 5.1e6, 312}}) {
    for (const double reach : {0.0, 1e-3, 0.1, 1.0}) {
      Generator generator(6);
      for (int trial = 0; trial < trials(4); ++trial) {
        const RigScene rig = makeRig(generator, reach, origin);
        const RigPoseEstimate found =
            estimateRigPose(rig.cameras, rig.camera_of_point, rig.pixels, rig.points);
        expectRight(found, rig.T_world_rig, "rig");
        for (std::size_t i = 0; i < rig.points.size(); ++i) {
          const RigCamera& c = rig.cameras[rig.camera_of_point[i]];
          Vec2d pixel;
          const bool is_seen =
              c.camera.project((found.model * c.T_rig_camera).inverse() * rig.points[i], pixel);
          const double residual = is_seen ? (pixel - rig.pixels[i]).norm() : 1e9;
          if (std::abs(residual - found.threshold) < 1e-5) continue;
          EXPECT_EQ(found.inliers[i] != 0, residual < found.threshold) << residual;
        }
        EstimateOptions options;
        options.threshold = 0.01;
        expectRight(estimateRigPose(rig.origins, rig.bearings, rig.points, options),
                    rig.T_world_rig, "rays");
      }
    }
  }
}

TEST(EstimateRigPoseTest, AnswersBadInputWithAStatus) {
  Generator generator(7);
  RigScene rig = makeRig(generator, 1, {0, 0, 0});
  rig.camera_of_point[17] = 3;
  RigPoseEstimate found = estimateRigPose(rig.cameras, rig.camera_of_point, rig.pixels, rig.points);
  EXPECT_EQ(found.status, EstimateStatus::InvalidInput);
  EXPECT_NE(found.message.find("camera_of_point[17]"), std::string::npos) << found.message;
  rig.camera_of_point[17] = 2;
  rig.cameras[1].camera = Camera();
  EXPECT_EQ(estimateRigPose(rig.cameras, rig.camera_of_point, rig.pixels, rig.points).status,
            EstimateStatus::InvalidInput);
  rig.bearings[3] = {0, 0, 0};
  EXPECT_EQ(estimateRigPose(rig.origins, rig.bearings, rig.points).status,
            EstimateStatus::InvalidInput);
  rig.origins.pop_back();
  EXPECT_EQ(estimateRigPose(rig.origins, rig.bearings, rig.points).status,
            EstimateStatus::InvalidInput);
}

TEST(EstimateAbsolutePoseTest, ThreadsAndOrderDoNotMatter) {
  Generator generator(8);
  SceneRecipe scene;
  scene.sigma = 0.3;
  const PosedPoints posed = makePosedPoints(generator, fisheye(), scene);
  EstimateOptions options;
  const AbsolutePoseEstimate one =
      estimateAbsolutePose(posed.pixels, fisheye(), posed.points, options);
  options.threads = 3;
  const AbsolutePoseEstimate three =
      estimateAbsolutePose(posed.pixels, fisheye(), posed.points, options);
  ASSERT_TRUE(one.ok());
  EXPECT_EQ(std::memcmp(one.model.data(), three.model.data(), 7 * sizeof(double)), 0);
  EXPECT_EQ(one.inliers, three.inliers);
  std::vector<std::size_t> order(posed.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), generator);
  PosedPoints shuffled = posed;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.pixels[i] = posed.pixels[order[i]];
    shuffled.points[i] = posed.points[order[i]];
  }
  const AbsolutePoseEstimate other =
      estimateAbsolutePose(shuffled.pixels, fisheye(), shuffled.points);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(other.inliers[i], one.inliers[order[i]]);
}

TEST(EstimateAbsolutePoseTest, AnswersBadInputWithAStatus) {
  const std::vector<Vec2d> two(2), four(4);
  std::vector<Vec3d> points(4), two_points(2);
  EXPECT_EQ(estimateAbsolutePose(two, pinhole(), two_points).status, EstimateStatus::TooFewPoints);
  EXPECT_EQ(estimateAbsolutePose(two, pinhole(), points).status, EstimateStatus::InvalidInput);
  EXPECT_EQ(estimateAbsolutePose(four, Camera(), points).status, EstimateStatus::InvalidInput);
  EXPECT_FALSE(estimateAbsolutePose(four, pinhole(), points).ok());
  points[1][2] = INFINITY;
  EXPECT_EQ(estimateAbsolutePose(four, pinhole(), points).status, EstimateStatus::InvalidInput);
}

}  // namespace
