#include <gslam/optimizer_ceres.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "scenes.h"

namespace {

using gslam::AlignmentProblem;
using gslam::Camera;
using gslam::Mat;
using gslam::Mat3d;
using gslam::OptimizerOptions;
using gslam::OptimizerStatus;
using gslam::PoseProblem;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::TwoViewProblem;
using gslam::Vec2d;
using gslam::Vec3d;
using gslam::Vec4d;
using scenes::exact;

struct Known {
  SE3d truth = SE3d(SO3d::exp({0.1, -0.2, 0.3}), {0.5, 0.2, -1});
  std::vector<Vec3d> points;
  std::vector<Vec2d> pixels;
  std::vector<Camera> cameras = {scenes::radtan(), scenes::pinhole()};
  std::vector<SE3d> extrinsics = {SE3d(), SE3d(SO3d::exp({0, 0.2, 0}), {0.2, 0, 0})};
  std::vector<std::uint32_t> camera_of;

  explicit Known(std::size_t n) {
    std::mt19937_64 generator(1);
    while (points.size() < n) {
      const Vec3d point = {scenes::noise(generator, 2), scenes::noise(generator, 2),
                           6 + scenes::noise(generator, 2)};
      const auto c = static_cast<std::uint32_t>(points.size() % 2);
      Vec2d pixel{};
      if (!cameras[c].project((truth * extrinsics[c]).inverse() * point, pixel)) continue;
      points.push_back(point);
      pixels.push_back(pixel);
      camera_of.push_back(c);
    }
  }

  PoseProblem problem() const {
    PoseProblem views;
    views.points = points;
    views.pixels = pixels;
    views.cameras = cameras;
    views.T_body_camera = extrinsics;
    views.camera_of = camera_of;
    return views;
  }
};

TEST(pose, of_a_rig_is_found_with_its_covariance) {
  const Known known(40);
  const SE3d start = known.truth * SE3d::exp({0.1, -0.1, 0.2, 0.05, -0.1, 0.05});
  const gslam::OptimizedPose found = gslam::ceresBackend().pose(known.problem(), start, exact());
  EXPECT_TRUE(found.is_usable);
  EXPECT_TRUE(known.truth.isApprox(found.T_world_body, 1e-9));
  EXPECT_EQ(40u, found.observations);
  EXPECT_EQ(40u, found.inliers);
  EXPECT_LT(found.final_cost, 1e-16);
  // From numeric derivatives.
  Mat<double, 6, 6> normal{};
  for (std::size_t i = 0; i < 40; ++i) {
    Vec2d by[6];
    for (std::size_t k = 0; k < 6; ++k) {
      SE3d::Tangent d{};
      Vec2d plus{}, minus{};
      d[k] = 1e-6;
      const std::uint32_t c = known.camera_of[i];
      const SE3d& e = known.extrinsics[c];
      known.cameras[c].project((known.truth * SE3d::exp(d) * e).inverse() * known.points[i], plus);
      known.cameras[c].project((known.truth * SE3d::exp(-d) * e).inverse() * known.points[i],
                               minus);
      by[k] = (plus - minus) / 2e-6;
    }
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) normal(r, c) += by[r].dot(by[c]);
    }
  }
  const Mat<double, 6, 6> product = normal * found.covariance;
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(r == c ? 1 : 0, product(r, c), 1e-3);
  }
}

TEST(pose, marks_inliers_under_a_loss) {
  Known known(60);
  for (std::size_t i = 0; i < 60; i += 6) known.pixels[i] += Vec2d{50, 30};
  std::vector<std::uint8_t> inliers(60, 7);
  PoseProblem problem = known.problem();
  problem.inliers = inliers;
  OptimizerOptions options = exact();
  options.loss = {gslam::LossKind::Tukey, 30};
  const gslam::OptimizedPose found = gslam::ceresBackend().pose(
      problem, known.truth * SE3d::exp({0.01, 0, 0, 0, 0.005, 0}), options);
  EXPECT_TRUE(known.truth.isApprox(found.T_world_body, 1e-7));
  EXPECT_EQ(50u, found.inliers);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(i % 6 == 0 ? 0 : 1, inliers[i]) << i;
}

