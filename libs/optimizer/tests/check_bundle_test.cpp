#include <gmock/gmock.h>
#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "backend_contract/scenes.h"
#include "not_finite.h"

namespace {

using backend_contract::BundleScene;
using backend_contract::bundleScene;
using gslam::BundleProblem;
using gslam::SE3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using not_finite::kNan;

// "error field problem" and "warning field problem", one by one.
std::vector<std::string> findingsOf(const BundleProblem& problem) {
  std::vector<std::string> texts;
  for (const gslam::ProblemFinding& finding : checkBundle(problem)) {
    texts.push_back((finding.is_error ? "error " : "warning ") + finding.field + " " +
                    finding.problem);
  }
  return texts;
}

// Of a scene without findings, after a change.
std::vector<std::string> findingsAfter(const std::function<void(BundleScene&)>& change) {
  BundleScene scene = bundleScene(4, 20, 0.01);
  change(scene);
  return findingsOf(scene.problem());
}

TEST(check_bundle, finds_nothing_in_a_good_problem) {
  EXPECT_THAT(findingsAfter([](BundleScene&) {}), IsEmpty());
  EXPECT_THAT(findingsOf(BundleProblem()),
              ElementsAre("warning problem has no variables: all of it is fixed"));
}

TEST(check_bundle, names_the_first_of_each_kind_and_counts_the_others) {
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.of_point[17] = 900; }),
              ElementsAre("error observation_point[17] is 900, expected below 20"));
  EXPECT_THAT(
      findingsAfter([](BundleScene& s) {
        s.of_point[17] = 900;
        s.of_point[18] = 901;
        s.of_pose[3] = s.of_pose[5] = s.of_pose[9] = 4;
        s.points[2][1] = kNan;
      }),
      ElementsAre(
          "error observation_pose[3] is 4, expected below 4 (and 2 others of this kind)",
          "error observation_point[17] is 900, expected below 20 (and 1 other of this kind)",
          "error points[2] is not finite"));
}

TEST(check_bundle, finds_sizes_that_differ) {
  const auto has = [](const char* text) { return testing::Contains(HasSubstr(text)); };
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.of_pose.pop_back(); }),
              ElementsAre("error observation_pose has 79 elements, expected 80 as of pixels"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.pose_fixed.pop_back(); }),
              has("pose_fixed has 3 elements, expected 4 as of T_world_body, or none"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.point_fixed = {1}; }), has("point_fixed has 1"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.anchors = {1}; }), has("point_anchor has 1"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.freedom.resize(2); }),
              has("camera_freedom has"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.extrinsics.resize(2); }), has("T_body_camera"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.extrinsic_free = {1}; }),
              has("T_body_camera_free has 1 elements, expected 0"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.of_camera.resize(3); }),
              has("observation_camera has 3"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.information.resize(3); }),
              has("information has 3"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.right_u.resize(3); }), has("right_u has 3"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.right_u.resize(80, kNan); }),
              has("baseline has 0 elements, expected 1 as of cameras"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) {
                s.cameras.clear();
                s.of_camera.clear();
              }),
              has("cameras is empty, expected one or more"));
}

TEST(check_bundle, finds_numbers_that_are_not_finite) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(findingsAfter([&](BundleScene& s) { s.pixels[5][1] = infinity; }),
              ElementsAre("error pixels[5] is not finite"));
  EXPECT_THAT(findingsAfter([&](BundleScene& s) {
                s.poses[1] = SE3d(s.poses[1].rotation(), {0, kNan, 0});
              }),
              ElementsAre("error T_world_body[1] is not finite"));
  EXPECT_THAT(findingsAfter([&](BundleScene& s) {
                s.extrinsics = {SE3d(gslam::SO3d(), {infinity, 0, 0})};
              }),
              ElementsAre("error T_body_camera[0] is not finite"));
  EXPECT_THAT(findingsAfter([&](BundleScene& s) {
                s.information.assign(80, {1, 0, 1});
                s.information[7][2] = kNan;
              }),
              ElementsAre("error information[7] is not finite"));
}

