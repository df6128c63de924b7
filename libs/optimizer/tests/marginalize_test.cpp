#include <gmock/gmock.h>
#include <gslam/base/error.h>
#include <gslam/optimizer/check.h>
#include <gslam/optimizer/marginalize.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "bundle_brute_force.h"

namespace gslam {
namespace {

using bundle_scene::addNoise;
using bundle_scene::addStereo;
using bundle_scene::LongSystem;
using bundle_scene::makeEverything;
using bundle_scene::makeScene;
using bundle_scene::pinhole;
using bundle_scene::Scene;
using bundle_scene::Variables;
using Indices = std::vector<std::uint32_t>;

// Against a system whose rows of other variables are gone: those of the poses that begin at `rows`.
void expectPrior(const WindowPrior& prior, const LongSystem& rest, const std::vector<int>& rows) {
  const std::size_t n = 6 * rows.size();
  ASSERT_EQ(prior.gradient.size(), n);
  const auto rowOf = [&rows](std::size_t i) { return rows[i / 6] + int(i % 6); };
  for (std::size_t i = 0; i < n; ++i) {
    const int a = rowOf(i);
    for (std::size_t k = 0; k < n; ++k) {
      const int b = rowOf(k);
      EXPECT_NEAR(prior.information[i * n + k], rest(a, b),
                  1e-5 * std::sqrt(rest(a, a) * rest(b, b)))
          << i << " " << k;
      EXPECT_EQ(prior.information[i * n + k], prior.information[k * n + i]);
    }
    const double g = rest(a, rest.size());
    EXPECT_NEAR(prior.gradient[i], g, 1e-5 * (std::sqrt(rest(a, a)) + std::fabs(g)));
  }
}

LongSystem systemOf(const WindowPrior& prior) {
  const int n = int(prior.gradient.size());
  LongSystem system(n);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) system(i, k) = prior.information[std::size_t(i * n + k)];
    system(i, n) = prior.gradient[std::size_t(i)];
  }
  return system;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::fabs(value));
  return most;
}

// By elimination of what is largest on the diagonal.
std::size_t rankOf(std::vector<double> m) {
  const std::size_t n = std::size_t(std::lround(std::sqrt(double(m.size()))));
  const double rounding = 1e-10 * largest(m);
  for (std::size_t rank = 0; rank < n; ++rank) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_GT(m[i * n + i], -rounding);
      if (m[i * n + i] > m[k * n + k]) k = i;
    }
    if (m[k * n + k] <= rounding) return rank;
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = m[i * n + k] / m[k * n + k];
      for (std::size_t j = 0; j < n && i != k; ++j) m[i * n + j] -= factor * m[k * n + j];
    }
    for (std::size_t i = 0; i < n; ++i) m[k * n + i] = m[i * n + k] = 0;
  }
  return n;
}

std::size_t rankOf(const Mat<double, 6, 6>& m) {
  return rankOf(std::vector<double>(m.values, m.values + 36));
}

TEST(marginalize, leaves_what_the_dense_schur_complement_leaves) {
  Scene scene = makeEverything();
  const BundleProblem problem = scene.problem();
  RobustLoss loss;
  loss.kind = LossKind::Huber;
  loss.scale = 1.5;
  const WindowPrior prior = marginalize(problem, Indices{3, 0, 1}, loss);
  EXPECT_EQ(prior.poses, (Indices{3, 1}));  // pose 0 is fixed
  ASSERT_EQ(prior.T_linear.size(), 2u);
  EXPECT_TRUE(prior.T_linear[0].isApprox(scene.bundle.T_world_body[3], 0));
  const Variables variables(problem);
  const std::vector<int> rows = {variables.pose[3], variables.pose[1]};
  LongSystem rest = variables.equations(loss);
  LongSystem whole = rest;
  rest.eliminateAllBut(rows);
  expectPrior(prior, rest, rows);

  // The step of what remains is that of the whole.
  whole.eliminate(0, whole.size());
  LongSystem step = systemOf(prior);
  step.eliminate(0, 12);
  for (int i = 0; i < 12; ++i) {
    EXPECT_NEAR(step.solution(i), whole.solution(rows[std::size_t(i / 6)] + i % 6), 1e-5);
  }
}

