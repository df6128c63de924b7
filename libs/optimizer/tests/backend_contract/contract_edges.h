// Problems at the edge of what the checks let pass: a result, nothing that is not finite, and
// variables that are what they were where the result is not usable.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_EDGES_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_EDGES_H

#include <limits>

#include "fixture.h"

namespace backend_contract {

template <class T>
bool isFinite(const std::vector<T>& values) {
  for (const T& value : values) {
    for (std::size_t k = 0; k < sizeof(T) / sizeof(double); ++k) {
      if (!std::isfinite(value.data()[k])) return false;
    }
  }
  return true;
}

inline bool areFiniteCameras(const std::vector<Camera>& cameras) {
  return std::all_of(cameras.begin(), cameras.end(), [](const Camera& camera) {
    const std::vector<double> values = camera.parameters();
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  });
}

/// Nothing is said of the cost, which may be too large for a number.
inline gslam::OptimizerSummary expectSurvived(BundleScene& scene,
                                              const gslam::OptimizerOptions& options) {
  const BundleScene before = scene;
  const gslam::OptimizerSummary summary = optimizeBundle(scene.problem(), options);
  EXPECT_TRUE(isFinite(scene.poses) && isFinite(scene.points) && isFinite(scene.extrinsics))
      << fullReport(summary);
  EXPECT_TRUE(areFiniteCameras(scene.cameras)) << fullReport(summary);
  EXPECT_FALSE(summary.message.empty());
  if (summary.is_usable) {
    EXPECT_TRUE(std::isfinite(summary.final_cost)) << fullReport(summary);
    EXPECT_LE(summary.final_cost, summary.initial_cost) << fullReport(summary);
  } else {
    EXPECT_TRUE(areSameBits(scene.poses, before.poses)) << fullReport(summary);
    EXPECT_TRUE(areSameBits(scene.points, before.points)) << fullReport(summary);
    EXPECT_TRUE(areSameBits(scene.cameras, before.cameras)) << fullReport(summary);
  }
  return summary;
}

template <class Group>
void expectGraphSurvived(gslam::PoseGraph<Group> graph, const gslam::OptimizerOptions& options) {
  const std::vector<Group> before = graph.T_world_body;
  const gslam::OptimizerSummary summary = optimizePoseGraph(graph.problem(), options);
  EXPECT_TRUE(isFinite(graph.T_world_body)) << fullReport(summary);
  EXPECT_FALSE(summary.message.empty());
  if (summary.is_usable) {
    EXPECT_LE(summary.final_cost, summary.initial_cost) << fullReport(summary);
  } else {
    EXPECT_TRUE(areSameBits(graph.T_world_body, before)) << fullReport(summary);
  }
}

template <class Group>
void expectGraphsSurvived(const gslam::OptimizerOptions& options) {
  const gslam::PoseGraph<Group> good = graphScene<Group>(12, 0.1).graph;
  expectGraphSurvived<Group>({}, options);
  gslam::PoseGraph<Group> graph = good;
  graph.pose_fixed.assign(12, 1);
  expectGraphSurvived(graph, options);
  for (const double weight : {0.0, 1e-30, 1e30, 1e200}) {
    SCOPED_TRACE(weight);
    graph = good;
    for (auto& information : graph.information) information = weight * information;
    expectGraphSurvived(graph, options);
  }
  graph = good;
  for (std::size_t i = 0; i < graph.from.size(); ++i) {  // each edge twice, once the other way
    if (graph.from[i] > graph.to[i]) continue;
    graph.from.push_back(graph.to[i]);
    graph.to.push_back(graph.from[i]);
    graph.T_from_to.push_back(graph.T_from_to[i].inverse());
    graph.information.push_back(graph.information[i]);
    graph.is_robust.push_back(1);
    if (i > 20) break;
  }
  expectGraphSurvived(graph, options);
  graph = good;
  typename Group::Tangent far{};
  far[0] = 1e200;
  graph.T_world_body[5] = Group::exp(far);
  expectGraphSurvived(graph, options);
  graph = good;
  typename Group::Tangent turned{};
  turned[Group::kFreedom == 3 ? 2 : 4] = 3.14159265358979;
  for (Group& pose : graph.T_world_body) pose = pose * Group::exp(turned);
  graph.T_world_body[6] = graph.T_world_body[6] * Group::exp(turned);
  expectGraphSurvived(graph, options);
}

/// Where something is not determined there is a message, and else numbers.
template <class Covariance>
void expectSaid(const Covariance& found, std::size_t poses) {
  if (!found.is_valid) {
    EXPECT_FALSE(found.message.empty());
    return;
  }
  ASSERT_EQ(found.poses.size(), poses);
  EXPECT_TRUE(isFinite(found.poses));
}

template <class Group>
void expectGraphCovariances(const gslam::OptimizerOptions& options) {
  gslam::PoseGraph<Group> graph = graphScene<Group>(12, 0).graph;
  const std::vector<std::uint32_t> twice = {4, 4, 0}, none;
  const auto found = poseGraphCovariance(graph.problem(), twice, options);
  EXPECT_TRUE(found.is_valid) << found.message;
  expectSaid(found, 3);
  EXPECT_TRUE(areSameBits(found.poses[0], found.poses[1]));
  expectSaid(poseGraphCovariance(graph.problem(), none, options), 0);
  graph.T_world_body.push_back(Group());  // without edges
  graph.pose_fixed.push_back(0);
  const std::vector<std::uint32_t> loose = {12};
  EXPECT_FALSE(poseGraphCovariance(graph.problem(), loose, options).is_valid);
  expectSaid(poseGraphCovariance(gslam::PoseGraph<Group>().problem(), none, options), 0);
}

}  // namespace backend_contract

