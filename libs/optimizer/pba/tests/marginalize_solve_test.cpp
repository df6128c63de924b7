// What marginalisation leaves, put to use: through the facade.
#include <gslam/optimizer.h>
#include <gslam/optimizer_pba.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "bundle_scene.h"

namespace gslam {
namespace {

using bundle_scene::addNoise;
using bundle_scene::addStereo;
using bundle_scene::makeScene;
using bundle_scene::pinhole;
using bundle_scene::Random;
using bundle_scene::Scene;
using Indices = std::vector<std::uint32_t>;

OptimizerOptions thoroughPba() {
  OptimizerOptions options;
  options.backend = "pba";
  options.function_tolerance = 1e-12;
  return options;
}

constexpr std::uint32_t kPoses = 12, kWindow = 5, kPointsOfPose = 12;

// The pose that sees a point first; the next two see it, too.
std::uint32_t firstPoseOf(std::uint32_t point) {
  return std::min(point / kPointsOfPose, kPoses - 3);
}

// A body that moves along, with one camera or a stereo pair.
Scene makeTrack(bool is_stereo) {
  Scene scene;
  Random random(2);
  Bundle& b = scene.truth;
  b.cameras = {pinhole()};
  b.T_body_camera = {SE3d()};
  for (std::uint32_t i = 0; i < kPoses; ++i) {
    const SE3d::Tangent turn = random.tangent(0.1, 0.1);
    b.T_world_body.push_back(SE3d(SO3d(), {0.8 * i, 0, 0}) * SE3d::exp(turn));
  }
  for (std::uint32_t i = 0; i < kPointsOfPose * (kPoses - 2); ++i) {
    const Vec3d off = random.vector();
    b.points.push_back({0.8 * (firstPoseOf(i) + 1) + 1.5 * off[0], 1.5 * off[1], 6 + 2 * off[2]});
    for (std::uint32_t pose = firstPoseOf(i); pose < firstPoseOf(i) + 3; ++pose) {
      Vec2d pixel{};
      EXPECT_TRUE(pinhole().project(b.T_world_body[pose].inverse() * b.points[i], pixel));
      b.observation_pose.push_back(pose);
      b.observation_point.push_back(i);
      b.observation_camera.push_back(0);
      b.pixels.push_back(pixel);
    }
  }
  scene.bundle = b;
  if (is_stereo) addStereo(scene, 0.3);
  for (std::uint32_t i = 0; i < kPoses; ++i) {
    scene.bundle.pose_fixed.push_back(i < (is_stereo ? 1 : 2) ? 1 : 0);
  }
  addNoise(scene, 0.5);
  return scene;
}

// Poses `first` to `last` of it, and the points that `first` or a later one sees first, or `first`
// alone.
Scene partOf(const Scene& all, std::uint32_t first, std::uint32_t last, bool only_first) {
  Scene part;
  const Bundle& a = all.bundle;
  Bundle& b = part.bundle;
  b.cameras = a.cameras;
  b.T_body_camera = a.T_body_camera;
  b.points = a.points;
  b.T_world_body.assign(a.T_world_body.begin() + first, a.T_world_body.begin() + last + 1);
  b.pose_fixed.assign(a.pose_fixed.begin() + first, a.pose_fixed.begin() + last + 1);
  part.baseline = all.baseline;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const std::uint32_t pose = a.observation_pose[i];
    const std::uint32_t begin = firstPoseOf(a.observation_point[i]);
    if (pose > last || begin < first || (only_first && begin != first)) continue;
    b.observation_pose.push_back(pose - first);
    b.observation_point.push_back(a.observation_point[i]);
    b.observation_camera.push_back(0);
    b.pixels.push_back(a.pixels[i]);
    if (!all.right_u.empty()) part.right_u.push_back(all.right_u[i]);
  }
  return part;
}

// Moves a window along; what is known of the poses that left it stays, or is forgotten.
void slide(Scene& all, bool with_prior) {
  std::vector<WindowPrior> priors;
  for (std::uint32_t last = kWindow - 1; last < kPoses; ++last) {
    const std::uint32_t first = last - kWindow + 1;
    Scene window = partOf(all, first, last, false);
    window.window_priors = priors;
    if (!with_prior) window.bundle.pose_fixed[0] = window.bundle.pose_fixed[1] = 1;
    const OptimizerSummary summary = optimizeBundle(window.problem(), thoroughPba());
    ASSERT_TRUE(summary.hasConverged()) << summary.message;
    EXPECT_NEAR(bundleCost(window.problem()), summary.final_cost, 1e-9 * summary.initial_cost);
    std::copy(window.bundle.T_world_body.begin(), window.bundle.T_world_body.end(),
              all.bundle.T_world_body.begin() + first);
    all.bundle.points = window.bundle.points;
    if (!with_prior) continue;
    Scene old = partOf(all, first, last, true);
    old.window_priors = priors;
    Indices keep(kWindow - 1);
    std::iota(keep.begin(), keep.end(), 1);
    priors = {marginalize(old.problem(), keep)};
    for (std::uint32_t& pose : priors[0].poses) --pose;  // in the next window
  }
}

double distance(const std::vector<SE3d>& a, const std::vector<SE3d>& b) {
  double sum = 0;
  for (std::size_t i = kPoses - kWindow; i < kPoses; ++i) {
    sum += (a[i].inverse() * b[i]).log().norm();
  }
  return sum;
}

TEST(window_prior, makes_a_moving_window_end_where_the_whole_does) {
  for (const bool is_stereo : {true, false}) {
    Scene whole = makeTrack(is_stereo);
    Scene with = whole, without = whole;
    ASSERT_TRUE(optimizeBundle(whole.problem(), thoroughPba()).hasConverged());
    slide(with, true);
    slide(without, false);
    const double noise = distance(whole.bundle.T_world_body, whole.truth.T_world_body);
    EXPECT_LT(distance(with.bundle.T_world_body, whole.bundle.T_world_body), 0.02 * noise);
    EXPECT_GT(distance(without.bundle.T_world_body, whole.bundle.T_world_body), 0.2 * noise);
  }
}

// The graph of a bundle at its optimum, solved from elsewhere.
void expectGraphToLeadBack(Scene scene, std::uint32_t fixed) {
  addNoise(scene, 0.3);
  scene.bundle.pose_fixed.assign(scene.bundle.T_world_body.size(), 0);
  std::fill_n(scene.bundle.pose_fixed.begin(), fixed, std::uint8_t(1));
  ASSERT_TRUE(optimizeBundle(scene.problem(), thoroughPba()).is_usable);
  PoseGraph<SE3d> graph = poseGraphOf(scene.problem());
  ASSERT_EQ(graph.from.size(), 15u);
  Random random(8);
  for (std::size_t i = fixed; i < graph.T_world_body.size(); ++i) {
    graph.T_world_body[i] *= SE3d::exp(random.tangent(0.1, 0.05));
  }
  const OptimizerSummary summary = optimizePoseGraph(graph.problem(), thoroughPba());
  EXPECT_TRUE(summary.hasConverged()) << summary.message;
  EXPECT_LT(summary.final_cost, 1e-9 * summary.initial_cost);
  for (std::size_t i = 0; i < graph.T_world_body.size(); ++i) {
    EXPECT_TRUE(graph.T_world_body[i].isApprox(scene.bundle.T_world_body[i], 1e-5)) << i;
  }
}

TEST(pose_graph_of, leads_back_to_the_poses_of_the_bundle) {
  expectGraphToLeadBack(makeScene(6, 40, {pinhole(), pinhole()}, true), 1);
}

TEST(pose_graph_of, of_one_camera_leads_back_by_directions_alone) {
  expectGraphToLeadBack(makeScene(6, 40, {pinhole()}), 2);
}

}  // namespace
}  // namespace gslam
