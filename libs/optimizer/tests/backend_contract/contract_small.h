// Poses from points, alignments, two views, and covariances of bundles.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_SMALL_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_SMALL_H

#include "fixture.h"

namespace backend_contract {

/// One pose of a bundle whose points are known, as a PoseProblem.
struct PoseScene {
  BundleScene bundle;
  std::vector<Vec3d> points;
  std::vector<double> information, right_u;
  std::vector<std::uint8_t> inliers;
  gslam::PosePrior prior;
  bool has_prior = false;
  double baseline = 0.2;

  explicit PoseScene(const Camera& camera = pinhole(), std::size_t n = 50)
      : bundle(bundleScene(1, n, 0, camera)), inliers(n) {
    update();
  }
  /// After a change of what is observed.
  void update() {
    points.clear();
    for (const std::uint32_t i : bundle.of_point) points.push_back(bundle.points[i]);
    inliers.assign(points.size(), 2);
  }
  gslam::PoseProblem problem() {
    gslam::PoseProblem views;
    views.points = points;
    views.pixels = bundle.pixels;
    views.information = information;
    views.right_u = right_u;
    views.baseline = baseline;
    views.cameras = bundle.cameras;
    views.T_body_camera = bundle.extrinsics;
    views.camera_of = bundle.of_camera;
    views.inliers = inliers;
    views.prior = has_prior ? &prior : nullptr;
    return views;
  }
  /// By the plain formulas.
  double cost(const SE3d& pose, const gslam::RobustLoss& loss) {
    bundle.poses = {pose};
    bundle.pose_fixed.clear();
    bundle.point_fixed.assign(bundle.points.size(), 1);
    bundle.information.clear();
    for (const double w : information) bundle.information.push_back({w, 0, w});
    bundle.right_u = right_u;
    bundle.baseline.assign(bundle.cameras.size(), baseline);
    if (has_prior) bundle.pose_priors = {{0, prior.pose, prior.information}};
    return bundleCost(bundle.problem(), loss);
  }
  SE3d start(double off) const {
    return bundle.true_poses[0] * SE3d::exp({off, -off, off / 2, -off / 3, off / 4, off / 5});
  }
};

/// Solves, and compares what is said of it with the plain formulas. Its worst error.
inline double solvePoseChecked(PoseScene& scene, double off,
                               const gslam::OptimizerOptions& options) {
  const SE3d start = scene.start(off);
  const gslam::OptimizedPose found = optimizePose(scene.problem(), start, options);
  EXPECT_TRUE(found.is_usable) << nameOf(found.status);
  const double initial = scene.cost(start, options.loss);
  const double cost = scene.cost(found.T_world_body, options.loss);
  EXPECT_NEAR(found.initial_cost, initial, 1e-9 * initial + 1e-16);
  EXPECT_NEAR(found.final_cost, cost, 1e-9 * cost + 1e-16);
  EXPECT_LE(found.final_cost, found.initial_cost);
  std::size_t inliers = 0;
  for (const std::uint8_t is_inlier : scene.inliers) {
    EXPECT_LE(is_inlier, 1);
    inliers += is_inlier;
  }
  EXPECT_EQ(found.inliers, inliers);
  EXPECT_LE(found.inliers, found.observations);
  return (scene.bundle.true_poses[0].inverse() * found.T_world_body).log().norm();
}

}  // namespace backend_contract

TEST_P(BackendContract, solves_poses_of_every_camera_model) {
  using namespace backend_contract;
  NEEDS_FUNCTION(pose);
  const std::vector<Camera> cameras = {
      pinhole(),
      Camera::fromParameters("radtan", 640, 480, {420, 425, 320, 240, -0.1, 0.02, 0.001, -0.002}),
      Camera::fromParameters("kannala_brandt", 640, 480,
                             {260, 262, 320, 240, 0.01, -0.005, 0.002, -0.001}),
      Camera::fromParameters("equirectangular", 1024, 512, {})};
  for (const Camera& camera : cameras) {
    for (const std::size_t n : {3u, 4u, 17u, 200u}) {
      SCOPED_TRACE(camera.modelName() + " " + std::to_string(n));
      PoseScene scene(camera, n);
      EXPECT_LT(solvePoseChecked(scene, n < 5 ? 0.01 : 0.2, options()), 1e-6);
      EXPECT_EQ(std::count(scene.inliers.begin(), scene.inliers.end(), 1),
                static_cast<std::ptrdiff_t>(n));
    }
  }
}