TEST_P(BackendContract, survives_bundles_with_little_in_them) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  BundleScene empty;
  expectSurvived(empty, options());
  BundleScene unseen = bundleScene(4, 10, 0.01);
  unseen.of_pose.clear(), unseen.of_point.clear(), unseen.of_camera.clear();
  unseen.pixels.clear();
  const BundleScene before = unseen;
  expectSurvived(unseen, options());
  EXPECT_TRUE(areSameBits(unseen.points, before.points));
  // Poses alone, held by what is known about them.
  BundleScene known;
  known.poses.assign(3, SE3d::exp({0.1, 0, 0, 0, 0.1, 0}));
  const auto all = gslam::Mat<double, 6, 6>::identity();
  known.pose_priors = {{0, SE3d(), all}};
  known.relative_priors = {{0, 1, SE3d::exp({1, 0, 0, 0, 0, 0}), all}};
  known.position_priors = {{2, {1, 2, 3}, gslam::Mat3d::identity()}};
  known.window_priors.emplace_back();
  const gslam::OptimizerSummary summary = expectSurvived(known, options());
  EXPECT_LT(summary.final_cost, 1e-12) << fullReport(summary);
  EXPECT_LT((known.poses[2].translation() - Vec3d{1, 2, 3}).norm(), 1e-6);
  // What is known of what is fixed.
  BundleScene fixed = bundleScene(4, 10, 0.01);
  fixed.relative_priors = {{0, 1, SE3d(), all}};
  fixed.pose_priors = {{0, SE3d(), all}};
  expectSurvived(fixed, options());
}

TEST_P(BackendContract, survives_numbers_that_are_far_off) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  for (const double size : {1e8, 1e40, 1e200}) {
    SCOPED_TRACE(size);
    BundleScene far = bundleScene(4, 20, 0.01);
    far.points[3] = {size, -size, size};
    expectSurvived(far, options());
    far.anchors.assign(20, gslam::BundleProblem::kNoAnchor);
    far.anchors[3] = 2;
    far.points[3] = {size, -size, size};
    expectSurvived(far, options());
    BundleScene pixels = bundleScene(4, 20, 0.01);
    pixels.pixels[7] = {size, 0};
    expectSurvived(pixels, options());
    BundleScene heavy = bundleScene(4, 20, 0.01);
    heavy.information.assign(heavy.pixels.size(), {size, 0, size});
    expectSurvived(heavy, options());
  }
  BundleScene at_centre = bundleScene(4, 20, 0.01);
  at_centre.points[5] = at_centre.poses[3].translation();
  expectSurvived(at_centre, options());
  BundleScene all_there = bundleScene(4, 20, 0.01);
  for (Vec3d& point : all_there.points) point = all_there.poses[0].translation();
  expectSurvived(all_there, options());
}