TEST(marginalize, with_the_rest_of_a_problem_gives_the_step_of_the_whole) {
  // Observations of points 0 to 19 are old; the others, of later points, are the window.
  Scene whole = makeScene(5, 40, {pinhole()});
  addNoise(whole, 1);
  whole.position_priors.push_back({0, {1, 2, -8}, Mat3d::identity()});
  whole.pose_priors.push_back({1, whole.truth.T_world_body[1], 10 * Mat<double, 6, 6>::identity()});
  Scene old = whole, window = whole;
  const auto keepOnly = [](Scene& scene, bool is_old) {
    Bundle& b = scene.bundle;
    const Bundle all = b;
    b.observation_pose.clear();
    b.observation_point.clear();
    b.observation_camera.clear();
    b.pixels.clear();
    for (std::size_t i = 0; i < all.pixels.size(); ++i) {
      if ((all.observation_point[i] < 20) != is_old) continue;
      if (!is_old && all.observation_pose[i] < 2) continue;  // gone
      b.observation_pose.push_back(all.observation_pose[i]);
      b.observation_point.push_back(all.observation_point[i]);
      b.observation_camera.push_back(0);
      b.pixels.push_back(all.pixels[i]);
    }
  };
  keepOnly(old, true);
  keepOnly(window, false);
  window.position_priors.clear();
  window.pose_priors.clear();
  window.window_priors.push_back(marginalize(old.problem(), Indices{2, 3, 4}));
  window.bundle.pose_fixed = {1, 1, 0, 0, 0};  // not part of it
  // In the whole problem poses 0 and 1 see old points only.
  Scene both = whole;
  both.bundle.observation_pose = old.bundle.observation_pose;
  both.bundle.observation_point = old.bundle.observation_point;
  both.bundle.observation_camera = old.bundle.observation_camera;
  both.bundle.pixels = old.bundle.pixels;
  const Bundle& w = window.bundle;
  Bundle& b = both.bundle;
  b.observation_pose.insert(b.observation_pose.end(), w.observation_pose.begin(),
                            w.observation_pose.end());
  b.observation_point.insert(b.observation_point.end(), w.observation_point.begin(),
                             w.observation_point.end());
  b.observation_camera.insert(b.observation_camera.end(), w.observation_camera.begin(),
                              w.observation_camera.end());
  b.pixels.insert(b.pixels.end(), w.pixels.begin(), w.pixels.end());
  const BundleProblem whole_problem = both.problem();
  window.bundle.point_fixed.assign(40, 0);
  for (std::size_t i = 0; i < 20; ++i) window.bundle.point_fixed[i] = 1;
  const BundleProblem window_problem = window.problem();
  const Variables all(whole_problem), some(window_problem);
  LongSystem step = all.equations({}), window_step = some.equations({});
  step.eliminate(0, step.size());
  window_step.eliminate(0, window_step.size());
  for (const std::size_t pose : {2u, 3u, 4u}) {
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(window_step.solution(some.pose[pose] + i), step.solution(all.pose[pose] + i),
                  1e-6);
    }
  }
  for (std::size_t point = 20; point < 40; ++point) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(window_step.solution(some.point[point] + i), step.solution(all.point[point] + i),
                  1e-5);
    }
  }
}

TEST(marginalize, knows_nothing_of_the_gauge_where_nothing_fixes_it) {
  Scene scene = makeScene(6, 40, {pinhole()});
  addNoise(scene, 0.5);
  EXPECT_EQ(rankOf(marginalize(scene.problem(), Indices{1, 4, 2}).information), 18u - 7);
  addStereo(scene, 0.3);
  EXPECT_EQ(rankOf(marginalize(scene.problem(), Indices{1, 4, 2}).information), 18u - 6);
}