TEST_P(BackendContract, finds_the_inliers_of_a_pose) {
  using namespace backend_contract;
  NEEDS_FUNCTION(pose);
  for (const gslam::RobustLoss& loss : allLosses()) {
    SCOPED_TRACE(nameOf(loss.kind));
    PoseScene scene(pinhole(), 100);
    addNoise(scene.bundle, 0.3, 4);
    gslam::OptimizerOptions robust = options();
    robust.loss = loss;
    const double error = solvePoseChecked(scene, 0.001, robust);
    if (loss.kind == gslam::LossKind::Squared) continue;
    EXPECT_LT(error, 0.02);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(scene.inliers[i], i % 4 != 3) << i;
  }
}

TEST_P(BackendContract, takes_rigs_stereo_weights_and_priors_for_a_pose) {
  using namespace backend_contract;
  NEEDS_FUNCTION(pose);
  PoseScene weighed;
  for (std::size_t i = 0; i < 50; ++i) {
    weighed.information.push_back(i % 5 == 0 ? 0 : static_cast<double>(i));
    if (i % 5 == 0) weighed.bundle.pixels[i] += Vec2d{50, 60};
  }
  EXPECT_LT(solvePoseChecked(weighed, 0.1, options()), 1e-7);

  PoseScene stereo;
  for (std::size_t i = 0; i < 50; ++i) {
    const Vec3d seen = stereo.bundle.true_poses[0].inverse() * stereo.points[i];
    Vec2d right;
    ASSERT_TRUE(pinhole().project(seen - Vec3d{0.2, 0, 0}, right));
    stereo.right_u.push_back(i % 3 == 0 ? std::nan("") : right[0]);
  }
  EXPECT_LT(solvePoseChecked(stereo, 0.1, options()), 1e-7);

  // A second camera so far away that most of it is beside its image, and negative.
  PoseScene wide;
  wide.baseline = 4;
  std::size_t negative = 0;
  for (std::size_t i = 0; i < 50; ++i) {
    const Vec3d seen = wide.bundle.true_poses[0].inverse() * wide.points[i];
    Vec2d right;
    ASSERT_TRUE(pinhole().project(seen - Vec3d{4, 0, 0}, right));
    wide.right_u.push_back(right[0]);
    negative += right[0] < 0 ? 1 : 0;
  }
  EXPECT_GT(negative, 10U);
  EXPECT_LT(solvePoseChecked(wide, 0.1, options()), 1e-7);
  // They count: one that is wrong costs what the plain formulas say.
  wide.right_u[0] -= 5;
  EXPECT_GT(solvePoseChecked(wide, 0.1, options()), 1e-6);

  PoseScene rig;
  rig.bundle.true_cameras = rig.bundle.cameras = {pinhole(), pinhole()};
  rig.bundle.true_extrinsics = rig.bundle.extrinsics = {SE3d::exp({0.1, 0, 0, 0.02, 0, 0}),
                                                        SE3d::exp({-0.3, 0.02, 0, -0.05, 0.1, 0})};
  rig.bundle.of_pose.clear(), rig.bundle.of_point.clear();
  rig.bundle.of_camera.clear(), rig.bundle.pixels.clear();
  observeAll(rig.bundle);
  rig.update();
  EXPECT_LT(solvePoseChecked(rig, 0.1, options()), 1e-7);

  PoseScene held;
  addNoise(held.bundle, 1);
  held.has_prior = true;
  held.prior.pose = held.bundle.true_poses[0];
  held.prior.information = 1e9 * gslam::Mat<double, 6, 6>::identity();
  EXPECT_LT(solvePoseChecked(held, 0.01, options()), 1e-4);
}

