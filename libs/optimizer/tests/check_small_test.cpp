// What is said of poses from points, alignments and two views that cannot be right.
#include <gmock/gmock.h>
#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "backend_contract/scenes.h"
#include "not_finite.h"

namespace {

using backend_contract::complaintOf;
using gslam::OptimizerBackend;
using gslam::OptimizerOptions;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;
using gslam::Vec4d;
using testing::HasSubstr;

using not_finite::kInfinity;
using not_finite::kNan;

// A back end that does nothing, so that only the checks speak.
OptimizerOptions idleOptions() {
  OptimizerBackend idle;
  idle.name = "idle";
  idle.pose = [](const gslam::PoseProblem&, const SE3d&, const OptimizerOptions&) {
    return gslam::OptimizedPose();
  };
  idle.alignment = [](const gslam::AlignmentProblem&, const SE3d&, const OptimizerOptions&) {
    return gslam::OptimizedAlignment<SE3d>();
  };
  idle.two_view = [](const gslam::TwoViewProblem&, const SE3d&, const OptimizerOptions&) {
    return gslam::OptimizedTwoView();
  };
  gslam::registerOptimizerBackend(idle);
  OptimizerOptions options;
  options.backend = "idle";
  return options;
}

SE3d nowhere() {
  return SE3d(gslam::SO3d(), {kNan, 0, 0});
}

struct PoseInput {
  std::vector<Vec3d> points = std::vector<Vec3d>(4, Vec3d{0, 0, 5});
  std::vector<Vec2d> pixels = std::vector<Vec2d>(4, Vec2d{320, 240});
  std::vector<double> information, right_u;
  std::vector<gslam::Camera> cameras = {backend_contract::pinhole()};
  std::vector<SE3d> extrinsics;
  std::vector<std::uint32_t> camera_of;
  std::vector<std::uint8_t> inliers;
  gslam::PosePrior prior;
  bool has_prior = false;
  double baseline = 0;
  SE3d start;
};

std::string poseComplaint(const std::function<void(PoseInput&)>& change) {
  static const OptimizerOptions options = idleOptions();
  PoseInput in;
  change(in);
  gslam::PoseProblem problem;
  problem.points = in.points;
  problem.pixels = in.pixels;
  problem.information = in.information;
  problem.right_u = in.right_u;
  problem.baseline = in.baseline;
  problem.cameras = in.cameras;
  problem.T_body_camera = in.extrinsics;
  problem.camera_of = in.camera_of;
  problem.inliers = in.inliers;
  problem.prior = in.has_prior ? &in.prior : nullptr;
  return complaintOf([&] { optimizePose(problem, in.start, options); });
}

TEST(check_small, names_what_is_wrong_with_a_pose_problem) {
  EXPECT_EQ(poseComplaint([](PoseInput&) {}), "");
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.pixels.pop_back(); }),
            "pixels has 3 elements, expected 4 as of points");
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.information = {1}; }),
            "information has 1 elements, expected 4 as of points, or none");
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.points.resize(2), in.pixels.resize(2); }),
            "points has 2 elements, expected 3 or more, or a prior");
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.points[2][1] = kNan; }),
            "points[2] is not finite");
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.pixels[3][1] = kInfinity; }),
            "pixels[3] is not finite");
  EXPECT_EQ(poseComplaint([](PoseInput& in) {
              in.information = {1, 0, -2, 3};
            }),
            "information[2] is -2, expected 0 or more, and finite");
  EXPECT_EQ(poseComplaint([](PoseInput& in) {
              in.information = {1, 0, 1, kNan};
            }),
            "information[3] is nan, expected 0 or more, and finite");
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.start = nowhere(); }),
            "T_world_body is not finite");
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.inliers = {1}; }),
            "inliers has 1 elements, expected 4 as of points, or none");
}

TEST(check_small, names_what_is_wrong_with_the_cameras_of_a_pose) {
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.cameras.clear(); }),
            "cameras is empty, expected one or more");
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.cameras.emplace_back(); }),
            "cameras[1] is no camera");
  EXPECT_EQ(poseComplaint([](PoseInput& in) { in.extrinsics = {nowhere()}; }),
            "T_body_camera[0] is not finite");
  EXPECT_EQ(poseComplaint([](PoseInput& in) {
              in.camera_of = {0, 0, 1, 2};
            }),
            "camera_of[2] is 1, expected below 1");
}

TEST(check_small, looks_at_stereo_and_priors_of_a_pose) {
  EXPECT_EQ(poseComplaint([](PoseInput& in) {
              in.right_u = {1, 2, kNan, -1}, in.baseline = 0.1;
            }),
            "");
  EXPECT_EQ(poseComplaint([](PoseInput& in) {
              in.right_u = {1, 2, kNan, -1};
            }),
            "baseline is 0, expected above 0 with right_u");
  EXPECT_EQ(poseComplaint([](PoseInput& in) {
              in.right_u = {1, kInfinity, 2, 3};
              in.baseline = 1;
            }),
            "right_u[1] is not finite");
  const auto prior_only = [](PoseInput& in) {
    in.points.clear(), in.pixels.clear();
    in.has_prior = true;
  };
  EXPECT_EQ(poseComplaint(prior_only), "");
  EXPECT_EQ(poseComplaint([&](PoseInput& in) { prior_only(in), in.prior.pose = nowhere(); }),
            "prior.pose is not finite");
  EXPECT_EQ(poseComplaint([&](PoseInput& in) { prior_only(in), in.prior.information(0, 5) = 1; }),
            "prior.information is not symmetric");
}