TEST(check_bundle, finds_information_that_is_none) {
  EXPECT_THAT(findingsAfter([&](BundleScene& s) {
                s.information.assign(80, {1, 0, 1});
                s.information[3] = {4, -2, 1};  // singular is good
                s.information[7] = {1, 1.1, 1};
                s.information[8] = {-1, 0, 1};
              }),
              ElementsAre("error information[7] is not positive semi-definite (and 1 other of this "
                          "kind)"));
  EXPECT_THAT(findingsAfter([&](BundleScene& s) {
                s.information.assign(80, {1e200, 1e200, 1e200});  // whose products overflow
                s.information[5] = {1e200, 1e250, 1e200};
                s.information[6] = {1e-200, 1e-180, 1e-200};
                s.information[9] = {1e-200, 1e-200, 1e-200};
              }),
              ElementsAre("error information[5] is not positive semi-definite (and 1 other of this "
                          "kind)"));
  EXPECT_THAT(findingsAfter([&](BundleScene& s) {
                s.position_priors.resize(3);
                s.position_priors[1].information(0, 0) = -1;
              }),
              ElementsAre("error position_priors[1].information is not positive semi-definite"));
  EXPECT_THAT(findingsAfter([&](BundleScene& s) {
                s.pose_priors.resize(1);
                s.pose_priors[0].information(3, 4) = 1;
              }),
              ElementsAre("error pose_priors[0].information is not symmetric"));
}

TEST(check_bundle, finds_priors_of_poses_that_are_not_there) {
  EXPECT_THAT(findingsAfter([](BundleScene& s) {
                s.position_priors.resize(1);
                s.position_priors[0].pose = 4;
                s.pose_priors.resize(2);
                s.pose_priors[1].pose = 5;
                s.relative_priors.resize(1);
                s.relative_priors[0].to = 6;
              }),
              ElementsAre("error position_priors[0].pose is 4, expected below 4",
                          "error pose_priors[1].pose is 5, expected below 4",
                          "error relative_priors[0].to is 6, expected below 4"));
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.relative_priors.resize(1); }),
              ElementsAre("error relative_priors[0] leads from a pose to itself"));
}

gslam::WindowPrior goodWindow() {
  gslam::WindowPrior prior;
  prior.poses = {1, 3};
  prior.T_linear.resize(2);
  prior.information.assign(144, 0);
  for (std::size_t i = 0; i < 12; ++i) prior.information[13 * i] = 1;
  prior.gradient.assign(12, 0.5);
  return prior;
}

TEST(check_bundle, looks_into_window_priors) {
  const auto after = [](const std::function<void(gslam::WindowPrior&)>& change) {
    return findingsAfter([&](BundleScene& s) {
      s.window_priors = {goodWindow()};
      change(s.window_priors[0]);
    });
  };
  EXPECT_THAT(after([](gslam::WindowPrior&) {}), IsEmpty());
  EXPECT_THAT(after([](gslam::WindowPrior& p) { p.T_linear.pop_back(); }),
              ElementsAre("error window_priors[0].T_linear has 1 elements, expected 2 as of its "
                          "poses"));
  EXPECT_THAT(after([](gslam::WindowPrior& p) { p.gradient.pop_back(); }),
              ElementsAre(HasSubstr("window_priors[0].information or gradient has a size")));
  EXPECT_THAT(after([](gslam::WindowPrior& p) { p.poses[1] = 7; }),
              ElementsAre("error window_priors[0].poses[1] is 7, expected below 4"));
  EXPECT_THAT(after([](gslam::WindowPrior& p) { p.poses[1] = 1; }),
              ElementsAre("error window_priors[0].poses[1] is named twice"));
  EXPECT_THAT(after([](gslam::WindowPrior& p) { p.gradient[3] = kNan; }),
              ElementsAre("error window_priors[0].gradient is not finite"));
  EXPECT_THAT(after([](gslam::WindowPrior& p) { p.information[0] = -1; }),
              ElementsAre("error window_priors[0].information is not positive semi-definite"));
  EXPECT_THAT(after([](gslam::WindowPrior& p) { p.information[1] = 1e-3; }),
              ElementsAre("error window_priors[0].information is not symmetric"));
}