TEST_P(BackendContract, knows_how_uncertain_a_pose_is) {
  using namespace backend_contract;
  NEEDS_FUNCTION(pose);
  PoseScene scene;
  const SE3d truth = scene.bundle.true_poses[0];
  const gslam::OptimizedPose found = optimizePose(scene.problem(), truth, options());
  const auto cost = [&](const std::vector<double>& x) {
    SE3d::Tangent tangent;
    for (std::size_t k = 0; k < 6; ++k) tangent[k] = x[k];
    return scene.cost(truth * SE3d::exp(tangent), {});
  };
  const std::vector<double> expected = inverseOf(hessianOf(cost, 6, 1e-4), 6);
  double size = 0;
  for (const double value : expected) size = std::max(size, std::abs(value));
  for (std::size_t i = 0; i < 36; ++i) {
    EXPECT_NEAR(found.covariance.data()[i], expected[i], 1e-3 * size) << i;
  }
}

TEST_P(BackendContract, says_where_a_pose_is_not_determined) {
  using namespace backend_contract;
  NEEDS_FUNCTION(pose);
  PoseScene scene;
  scene.information.assign(50, 0);
  const SE3d start = scene.start(0.1);
  const gslam::OptimizedPose found = optimizePose(scene.problem(), start, options());
  EXPECT_FALSE(found.is_usable);
  EXPECT_TRUE(areSameBits(found.T_world_body, start));
  for (std::size_t i = 0; i < 36; ++i) EXPECT_EQ(found.covariance.data()[i], 0);
}

TEST_P(BackendContract, aligns_points_planes_lines_and_poses) {
  using namespace backend_contract;
  NEEDS_FUNCTION(alignment);
  std::mt19937 generator(4);
  for (const double scale : {1.0, 1.7}) {
    if (scale != 1 && !backend().similarity_alignment) continue;
    SCOPED_TRACE(scale);
    const SIM3d truth(SO3d::exp({0.3, -0.2, 0.5}), {1, 2, -1}, scale);
    std::vector<Vec3d> b, a, origins, directions;
    std::vector<gslam::Vec4d> planes;
    std::vector<SE3d> poses_b, poses_a;
    for (int i = 0; i < 20; ++i) {
      b.push_back(randomVector<3>(generator, 2));
      a.push_back(truth * b.back());
      const Vec3d normal = randomVector<3>(generator, 1).normalized();
      planes.push_back({normal[0], normal[1], normal[2], -normal.dot(a.back())});
      directions.push_back(randomVector<3>(generator, 1).normalized());
      origins.push_back(a.back() + 3 * directions.back());
      poses_b.push_back(SE3d::exp(smallTangent<SE3d>(generator, 1)));
      const SIM3d moved = truth * SIM3d(poses_b.back().rotation(), poses_b.back().translation(), 1);
      poses_a.emplace_back(moved.rotation(), moved.translation());
    }
    for (int kind = 0; kind < 4; ++kind) {
      SCOPED_TRACE(kind);
      gslam::AlignmentProblem problem;
      if (kind == 0) problem.points_b = b, problem.points_a = a;
      if (kind == 1) problem.plane_points_b = b, problem.planes_a = planes;
      if (kind == 2) {
        problem.line_points_b = b;
        problem.line_origins_a = origins;
        problem.line_directions_a = directions;
      }
      if (kind == 3) problem.T_b_body = poses_b, problem.T_a_body = poses_a;
      const SIM3d start = truth * SIM3d::exp({0.1, -0.1, 0.1, 0.1, -0.05, 0.05, 0.0});
      gslam::OptimizerSummary summary;
      double error = 0;
      if (scale == 1) {
        const auto found =
            optimizeAlignment(problem, SE3d(start.rotation(), start.translation()), options());
        summary = found.summary;
        error = (SE3d(truth.rotation(), truth.translation()).inverse() * found.T_a_b).log().norm();
      } else {
        const auto found = optimizeAlignment(problem, start, options());
        summary = found.summary;
        error = (truth.inverse() * found.T_a_b).log().norm();
      }
      EXPECT_TRUE(summary.is_usable) << fullReport(summary);
      EXPECT_LT(summary.final_cost, 1e-12) << fullReport(summary);
      EXPECT_LT(error, 1e-6) << fullReport(summary);
    }
  }
}