TEST(pose, that_is_not_determined_is_the_start) {
  const Known known(1);
  const SE3d start = known.truth * SE3d::exp({0.1, 0, 0, 0, 0, 0});
  gslam::OptimizedPose found = gslam::ceresBackend().pose(known.problem(), start, {});
  EXPECT_FALSE(found.is_usable);
  EXPECT_EQ(OptimizerStatus::Failed, found.status);
  EXPECT_EQ(0u, found.inliers);
  EXPECT_EQ(0, std::memcmp(&start, &found.T_world_body, sizeof(SE3d)));
  EXPECT_EQ((Mat<double, 6, 6>{}), found.covariance);
  const gslam::PosePrior prior = {known.truth, Mat<double, 6, 6>::identity()};
  PoseProblem problem = known.problem();
  problem.prior = &prior;
  found = gslam::ceresBackend().pose(problem, start, exact());
  EXPECT_TRUE(found.is_usable);
  EXPECT_TRUE(known.truth.isApprox(found.T_world_body, 1e-7));
}

TEST(pose, leaves_out_what_is_behind_its_camera_at_the_start) {
  Known known(40);
  for (std::size_t i = 0; i < 4; ++i) {  // the formulas fit, on the wrong side
    const SE3d here = known.truth * known.extrinsics[known.camera_of[i]];
    known.points[i] = here * -(here.inverse() * known.points[i]);
  }
  known.pixels[1] += Vec2d{100, 100};
  std::vector<std::uint8_t> inliers(40, 7);
  PoseProblem problem = known.problem();
  problem.inliers = inliers;
  const SE3d start = known.truth * SE3d::exp({0.05, -0.05, 0.05, 0.02, -0.02, 0.01});
  const gslam::OptimizedPose found = gslam::ceresBackend().pose(problem, start, exact());
  EXPECT_TRUE(known.truth.isApprox(found.T_world_body, 1e-8));
  EXPECT_EQ(36u, found.observations);
  EXPECT_EQ(36u, found.inliers);
  EXPECT_LT(found.final_cost, 1e-15);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(i < 4 ? 0 : 1, inliers[i]) << i;
}

TEST(pose, takes_the_right_image_where_there_is_one) {
  Known known(30);
  known.cameras = {scenes::pinhole()};
  PoseProblem problem = known.problem();
  std::vector<double> right_u;
  for (std::size_t i = 0; i < 30; ++i) {
    const Vec3d point = known.truth.inverse() * known.points[i];
    Vec2d right{};
    ASSERT_TRUE(known.cameras[0].project(point, known.pixels[i]));
    ASSERT_TRUE(known.cameras[0].project(point - Vec3d{0.1, 0, 0}, right));
    right_u.push_back(i % 3 == 1 ? std::nan("") : right[0]);
  }
  problem.cameras = known.cameras;
  problem.T_body_camera = {};
  problem.camera_of = {};
  problem.right_u = right_u;
  problem.baseline = 0.1;
  const SE3d start = known.truth * SE3d::exp({0.1, 0, 0.1, 0, 0.05, 0});
  const gslam::OptimizedPose found = gslam::ceresBackend().pose(problem, start, exact());
  EXPECT_TRUE(known.truth.isApprox(found.T_world_body, 1e-9));
  EXPECT_LT(found.final_cost, 1e-16);
}

