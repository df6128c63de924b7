// What fixes position, orientation and scale of a bundle, and of each of its parts.
#include <gmock/gmock.h>
#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "backend_contract/scenes.h"

namespace {

using backend_contract::BundleScene;
using backend_contract::bundleScene;
using gslam::SE3d;
using testing::HasSubstr;

// The warning, without what all have in common; empty: all is fixed.
std::string freedomOf(const std::function<void(BundleScene&)>& change) {
  BundleScene scene = bundleScene(5, 20, 0.01);
  scene.pose_fixed.clear();
  change(scene);
  for (const gslam::ProblemFinding& finding : checkBundle(scene.problem())) {
    EXPECT_FALSE(finding.is_error) << finding.field << " " << finding.problem;
    const std::size_t at = finding.problem.find("fixes its ");
    if (at != std::string::npos) {
      return finding.problem.substr(at + 10, finding.problem.find('.') - at - 10);
    }
  }
  return "";
}

TEST(check_gauge, knows_what_fixes_a_bundle) {
  const auto all = gslam::Mat<double, 6, 6>::identity();
  const auto place = gslam::Mat3d::identity();
  EXPECT_EQ(freedomOf([](BundleScene&) {}), "position, orientation, scale");
  EXPECT_EQ(freedomOf([](BundleScene& s) { s.pose_fixed = {0, 0, 1, 0, 0}; }), "scale");
  EXPECT_EQ(freedomOf([](BundleScene& s) { s.pose_fixed = {0, 0, 1, 1, 0}; }), "");
  EXPECT_EQ(freedomOf([](BundleScene& s) { s.position_priors.resize(1); }),
            "position, orientation, scale");  // without information
  EXPECT_EQ(freedomOf([&](BundleScene& s) {
              s.position_priors = {{0, {}, place}};
            }),
            "orientation, scale");
  EXPECT_EQ(freedomOf([&](BundleScene& s) {
              s.position_priors = {{0, {}, place}, {1, {}, place}};
            }),
            "orientation");
  EXPECT_EQ(freedomOf([&](BundleScene& s) {
              s.position_priors = {{0, {}, place}, {1, {}, place}, {2, {}, place}};
            }),
            "");
  EXPECT_EQ(freedomOf([&](BundleScene& s) { s.pose_priors = {{0, SE3d(), all}}; }), "scale");
  EXPECT_EQ(freedomOf([&](BundleScene& s) {
              s.pose_priors = {{0, SE3d(), {}}};
            }),
            "position, orientation, scale");
  EXPECT_EQ(freedomOf([&](BundleScene& s) {
              s.relative_priors = {{0, 1, SE3d(), all}};
            }),
            "position, orientation");
  EXPECT_EQ(freedomOf([](BundleScene& s) {
              s.point_fixed = {1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
            }),
            "");
  EXPECT_EQ(freedomOf([](BundleScene& s) {
              s.baseline = {0.1};
              s.right_u.assign(s.pixels.size(), 3);
            }),
            "position, orientation");
}

TEST(check_gauge, looks_at_each_part) {
  // Poses 0 and 1 see the first ten points, the others the last ten.
  BundleScene scene = bundleScene(5, 20, 0.01), parted = scene;
  parted.of_pose.clear();
  parted.of_point.clear();
  parted.of_camera.clear();
  parted.pixels.clear();
  for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
    if ((scene.of_pose[i] < 2) != (scene.of_point[i] < 10)) continue;
    parted.of_pose.push_back(scene.of_pose[i]);
    parted.of_point.push_back(scene.of_point[i]);
    parted.of_camera.push_back(0);
    parted.pixels.push_back(scene.pixels[i]);
  }
  const std::vector<gslam::ProblemFinding> findings = checkBundle(parted.problem());
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].field, "T_world_body[2]");
  EXPECT_THAT(findings[0].problem, HasSubstr("begins one of 2 parts without common points, and "
                                             "nothing fixes its position, orientation, scale"));
  // An edge between the two makes them one.
  parted.relative_priors = {{1, 4, SE3d(), gslam::Mat<double, 6, 6>::identity()}};
  EXPECT_TRUE(checkBundle(parted.problem()).empty());
}

// Linear in time: a second or two where it were not, with sanitizers.
TEST(check_gauge, is_found_in_large_problems) {
  const std::uint32_t poses = 1000, points = 30000;
  BundleScene scene;
  scene.cameras = {backend_contract::pinhole()};
  for (std::uint32_t i = 0; i < poses; ++i) {
    scene.poses.push_back(SE3d(gslam::SO3d(), {0.1 * i, 0, 0}));
  }
  for (std::uint32_t i = 0; i < points; ++i) {
    scene.points.push_back({0.1 * (i % poses), 0.01 * (i % 97), 8});
    for (std::uint32_t k = 0; k < 5; ++k) {
      scene.of_pose.push_back((i + k) % poses);
      scene.of_point.push_back(i);
      scene.pixels.push_back({320, 240});
    }
  }
  const std::vector<gslam::ProblemFinding> findings = checkBundle(scene.problem());
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_THAT(findings[0].problem, HasSubstr("position, orientation, scale"));
}

}  // namespace