TEST(marginalize, leaves_no_rounding_of_a_pose_that_nothing_is_known_about) {
  Scene scene = makeScene(6, 40, {pinhole()});
  addNoise(scene, 0.5);
  const WindowPrior prior = marginalize(scene.problem(), Indices{3});
  EXPECT_LT(largest(prior.information), 1e-6);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_GE(prior.information[7 * i], 0);
  EXPECT_LT(largest(prior.gradient), 1e-6);
}

TEST(marginalize, takes_out_what_nothing_is_known_about) {
  Scene scene = makeScene(5, 40, {pinhole(), bundle_scene::radtan()});
  addNoise(scene, 0.5);
  scene.bundle.pose_fixed = {1, 0, 0, 0, 1};
  const WindowPrior before = marginalize(scene.problem(), Indices{1, 2});
  Scene more = scene;
  more.bundle.T_world_body.push_back(SE3d());
  more.bundle.pose_fixed.push_back(0);
  more.bundle.points.push_back({1, 2, 3});
  more.bundle.cameras.push_back(pinhole());
  more.bundle.T_body_camera.push_back(SE3d());
  more.bundle.camera_freedom = {{}, {}, {0xfu, false}};
  const WindowPrior after = marginalize(more.problem(), Indices{1, 2});
  ASSERT_EQ(after.information.size(), before.information.size());
  for (std::size_t i = 0; i < after.information.size(); ++i) {
    EXPECT_NEAR(after.information[i], before.information[i], 1e-9 * largest(before.information));
  }
  EXPECT_EQ(marginalize(more.problem(), Indices{}).poses.size(), 0u);
}

std::string refusal(const BundleProblem& problem, const Indices& keep) {
  try {
    (void)marginalize(problem, keep);
  } catch (const ArgumentError& error) {
    return error.what();
  }
  return "";
}

TEST(marginalize, makes_priors_that_are_accepted_as_such) {
  const bool is_full = std::getenv("GSLAM_FULL_TESTS") != nullptr;
  Scene scene = makeScene(is_full ? 180 : 8, is_full ? 30 : 15, {pinhole()});
  addNoise(scene, 2);
  Indices all(scene.bundle.T_world_body.size());
  std::iota(all.begin(), all.end(), 0);
  scene.window_priors = {marginalize(scene.problem(), all)};  // singular: no gauge
  for (const ProblemFinding& finding : checkBundle(scene.problem())) {
    EXPECT_FALSE(finding.is_error) << finding.field << " " << finding.problem;
  }
}

TEST(marginalize, refuses_poses_that_are_not_there_or_named_twice) {
  Scene scene = makeScene(3, 20, {pinhole()});
  EXPECT_THAT(refusal(scene.problem(), {0, 3}), testing::HasSubstr("keep[1] is 3"));
  EXPECT_THAT(refusal(scene.problem(), {1, 1}), testing::HasSubstr("second time"));
  EXPECT_THROW(marginalize(scene.problem(), Indices{0}, {LossKind::Huber, 0}), ArgumentError);
  EXPECT_THROW(poseGraphOf(scene.problem(), 15, {LossKind::Huber, std::nan("")}), ArgumentError);
  scene.bundle.points[2][1] = std::nan("");
  EXPECT_NE(refusal(scene.problem(), {0}), "");
}

TEST(pose_graph_of, has_edges_where_enough_points_are_shared) {
  Scene scene = makeScene(5, 60, {pinhole()});
  Bundle& b = scene.bundle;
  const Bundle all = b;
  b.observation_pose.clear();
  b.observation_point.clear();
  b.observation_camera.clear();
  b.pixels.clear();
  for (std::size_t i = 0; i < all.pixels.size(); ++i) {  // pose p sees points 10 p to 10 p + 19
    const std::uint32_t p = all.observation_pose[i], x = all.observation_point[i];
    if (x < 10 * p || x >= 10 * p + 20) continue;
    b.observation_pose.push_back(p);
    b.observation_point.push_back(x);
    b.observation_camera.push_back(0);
    b.pixels.push_back(all.pixels[i]);
  }
  b.pose_fixed = {0, 1, 0, 0, 0};
  PoseGraph<SE3d> graph = poseGraphOf(scene.problem(), 10);
  EXPECT_EQ(graph.from, (Indices{0, 1, 2, 3}));
  EXPECT_EQ(graph.to, (Indices{1, 2, 3, 4}));
  EXPECT_EQ(graph.pose_fixed, b.pose_fixed);
  ASSERT_EQ(graph.T_world_body.size(), 5u);
  for (std::size_t e = 0; e < 4; ++e) {
    EXPECT_TRUE(
        graph.T_from_to[e].isApprox(b.T_world_body[e].inverse() * b.T_world_body[e + 1], 1e-14));
  }
  EXPECT_TRUE(poseGraphOf(scene.problem(), 11).from.empty());
  EXPECT_THROW(poseGraphOf(scene.problem(), 2), ArgumentError);
}