TEST_P(BackendContract, survives_freedoms_that_mean_little) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  // A follower without a leader.
  BundleScene follower = bundleScene(5, 20, 0.01);
  follower.freedom = {{0x2, true}};
  const BundleScene before = follower;
  expectSurvived(follower, options());
  EXPECT_TRUE(areSameBits(follower.cameras, before.cameras));
  BundleScene sphere =
      bundleScene(5, 20, 0.01, Camera::fromParameters("equirectangular", 1024, 512, {}));
  sphere.freedom = {{0x1, true}};
  expectSurvived(sphere, options());
  // A camera that nothing is seen with, and an anchor that sees nothing.
  BundleScene unused = bundleScene(5, 20, 0.01);
  unused.cameras.push_back(pinhole());
  unused.extrinsics.assign(2, SE3d());
  unused.extrinsic_free = {0, 1};
  unused.freedom = {{0, false}, {0xf, false}};
  unused.poses.push_back(SE3d::exp({0, 0, -9, 0, 0, 0}));
  unused.pose_fixed.push_back(0);
  unused.anchors.assign(20, gslam::BundleProblem::kNoAnchor);
  unused.anchors[3] = 5;
  expectSurvived(unused, options());
  EXPECT_EQ(unused.cameras[1].parameters(), pinhole().parameters());
}

TEST_P(BackendContract, takes_every_value_of_options_that_is_allowed) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  const auto solve = [&](const std::function<void(gslam::OptimizerOptions&)>& change) {
    BundleScene scene = bundleScene(4, 20, 0.01);
    addNoise(scene, 0.3);
    gslam::OptimizerOptions chosen = options();
    chosen.max_iterations = 20;
    change(chosen);
    const gslam::OptimizerSummary summary = expectSurvived(scene, chosen);
    EXPECT_TRUE(summary.is_usable) << fullReport(summary);
  };
  solve([](auto& o) { o.threads = 0; });
  solve([](auto& o) { o.threads = std::numeric_limits<unsigned>::max(); });
  solve([](auto& o) { o.max_seconds = 1e300; });
  solve([](auto& o) { o.function_tolerance = 1e300; });
  solve([](auto& o) { o.initial_damping = 1e300; });
  solve([](auto& o) { o.initial_damping = 1e-300; });
  solve([](auto& o) { o.parameter_tolerance = 1e300; });
  solve([](auto& o) { o.function_tolerance = o.gradient_tolerance = o.parameter_tolerance = 0; });
  for (const double scale : {1e-100, 1e100}) {
    for (const gslam::RobustLoss& loss : allLosses()) {
      solve([&](auto& o) { o.loss = {loss.kind, scale}; });
    }
  }
  for (const double tolerance : {0.0, 0.999}) {
    solve([&](auto& o) {
      o.linear_tolerance = tolerance;
      o.linear_solver = gslam::LinearSolverKind::Iterative;
      o.max_linear_iterations = tolerance == 0 ? std::numeric_limits<std::size_t>::max() : 1;
    });
  }
}

TEST_P(BackendContract, survives_pose_graphs_at_the_edge) {
  using namespace backend_contract;
  if (backend().pose_graph_2d) expectGraphsSurvived<SE2d>(options());
  if (backend().pose_graph_3d) expectGraphsSurvived<SE3d>(options());
  if (backend().pose_graph_sim3) expectGraphsSurvived<SIM3d>(options());
}