TEST_P(BackendContract, finds_motion_and_inverse_depths_of_two_views) {
  using namespace backend_contract;
  NEEDS_FUNCTION(two_view);
  BundleScene scene = bundleScene(2, 40, 0);
  const SE3d truth = scene.true_poses[0].inverse() * scene.true_poses[1];
  std::vector<Vec2d> first(40), second(40);
  std::vector<double> depths;
  for (std::size_t i = 0; i < 80; ++i) {
    (scene.of_pose[i] == 0 ? first : second)[scene.of_point[i]] = scene.pixels[i];
  }
  for (const Vec3d& point : scene.points) {
    depths.push_back(1 / (scene.true_poses[0].inverse() * point).norm());
  }
  const std::vector<double> true_depths = depths, knowledge(40, 1e8);
  for (const bool knows_depths : {false, true}) {
    SCOPED_TRACE(knows_depths);
    depths = true_depths;
    for (std::size_t i = 0; i < 40 && !knows_depths; ++i) depths[i] *= i % 2 == 0 ? 1.1 : 0.9;
    gslam::TwoViewProblem problem;
    problem.first = first;
    problem.second = second;
    problem.first_camera = problem.second_camera = pinhole();
    problem.inverse_depths = depths;
    if (knows_depths) problem.depth_information = knowledge;
    SE3d start = truth * SE3d::exp({0.03, -0.02, 0.03, 0.01, 0.01, -0.02});
    if (!knows_depths) {  // whose length stays
      start = SE3d(start.rotation(),
                   start.translation() * (truth.translation().norm() / start.translation().norm()));
    }
    const auto found = optimizeTwoView(problem, start, options());
    EXPECT_TRUE(found.summary.is_usable) << fullReport(found.summary);
    EXPECT_LT(found.summary.final_cost, 1e-9) << fullReport(found.summary);
    EXPECT_LT((truth.inverse() * found.T_first_second).log().norm(), 1e-5);
    for (std::size_t i = 0; i < 40; ++i) EXPECT_NEAR(depths[i], true_depths[i], 1e-6) << i;
  }
}

TEST_P(BackendContract, knows_how_uncertain_a_bundle_is) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle_covariance);
  BundleScene scene = bundleScene(3, 7, 0);
  const std::size_t size = 6 + 7 * 3;
  const auto cost = [&](const std::vector<double>& x) {
    BundleScene moved = scene;
    SE3d::Tangent tangent;
    for (std::size_t k = 0; k < 6; ++k) tangent[k] = x[k];
    moved.poses[2] = moved.poses[2] * SE3d::exp(tangent);
    for (std::size_t i = 0; i < 7; ++i) {
      for (std::size_t k = 0; k < 3; ++k) moved.points[i][k] += x[6 + 3 * i + k];
    }
    return bundleCost(moved.problem());
  };
  const std::vector<double> expected = inverseOf(hessianOf(cost, size, 1e-4), size);
  const std::vector<std::uint32_t> poses = {2, 0}, points = {4};
  const gslam::BundleCovariance found =
      bundleCovariance(scene.problem(), poses, points, {}, options());
  ASSERT_TRUE(found.is_valid) << found.message;
  double size_of_pose = 0, size_of_point = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    size_of_pose = std::max(size_of_pose, expected[k * size + k]);
    if (k < 3) size_of_point = std::max(size_of_point, expected[(18 + k) * size + 18 + k]);
  }
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c) {
      EXPECT_NEAR(found.poses[0](r, c), expected[r * size + c], 1e-3 * size_of_pose);
      EXPECT_EQ(found.poses[1](r, c), 0);
    }
  }
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(found.points[0](r, c), expected[(18 + r) * size + 18 + c], 1e-3 * size_of_point);
    }
  }
  scene.pose_fixed.clear();
  const gslam::BundleCovariance free =
      bundleCovariance(scene.problem(), poses, points, {}, options());
  EXPECT_FALSE(free.is_valid);
  EXPECT_FALSE(free.message.empty());
}

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_SMALL_H