TEST(pose_graph_of, has_the_information_of_two_views_without_points) {
  Scene scene = makeScene(2, 30, {pinhole(), bundle_scene::radtan()}, true);
  addNoise(scene, 0.5);
  PoseGraph<SE3d> graph = poseGraphOf(scene.problem());
  ASSERT_EQ(graph.information.size(), 1u);
  EXPECT_EQ(rankOf(graph.information[0]), 6u);
  scene.bundle.pose_fixed = {1, 0};
  const BundleProblem problem = scene.problem();
  const Variables variables(problem);
  LongSystem system = variables.equations({});
  system.eliminateAllBut({variables.pose[1]});
  const LongSystem& rest = system;
  const int first = variables.pose[1];
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 6; ++k) {
      const double unit = std::sqrt(rest(first + i, first + i) * rest(first + k, first + k));
      EXPECT_NEAR(graph.information[0](std::size_t(i), std::size_t(k)), rest(first + i, first + k),
                  1e-5 * unit);
    }
  }
}

TEST(pose_graph_of, has_no_edge_of_outliers_only) {
  Scene scene = makeScene(3, 30, {pinhole()});
  for (std::size_t i = 0; i < scene.bundle.pixels.size(); ++i) {
    if (scene.bundle.observation_pose[i] == 1) scene.bundle.pixels[i] += Vec2d{100, 0};
  }
  const PoseGraph<SE3d> graph = poseGraphOf(scene.problem(), 15, {LossKind::Tukey, 5});
  EXPECT_EQ(graph.from, (Indices{0}));
  EXPECT_EQ(graph.to, (Indices{2}));
}

TEST(pose_graph_of, does_not_know_the_distance_of_one_camera) {
  Scene scene = makeScene(3, 30, {pinhole()});
  addNoise(scene, 0.5);
  const PoseGraph<SE3d> graph = poseGraphOf(scene.problem());
  ASSERT_EQ(graph.information.size(), 3u);
  for (const Mat<double, 6, 6>& m : graph.information) {
    EXPECT_EQ(rankOf(m), 5u);
  }
}

TEST(bundle, shows_its_arrays_as_a_problem) {
  Scene scene = makeScene(3, 20, {pinhole()});
  Bundle& b = scene.bundle;
  b.pose_fixed = {1, 0, 0};
  const BundleProblem problem = b.problem();
  EXPECT_EQ(problem.T_world_body.data(), b.T_world_body.data());
  EXPECT_EQ(problem.pose_fixed.size(), 3u);
  EXPECT_EQ(problem.points.data(), b.points.data());
  EXPECT_EQ(problem.point_fixed.size(), 0u);
  EXPECT_EQ(problem.cameras.data(), b.cameras.data());
  EXPECT_EQ(problem.T_body_camera.data(), b.T_body_camera.data());
  EXPECT_EQ(problem.observation_pose.data(), b.observation_pose.data());
  EXPECT_EQ(problem.observation_point.data(), b.observation_point.data());
  EXPECT_EQ(problem.observation_camera.data(), b.observation_camera.data());
  EXPECT_EQ(problem.pixels.data(), b.pixels.data());
  EXPECT_EQ(problem.information.size(), 0u);
}

}  // namespace
}  // namespace gslam