TEST(check_bundle, finds_cameras_that_are_none_and_freedoms_that_they_do_not_have) {
  EXPECT_THAT(findingsAfter([](BundleScene& s) { s.cameras[0] = gslam::Camera(); }),
              ElementsAre("error cameras[0] is no camera"));
  const auto with = [](const gslam::Camera& camera, const gslam::CameraFreedom& freedom) {
    return findingsAfter([&](BundleScene& s) {
      s.cameras[0] = camera;
      s.freedom = {freedom};
    });
  };
  EXPECT_THAT(with(backend_contract::pinhole(), {0xf, true}), IsEmpty());
  EXPECT_THAT(with(backend_contract::pinhole(), {0x10, false}),
              ElementsAre("error camera_freedom[0] has bits beyond the 4 parameters of pinhole"));
}

TEST(check_bundle, looks_at_anchors) {
  EXPECT_THAT(findingsAfter([](BundleScene& s) {
                s.anchors.assign(20, BundleProblem::kNoAnchor);
                s.anchors[3] = 4;
                s.anchors[5] = 1;
                s.points[5] = s.poses[1].translation();
                s.anchors[6] = 2;
                s.poses[2] = SE3d();
                s.points[6] = {1e-310, 0, 0};
              }),
              ElementsAre("error point_anchor[3] is 4, expected below 4, or kNoAnchor",
                          "error points[5] is at its anchor: its inverse distance is infinite "
                          "(and 1 other of this kind)"));
}

TEST(check_bundle, looks_at_stereo) {
  const auto with = [](double baseline, double right) {
    return findingsAfter([&](BundleScene& s) {
      s.baseline = {baseline};
      s.right_u.assign(80, kNan);
      s.right_u[4] = right;
    });
  };
  EXPECT_THAT(with(0.1, 300), IsEmpty());
  EXPECT_THAT(with(0, kNan), IsEmpty());
  EXPECT_THAT(with(0, 300), ElementsAre(HasSubstr("right_u[4] is given, but the baseline")));
  EXPECT_THAT(with(0.1, -std::numeric_limits<double>::infinity()),
              ElementsAre(HasSubstr("right_u[4] is not finite")));
}

TEST(check_bundle, warns_of_what_is_not_observed_or_seen_once) {
  EXPECT_THAT(findingsAfter([](BundleScene& s) {
                s.points.insert(s.points.end(), {{1, 2, 3}, {1, 2, 3}, {0.1, 0.2, 0.3}});
                s.poses.push_back(s.poses.back());
                s.pose_fixed.push_back(0);
                s.cameras.push_back(s.cameras[0]);
                s.of_pose.push_back(3);
                s.of_point.push_back(22);
                s.of_camera.push_back(0);
                s.pixels.push_back({300, 200});
              }),
              ElementsAre("warning T_world_body[4] has neither observations nor priors: it stays",
                          "warning cameras[1] has no observations: it stays",
                          "warning points[20] has no observations: it stays (and 1 other of this "
                          "kind)",
                          "warning points[22] is seen once: its distance is not determined"));
}

TEST(check_bundle, warns_of_points_without_parallax_unless_a_pair_sees_them) {
  const auto far = [](BundleScene& s) { s.points[4] = {0, 0, 1e6}; };
  EXPECT_THAT(findingsAfter(far),
              ElementsAre(HasSubstr("warning points[4] is seen without parallax")));
  EXPECT_THAT(findingsAfter([&](BundleScene& s) {
                far(s);
                s.point_fixed.assign(20, 0);
                s.point_fixed[4] = 1;
              }),
              IsEmpty());
  EXPECT_THAT(findingsAfter([&](BundleScene& s) {
                far(s);
                s.baseline = {0.2};
                s.right_u.assign(80, kNan);
                s.right_u[44] = 10;  // point 4 from pose 2
              }),
              IsEmpty());
}

}  // namespace