TEST_P(BackendContract, says_what_covariances_are_not_determined) {
  using namespace backend_contract;
  if (backend().covariance_2d) expectGraphCovariances<SE2d>(options());
  if (backend().covariance_3d) expectGraphCovariances<SE3d>(options());
  if (backend().covariance_sim3) expectGraphCovariances<SIM3d>(options());
  NEEDS_FUNCTION(bundle_covariance);
  const std::vector<std::uint32_t> poses = {2, 2, 0}, points = {4, 4}, cameras = {0, 0}, none;
  BundleScene scene = bundleScene(4, 20, 0);
  scene.freedom = {{0x5, false}};
  const gslam::BundleCovariance found =
      bundleCovariance(scene.problem(), poses, points, cameras, options());
  EXPECT_TRUE(found.is_valid) << found.message;
  expectSaid(found, 3);
  ASSERT_EQ(found.cameras.size(), 2u);
  EXPECT_EQ(found.cameras[0].size(), 4u);
  EXPECT_EQ(found.cameras[0], found.cameras[1]);
  EXPECT_TRUE(areSameBits(found.poses[0], found.poses[1]));
  EXPECT_TRUE(areSameBits(found.points[0], found.points[1]));
  expectSaid(bundleCovariance(scene.problem(), none, none, none, options()), 0);
  BundleScene empty;
  expectSaid(bundleCovariance(empty.problem(), none, none, none, options()), 0);
  scene.points.push_back({1, 2, 3});  // that nobody sees
  const std::vector<std::uint32_t> unseen = {20};
  EXPECT_FALSE(bundleCovariance(scene.problem(), none, unseen, none, options()).is_valid);
}

TEST_P(BackendContract, survives_small_problems_at_the_edge) {
  using namespace backend_contract;
  if (backend().pose) {
    const Camera camera = pinhole();
    const std::vector<Vec2d> pixels(5, Vec2d{320, 240});
    for (const Vec3d& point : {Vec3d{0, 0, 5}, Vec3d{0, 0, -5}, Vec3d{}, Vec3d{1e200, 0, 1e200},
                               Vec3d{1e-200, 0, 1e-200}}) {
      SCOPED_TRACE(point[2]);
      const std::vector<Vec3d> points(5, point);
      gslam::PoseProblem problem;
      problem.points = points;
      problem.pixels = pixels;
      problem.cameras = gslam::Span<const Camera>(&camera, 1);
      const gslam::OptimizedPose found = optimizePose(problem, SE3d(), options());
      EXPECT_TRUE(isFinite<SE3d>({found.T_world_body}));
      EXPECT_TRUE((isFinite<gslam::Mat<double, 6, 6>>({found.covariance})));
      EXPECT_TRUE(found.is_usable || areSameBits(found.T_world_body, SE3d()));
    }
  }
  if (backend().alignment) {
    for (const double size : {0.0, 1.0, 1e200}) {
      SCOPED_TRACE(size);
      const std::vector<Vec3d> a(4, Vec3d{size, 0, 0}), b(4, Vec3d{0, size, 0});
      gslam::AlignmentProblem problem;
      problem.points_a = a;
      problem.points_b = b;
      const auto found = optimizeAlignment(problem, SE3d(), options());
      EXPECT_TRUE(isFinite<SE3d>({found.T_a_b})) << fullReport(found.summary);
      EXPECT_TRUE((isFinite<gslam::Mat<double, 6, 6>>({found.covariance})));
    }
  }
  if (backend().two_view) {
    const std::vector<Vec2d> pixels(8, Vec2d{320, 240});
    for (const double inverse : {0.0, 1.0, 1e200}) {
      SCOPED_TRACE(inverse);
      std::vector<double> depths(8, inverse);
      gslam::TwoViewProblem problem;
      problem.first = problem.second = pixels;
      problem.first_camera = problem.second_camera = pinhole();
      problem.inverse_depths = depths;
      const SE3d start(SO3d(), {1, 0, 0});
      const auto found = optimizeTwoView(problem, start, options());
      EXPECT_TRUE(isFinite<SE3d>({found.T_first_second})) << fullReport(found.summary);
      EXPECT_TRUE((isFinite<gslam::Mat<double, 6, 6>>({found.covariance})));
      for (const double depth : depths) EXPECT_TRUE(std::isfinite(depth));
    }
  }
}

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_EDGES_H
