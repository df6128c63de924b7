// evo's own figures for its own data, in trajectories/evo_reference.json.
#include <gslam/core/trajectory_file.h>
#include <gslam/evaluation.h>
#include <gslam/svar/json.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "test_data.h"

namespace {

using gslam::Svar;

std::string folder() {
  return test_data::folder() + "trajectories/evo/";
}

const gslam::Trajectory& trajectoryOf(const std::string& name) {
  static std::map<std::string, gslam::Trajectory> read;
  const auto known = read.find(name);
  if (known != read.end()) return known->second;
  gslam::TrajectoryFileOptions options;
  options.duplicates = gslam::DuplicateStamps::keep_first;
  return read[name] = gslam::readTrajectory(folder() + name, options);
}

gslam::PoseErrorStatistics figuresOf(const Svar& one) {
  const std::string reference = one["ref"].as<std::string>();
  const std::string estimate = one["est"].as<std::string>();
  gslam::EvaluationOptions options;
  options.association.method = gslam::AssociationMethod::evo;
  options.alignment = gslam::parseAlignment(one["align"].as<std::string>());
  if (one["ref_format"].as<std::string>() == "kitti") {
    options.association.is_numbered = true;
    options.reference_matrices = gslam::readKittiMatrices(folder() + reference);
    options.estimate_matrices = gslam::readKittiMatrices(folder() + estimate);
  }
  const bool is_relative = one["metric"].as<std::string>() == "rpe";
  if (is_relative) {
    gslam::RpeOptions rpe;
    rpe.delta = one["delta"].as<double>();
    rpe.all_pairs = one.contains("all_pairs") && one["all_pairs"].as<bool>();
    options.rpe = {rpe};
  }
  const gslam::Evaluation result =
      gslam::evaluate(trajectoryOf(reference), trajectoryOf(estimate), options);
  EXPECT_TRUE(result.alignment.is_valid) << result.alignment.reason;
  return is_relative ? result.rpe.at(0).statistics : result.ape;
}

TEST(evo_reference, all_combinations_are_the_same) {
  NEEDS_TEST_DATA();
  const Svar reference = gslam::loadJson(test_data::folder() + "trajectories/evo_reference.json");
  std::size_t combinations = 0;
  for (const Svar::Member& member : reference.members()) {
    SCOPED_TRACE(member.first);
    const Svar one = member.second["case"], evo = member.second["evo"];
    const gslam::PoseErrorStatistics all = figuresOf(one);
    const bool is_rotation = one["relation"].as<std::string>() == "rotation_deg";
    const gslam::Statistics& ours = is_rotation ? all.rotation_deg : all.translation;
    ASSERT_EQ(ours.count, evo["count"].as<std::size_t>());
    const std::pair<const char*, double> figures[] = {
        {"rmse", ours.rmse}, {"mean", ours.mean}, {"median", ours.median}, {"std", ours.std},
        {"min", ours.min},   {"max", ours.max},   {"sse", ours.sse}};
    for (const auto& figure : figures) {
      // What is zero but for rounding (the first pose, aligned by origin) has no digits in common.
      const double expected = evo[figure.first].as<double>();
      EXPECT_NEAR(figure.second, expected, 1e-6 * expected + 1e-12) << figure.first;
    }
    ++combinations;
  }
  EXPECT_EQ(combinations, 60U);
}

}  // namespace