TEST(pose, progress_passes_through) {
  const Known known(10);
  OptimizerOptions options;
  options.progress = [](const gslam::OptimizerIteration&) -> bool {
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(gslam::ceresBackend().pose(known.problem(), SE3d(), options), std::runtime_error);
}

// Points, planes, lines and poses that T_a_b brings together.
template <class Group>
struct Pairs {
  std::vector<Vec3d> points_b, points_a, plane_points, line_points, origins, directions;
  std::vector<Vec4d> planes;
  std::vector<SE3d> poses_b, poses_a;

  explicit Pairs(const Group& T_a_b) {
    std::mt19937_64 generator(2);
    for (std::size_t i = 0; i < 5; ++i) {
      const auto any = [&]() -> Vec3d {
        return {scenes::noise(generator, 3), scenes::noise(generator, 3),
                scenes::noise(generator, 3)};
      };
      points_b.push_back(any());
      points_a.push_back(T_a_b * points_b.back());
      plane_points.push_back(any());
      const Vec3d normal = any().normalized();
      planes.push_back({normal[0], normal[1], normal[2], -normal.dot(T_a_b * plane_points.back())});
      line_points.push_back(any());
      directions.push_back(any().normalized());
      origins.push_back(T_a_b * line_points.back() + 2.0 * directions.back());
      poses_b.push_back(SE3d(SO3d::exp(any()), any()));
      poses_a.push_back(
          SE3d(T_a_b.rotation() * poses_b.back().rotation(), T_a_b * poses_b.back().translation()));
    }
  }

  // Bit 0: points, 1: planes and lines, 2: poses.
  AlignmentProblem problem(unsigned parts) const {
    AlignmentProblem views;
    if ((parts & 1U) != 0) views.points_b = points_b, views.points_a = points_a;
    if ((parts & 2U) != 0) {
      views.plane_points_b = plane_points, views.planes_a = planes;
      views.line_points_b = line_points, views.line_origins_a = origins;
      views.line_directions_a = directions;
    }
    if ((parts & 4U) != 0) views.T_b_body = poses_b, views.T_a_body = poses_a;
    return views;
  }
};

TEST(alignment, of_each_kind_of_correspondence_is_found) {
  const SE3d truth(SO3d::exp({0.5, -1, 0.3}), {1, -2, 3});
  const Pairs<SE3d> pairs(truth);
  const SIM3d similarity(truth, 1.7);
  const Pairs<SIM3d> scaled(similarity);
  for (const unsigned parts : {1U, 2U, 4U, 7U}) {
    const SE3d start = truth * SE3d::exp({0.3, 0.2, -0.2, 0.1, 0.2, -0.1});
    const auto found = gslam::ceresBackend().alignment(pairs.problem(parts), start, exact());
    EXPECT_TRUE(truth.isApprox(found.T_a_b, 1e-8)) << parts << found.summary.message;
    EXPECT_GT(found.covariance(0, 0), 0);
    EXPECT_EQ(found.summary.observations, found.summary.inliers);
    const SIM3d scaled_start = similarity * SIM3d::exp({0.3, 0.2, -0.2, 0.1, 0.2, -0.1, 0.2});
    const auto also =
        gslam::ceresBackend().similarity_alignment(scaled.problem(parts), scaled_start, exact());
    EXPECT_TRUE(similarity.isApprox(also.T_a_b, 1e-8)) << parts << also.summary.message;
    EXPECT_EQ(7u, also.summary.parameters);
  }
}

struct Matches {
  SE3d truth = SE3d(SO3d::exp({0.05, -0.1, 0.02}), {0.6, -0.1, 0.2});
  std::vector<Vec2d> first, second;
  std::vector<double> inverse_depths;
  Camera camera = scenes::radtan();

  Matches() {
    std::mt19937_64 generator(4);
    while (first.size() < 30) {
      const Vec3d point = {scenes::noise(generator, 2), scenes::noise(generator, 1.5),
                           6 + scenes::noise(generator, 3)};
      Vec2d a{}, b{};
      if (!camera.project(point, a) || !camera.project(truth.inverse() * point, b)) continue;
      first.push_back(a);
      second.push_back(b);
      inverse_depths.push_back(1 / point.norm());
    }
  }

  TwoViewProblem problem() {
    TwoViewProblem views;
    views.first = first;
    views.second = second;
    views.first_camera = views.second_camera = camera;
    views.inverse_depths = inverse_depths;
    return views;
  }
};

TEST(two_view, keeps_the_length_of_the_translation) {
  Matches matches;
  const std::vector<double> truth = matches.inverse_depths;
  for (std::size_t i = 0; i < 30; ++i) matches.inverse_depths[i] *= i % 2 == 0 ? 1.3 : 0.8;
  matches.inverse_depths[3] = 0;
  const double length = matches.truth.translation().norm();
  const Vec3d off = (matches.truth.translation() + Vec3d{0.05, 0.05, -0.1}).normalized() * length;
  const SE3d start(matches.truth.rotation() * SO3d::exp({0.02, 0.01, -0.02}), off);
  const auto found = gslam::ceresBackend().two_view(matches.problem(), start, exact());
  EXPECT_TRUE(matches.truth.isApprox(found.T_first_second, 1e-7)) << found.summary.message;
  EXPECT_NEAR(length, found.T_first_second.translation().norm(), 1e-13);
  EXPECT_LT(found.summary.final_cost, 1e-12);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_NEAR(truth[i], matches.inverse_depths[i], 1e-7) << i;
  EXPECT_EQ(35u, found.summary.parameters);
  // Nothing in the direction of the scale.
  const Vec3d scale =
      found.T_first_second.rotation().inverse() * found.T_first_second.translation();
  const SE3d::Tangent along = {{scale[0], scale[1], scale[2], 0, 0, 0}};
  EXPECT_GT(found.covariance(3, 3), 0);
  EXPECT_LT((found.covariance * along).norm(), 1e-12);
}

TEST(two_view, known_depths_give_the_scale) {
  Matches matches;
  const std::vector<double> information(30, 1e6);
  TwoViewProblem problem = matches.problem();
  problem.depth_information = information;
  const SE3d start = matches.truth * SE3d::exp({0.2, 0.1, 0, 0.01, 0, 0.02});
  const auto found = gslam::ceresBackend().two_view(problem, start, exact());
  EXPECT_TRUE(matches.truth.isApprox(found.T_first_second, 1e-7)) << found.summary.message;
  EXPECT_EQ(90u, found.summary.residuals);
  EXPECT_GT(found.covariance(0, 0), 0);
}

TEST(two_view, depths_of_which_nothing_is_known_give_no_scale) {
  Matches matches;
  const std::vector<double> information(30, 0.0);
  TwoViewProblem problem = matches.problem();
  problem.depth_information = information;
  const double length = matches.truth.translation().norm();
  const SE3d start(matches.truth.rotation(),
                   (matches.truth.translation() + Vec3d{0.02, 0, 0.02}).normalized() * length);
  const auto found = gslam::ceresBackend().two_view(problem, start, exact());
  EXPECT_TRUE(matches.truth.isApprox(found.T_first_second, 1e-7)) << found.summary.message;
  EXPECT_NEAR(length, found.T_first_second.translation().norm(), 1e-13);
  EXPECT_GT(found.covariance(3, 3), 0);
}

TEST(two_view, says_where_the_second_camera_sees_nothing) {
  Matches matches;
  const std::vector<double> before = matches.inverse_depths;
  const SE3d away = matches.truth * SE3d(SO3d::exp({0, 3.14159, 0}), {0, 0, 0});
  const auto found = gslam::ceresBackend().two_view(matches.problem(), away, exact());
  EXPECT_EQ(OptimizerStatus::Failed, found.summary.status);
  EXPECT_FALSE(found.summary.is_usable);
  EXPECT_EQ(30u, found.summary.left_out);
  EXPECT_EQ(0, std::memcmp(&away, &found.T_first_second, sizeof(SE3d)));
  EXPECT_EQ(before, matches.inverse_depths);
}

TEST(two_view, points_at_infinity_stay_there) {
  Matches matches;
  for (std::size_t i = 0; i < 5; ++i) {
    Vec3d bearing{};
    ASSERT_TRUE(matches.camera.unproject(matches.first[i], bearing));
    // A little beyond infinity: no inverse depth fits.
    const Vec3d seen =
        matches.truth.rotation().inverse() * (bearing + 0.002 * matches.truth.translation());
    ASSERT_TRUE(matches.camera.project(seen, matches.second[i]));
    matches.inverse_depths[i] = i % 2 == 0 ? 0 : 0.05;
  }
  const auto found = gslam::ceresBackend().two_view(matches.problem(), matches.truth, {});
  EXPECT_EQ(OptimizerStatus::Converged, found.summary.status);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_GE(matches.inverse_depths[i], 0);
    EXPECT_LT(matches.inverse_depths[i], 0.01);
  }
}

}  // namespace
