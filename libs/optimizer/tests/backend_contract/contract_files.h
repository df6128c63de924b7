// The contract: problems of files whose optimum others published.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_FILES_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_FILES_H

#include "../../../../tests/harness/test_data.h"
#include "fixture.h"
#include "stereo_factors.h"

namespace backend_contract {

/// The 26 frames of GTSAM's StereoVOExample_large.
inline BundleScene stereoOdometry() {
  const std::string folder = test_data::folder() + "bundle_adjustment/gtsam/";
  return readStereoScene(folder + "VO_calibration.txt", folder + "VO_camera_poses_large.txt",
                         folder + "VO_stereo_factors_large.txt");
}

}  // namespace backend_contract

// The optimum is that of a program of its own, with its own derivatives and nothing of this
// library: Gauss and Newton until the cost no longer falls. GTSAM's solvers are published to end at
// 1577.030618 (its comparison of linear solvers, "stereo26"; a unit prior on the first pose instead
// of holding it, which costs nothing at the optimum): it stops where a step lowers the cost by less
// than 1e-5 of it.
TEST_P(BackendContract, reaches_the_optimum_of_gtsams_stereo_factors) {
  using namespace backend_contract;
  NEEDS_FUNCTION(bundle);
  NEEDS_TEST_DATA();
  BundleScene scene = stereoOdometry();
  ASSERT_EQ(scene.poses.size(), 26u);
  ASSERT_EQ(scene.points.size(), 2634u);
  ASSERT_EQ(scene.pixels.size(), 8189u);
  const gslam::OptimizerSummary summary = solveChecked(scene, options());
  EXPECT_TRUE(summary.hasConverged()) << fullReport(summary);
  EXPECT_EQ(summary.residuals, 3u * 8189u);
  EXPECT_EQ(summary.parameters, 25u * 6u + 3u * 2634u);
  EXPECT_EQ(summary.left_out, 0u);
  EXPECT_NEAR(summary.final_cost, 1577.0254901954, 1e-6) << fullReport(summary);
  const double of_gtsam = 1577.030618;
  EXPECT_LE(summary.final_cost, of_gtsam);
  EXPECT_GE(summary.final_cost, of_gtsam * (1 - 1e-5));
}

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_FILES_H