struct AlignmentInput {
  std::vector<Vec3d> points_b = {{1, 2, 3}}, points_a = {{1, 2, 3}};
  std::vector<gslam::Mat3d> point_information;
  std::vector<Vec3d> plane_points = {{1, 2, 3}};
  std::vector<Vec4d> planes = {{0, 0, 1, -3}};
  std::vector<double> plane_information;
  std::vector<Vec3d> line_points = {{1, 2, 3}}, origins = {{0, 0, 0}}, directions = {{0, 1, 0}};
  std::vector<double> line_information;
  std::vector<SE3d> b_body = {SE3d()}, a_body = {SE3d()};
  std::vector<gslam::Mat<double, 6, 6>> pose_information;
  SE3d start;
};

std::string alignmentComplaint(const std::function<void(AlignmentInput&)>& change) {
  static const OptimizerOptions options = idleOptions();
  AlignmentInput in;
  change(in);
  gslam::AlignmentProblem problem;
  problem.points_b = in.points_b;
  problem.points_a = in.points_a;
  problem.point_information = in.point_information;
  problem.plane_points_b = in.plane_points;
  problem.planes_a = in.planes;
  problem.plane_information = in.plane_information;
  problem.line_points_b = in.line_points;
  problem.line_origins_a = in.origins;
  problem.line_directions_a = in.directions;
  problem.line_information = in.line_information;
  problem.T_b_body = in.b_body;
  problem.T_a_body = in.a_body;
  problem.pose_information = in.pose_information;
  return complaintOf([&] { optimizeAlignment(problem, in.start, options); });
}

TEST(check_small, names_what_is_wrong_with_an_alignment) {
  EXPECT_EQ(alignmentComplaint([](AlignmentInput&) {}), "");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) { in.points_a.clear(); }),
            "points_a has 0 elements, expected 1 as of points_b");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) { in.a_body.clear(); }),
            "T_a_body has 0 elements, expected 1 as of T_b_body");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) {
              in = AlignmentInput();
              in.points_a = in.points_b = in.plane_points = in.line_points = in.origins =
                  in.directions = {};
              in.planes.clear();
              in.a_body = in.b_body = {};
            }),
            "problem is empty, expected points, planes, lines or poses");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) { in.planes[0][2] = 2; }),
            "planes_a[0] has a length of 2, expected 1");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) { in.planes[0][3] = kNan; }),
            "planes_a[0] is not finite");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) {
              in.directions[0] = {0, 0, 0};
            }),
            "line_directions_a[0] has a length of 0, expected 1");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) { in.plane_information = {-1}; }),
            "plane_information[0] is -1, expected 0 or more, and finite");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) { in.line_information = {kInfinity}; }),
            "line_information[0] is inf, expected 0 or more, and finite");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) {
              in.point_information = {gslam::Mat3d::identity()};
              in.point_information[0](1, 1) = -1;
            }),
            "point_information[0] is not positive semi-definite");
  EXPECT_EQ(alignmentComplaint([](AlignmentInput& in) { in.start = nowhere(); }),
            "T_a_b is not finite");
}

struct TwoViewInput {
  std::vector<Vec2d> first = std::vector<Vec2d>(5, Vec2d{300, 200}), second = first;
  std::vector<double> depths = std::vector<double>(5, 0.1), information, depth_information;
  gslam::Camera camera = backend_contract::pinhole(), other = camera;
  SE3d start = SE3d(gslam::SO3d(), {1, 0, 0});
};

std::string twoViewComplaint(const std::function<void(TwoViewInput&)>& change) {
  static const OptimizerOptions options = idleOptions();
  TwoViewInput in;
  change(in);
  gslam::TwoViewProblem problem;
  problem.first = in.first;
  problem.second = in.second;
  problem.information = in.information;
  problem.first_camera = in.camera;
  problem.second_camera = in.other;
  problem.inverse_depths = in.depths;
  problem.depth_information = in.depth_information;
  return complaintOf([&] { optimizeTwoView(problem, in.start, options); });
}

TEST(check_small, names_what_is_wrong_with_two_views) {
  EXPECT_EQ(twoViewComplaint([](TwoViewInput&) {}), "");
  EXPECT_EQ(twoViewComplaint([](TwoViewInput& in) { in.second.pop_back(); }),
            "second has 4 elements, expected 5 as of first");
  EXPECT_EQ(twoViewComplaint([](TwoViewInput& in) {
              in.first.pop_back(), in.second.pop_back(), in.depths.pop_back();
            }),
            "first has 4 elements, expected 5 or more");
  EXPECT_EQ(twoViewComplaint([](TwoViewInput& in) { in.depths[3] = -0.1; }),
            "inverse_depths[3] is -0.1, expected 0 or more, and finite");
  EXPECT_EQ(twoViewComplaint([](TwoViewInput& in) { in.depths[3] = 0; }), "");
  EXPECT_EQ(twoViewComplaint([](TwoViewInput& in) { in.other = gslam::Camera(); }),
            "second_camera is no camera");
  EXPECT_EQ(twoViewComplaint([](TwoViewInput& in) {
              in.camera = gslam::Camera::fromParameters("kannala_brandt", 640, 480,
                                                        {200, 200, 320, 240, 0, 0, 0, 0});
              in.first[2] = {3000, 0};
            }),
            "first[2] cannot be unprojected by first_camera");
  const auto still = [](TwoViewInput& in) { in.start = SE3d(); };
  EXPECT_THAT(twoViewComplaint(still), HasSubstr("T_first_second has a translation of 0"));
  EXPECT_EQ(
      twoViewComplaint([&](TwoViewInput& in) { still(in), in.depth_information.assign(5, 1); }),
      "");
  EXPECT_THAT(
      twoViewComplaint([&](TwoViewInput& in) { still(in), in.depth_information.assign(5, 0); }),
      HasSubstr("T_first_second has a translation of 0"));
}

}  // namespace
