// evo's own figures for its own data, in trajectories/evo_reference.json.
#include <gslam/core/trajectory_file.h>
#include <gslam/evaluation.h>
#include <gslam/svar/json.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "test_data.h"

namespace {

using gslam::Svar;

const gslam::Trajectory& trajectoryOf(const std::string& name) {
  static std::map<std::string, gslam::Trajectory> read;
  const auto known = read.find(name);
  if (known != read.end()) return known->second;
  gslam::TrajectoryFileOptions options;
  options.duplicates = gslam::DuplicateStamps::keep_first;
  const std::string path = test_data::folder() + "trajectories/evo/" + name;
  return read[name] = gslam::readTrajectory(path, options);
}

gslam::PosePairs pairsOf(const Svar& one) {
  gslam::AssociationOptions how;
  how.method = gslam::AssociationMethod::evo;
  how.is_numbered = one["ref_format"].as<std::string>() == "kitti";
  return gslam::pairPoses(trajectoryOf(one["ref"].as<std::string>()),
                          trajectoryOf(one["est"].as<std::string>()), how);
}

gslam::PoseErrors errorsOf(const Svar& one) {
  const gslam::PosePairs pairs = pairsOf(one);
  if (one["metric"].as<std::string>() == "ape") {
    const gslam::Alignment alignment =
        gslam::align(pairs, gslam::parseAlignment(one["align"].as<std::string>()));
    EXPECT_TRUE(alignment.is_valid) << alignment.reason;
    return gslam::absoluteErrors(pairs, alignment.S_world_map);
  }
  gslam::RpeOptions options;
  options.delta = one["delta"].as<double>();
  options.all_pairs = one.contains("all_pairs") && one["all_pairs"].as<bool>();
  return gslam::relativeErrors(pairs, gslam::rangesOf(pairs, options));
}

// The largest element of M^T M - I over a KITTI file: its seven digits are no rotations. evo
// calculates with them as they are (and takes the transpose for the inverse), we with the nearest
// rotations. At a lever arm of d metres the two differ by up to this times d.
double distanceFromRotations(const std::string& name) {
  std::ifstream in(test_data::folder() + "trajectories/evo/" + name);
  double worst = 0, m[12];
  while (in >> m[0]) {
    for (int i = 1; i < 12; ++i) in >> m[i];
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        const double dot = m[a] * m[b] + m[4 + a] * m[4 + b] + m[8 + a] * m[8 + b];
        worst = std::max(worst, std::fabs(dot - (a == b ? 1 : 0)));
      }
    }
  }
  return worst;
}

// What the figures may differ by for that reason; rounding alone elsewhere.
double slackOf(const Svar& one, bool is_rotation) {
  const double rounding = is_rotation ? 1e-12 : 1e-14;
  const bool turns =
      one["metric"].as<std::string>() == "rpe" || one["align"].as<std::string>() == "origin";
  if (is_rotation || !turns || one["ref_format"].as<std::string>() != "kitti") return rounding;
  const gslam::Trajectory& estimate = trajectoryOf(one["est"].as<std::string>());
  const std::size_t delta = one.contains("delta") ? one["delta"].as<std::size_t>() : 0;
  double lever = 0;
  for (std::size_t i = delta; i < estimate.size(); ++i) {
    const auto& from = estimate[delta > 0 ? i - delta : 0].pose.translation();
    lever = std::max(lever, (estimate[i].pose.translation() - from).norm());
  }
  return lever * std::max(distanceFromRotations(one["ref"].as<std::string>()),
                          distanceFromRotations(one["est"].as<std::string>()));
}

TEST(evo_reference, all_combinations_are_the_same) {
  NEEDS_TEST_DATA();
  const Svar reference = gslam::loadJson(test_data::folder() + "trajectories/evo_reference.json");
  std::size_t combinations = 0;
  std::size_t inexact = 0;
  for (const Svar::Member& member : reference.members()) {
    SCOPED_TRACE(member.first);
    const Svar one = member.second["case"], evo = member.second["evo"];
    const gslam::PoseErrorStatistics all = statisticsOf(errorsOf(one));
    const bool is_rotation = one["relation"].as<std::string>() == "rotation_deg";
    const gslam::Statistics& ours = is_rotation ? all.rotation_deg : all.translation;
    ASSERT_EQ(ours.count, evo["count"].as<std::size_t>());
    const double slack = slackOf(one, is_rotation);
    const std::pair<const char*, double> figures[] = {{"rmse", ours.rmse},     {"mean", ours.mean},
                                                      {"median", ours.median}, {"std", ours.std},
                                                      {"min", ours.min},       {"max", ours.max}};
    for (const auto& figure : figures) {
      const double expected = evo[figure.first].as<double>();
      EXPECT_NEAR(figure.second, expected, 1e-6 * expected + slack) << figure.first;
      if (std::fabs(figure.second - expected) > 1e-6 * expected + 1e-12) ++inexact;
    }
    const double sse = evo["sse"].as<double>();
    EXPECT_NEAR(ours.sse, sse, 1e-6 * sse + 2 * slack * std::sqrt(sse * double(ours.count)));
    ++combinations;
  }
  EXPECT_EQ(combinations, 60U);
  // KITTI's origin/translation (rmse, mean, std) and the minima of its two rpe/translation.
  EXPECT_LE(inexact, 5U) << "figures beyond 1e-6";
}

}  // namespace
