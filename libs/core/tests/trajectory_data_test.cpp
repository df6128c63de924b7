// Published trajectories, against what the evo package computes from the same files.
#include <gslam/core/trajectory_file.h>
#include <gslam/svar/json.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "pose_bits.h"
#include "test_data.h"

namespace {

using gslam::DuplicateStamps;
using gslam::SE3d;
using gslam::StampedPose;
using gslam::Svar;
using gslam::Trajectory;
using gslam::TrajectoryFileOptions;
using gslam::TrajectoryFormat;

std::string sequence(const std::string& path) {
  return test_data::folder() + "sequences/" + path;
}
std::string evoFile(const std::string& name) {
  return test_data::folder() + "trajectories/evo/" + name;
}

Trajectory load(const std::string& path) {
  TrajectoryFileOptions options;
  options.duplicates = DuplicateStamps::keep_first;  // fr2/desk has a stamp twice
  return gslam::readTrajectory(path, options);
}

// The lines that are no comments, split at blanks and commas, by the C++ library.
std::vector<std::vector<std::string>> words(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream fields(line);
    lines.emplace_back();
    for (std::string word; fields >> word;) lines.back().push_back(word);
  }
  return lines;
}

// Seconds, their decimals filled up to nine.
std::string filledUp(const std::string& seconds) {
  const std::size_t point = seconds.find('.');
  return seconds + std::string(10 - (seconds.size() - point), '0');
}

TEST(TrajectoryData, StampsAndPositionsOfTumFilesAreThoseOfTheText) {
  NEEDS_TEST_DATA();
  for (const std::string& path :
       {evoFile("freiburg1_xyz-groundtruth.txt"), evoFile("freiburg1_xyz-rgbdslam.txt"),
        evoFile("fr2_desk_ORB.txt"), sequence("tum_rgbd_freiburg1_rpy/groundtruth.txt"),
        sequence("euroc_V1_01_easy/groundtruth_original_ASL_as_TUM.txt")}) {
    SCOPED_TRACE(path);
    const Trajectory t = gslam::readTrajectory(path);
    const std::vector<std::vector<std::string>> lines = words(path);
    ASSERT_EQ(t.size(), lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      ASSERT_EQ(gslam::secondsText(t[i].stamp), filledUp(lines[i][0]));
      for (std::size_t j = 0; j < 3; ++j) {
        ASSERT_EQ(t[i].pose.translation()[j], std::stod(lines[i][1 + j]));
      }
      const double sign = t[i].pose.rotation().w() * std::stod(lines[i][7]) < 0 ? -1 : 1;
      for (std::size_t j = 0; j < 4; ++j) {
        ASSERT_NEAR(t[i].pose.rotation().data()[j], sign * std::stod(lines[i][4 + j]), 1e-4);
      }
    }
  }
}

TEST(TrajectoryData, EurocsGroundTruth) {
  NEEDS_TEST_DATA();
  const std::string path = sequence("euroc_V1_01_easy/mav0/state_groundtruth_estimate0/data.csv");
  const Trajectory t = gslam::readTrajectory(path);
  const std::vector<std::vector<std::string>> lines = words(path);
  ASSERT_EQ(t.size(), lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ASSERT_EQ(std::to_string(t[i].stamp), lines[i][0]);
    ASSERT_EQ(t[i].pose.translation()[1], std::stod(lines[i][2]));
    ASSERT_NEAR(std::fabs(t[i].pose.rotation().w()), std::fabs(std::stod(lines[i][4])), 1e-5);
  }
  // The same flight in TUM's order, as the motion capture saw it: the quaternions must agree.
  const Trajectory other =
      gslam::readTrajectory(sequence("euroc_V1_01_easy/groundtruth_original_ASL_as_TUM.txt"));
  int compared = 0;
  for (const StampedPose& p : t) {
    SE3d pose;
    if (!other.interpolate(p.stamp, pose, 10000000)) continue;
    ASSERT_LE((pose.translation() - p.pose.translation()).norm(), 0.2);
    ASSERT_TRUE(pose.rotation().isApprox(p.pose.rotation(), 0.2));
    ++compared;
  }
  EXPECT_GE(compared, 2000);
}

TEST(TrajectoryData, KittisPosesAndTimes) {
  NEEDS_TEST_DATA();
  const Trajectory t = gslam::readKittiTrajectory(sequence("kitti_06/full_poses_06.txt"),
                                                  sequence("kitti_06/full_times_06.txt"));
  ASSERT_EQ(t.size(), 1101U);
  EXPECT_EQ(t[0].stamp, 0);
  EXPECT_EQ(t[1].stamp, 104498900);  // 1.044989e-01
  EXPECT_EQ(t[1].pose.translation()[2], 1.198998);
  EXPECT_NEAR(t.length(), 1232.876, 0.001);  // KITTI's page says 1.2 km
  const Trajectory part = gslam::readKittiTrajectory(sequence("kitti_06/poses/06.txt"),
                                                     sequence("kitti_06/sequences/06/times.txt"));
  EXPECT_NEAR(part.length(), 59.9, 0.05);  // the README of the data
  EXPECT_THROW(gslam::readKittiTrajectory(sequence("kitti_06/poses/06.txt"),
                                          sequence("kitti_06/full_times_06.txt")),
               gslam::ParseError);
}

TEST(TrajectoryData, ComesBackToTheBit) {
  NEEDS_TEST_DATA();
  for (const std::string& path :
       {evoFile("fr2_desk_groundtruth.txt"), evoFile("freiburg1_xyz-rgbdslam_drift.txt"),
        evoFile("KITTI_00_ORB.txt"),
        sequence("euroc_V1_01_easy/mav0/state_groundtruth_estimate0/data.csv")}) {
    SCOPED_TRACE(path);
    const Trajectory t = load(path);
    TrajectoryFileOptions options;
    for (const TrajectoryFormat format : {TrajectoryFormat::tum, TrajectoryFormat::euroc}) {
      options.format = format;
      const Trajectory again =
          gslam::parseTrajectory(gslam::printTrajectory(t, format), path, options);
      ASSERT_EQ(again.size(), t.size());
      for (std::size_t i = 0; i < t.size(); ++i) {
        ASSERT_EQ(again[i].stamp, t[i].stamp);
        ASSERT_EQ(bitsOf(again[i].pose), bitsOf(t[i].pose));
      }
    }
  }
}

TEST(TrajectoryData, AStampThatIsThereTwiceIsFound) {
  NEEDS_TEST_DATA();
  try {
    (void)gslam::readTumTrajectory(evoFile("fr2_desk_groundtruth.txt"));
    FAIL();
  } catch (const gslam::ParseError& error) {
    EXPECT_EQ(error.line(), 10863U);
    EXPECT_NE(std::string(error.what()).find("as line 10862 has"), std::string::npos);
  }
}

TEST(TrajectoryData, FilesOfOtherKindsAreRefused) {
  NEEDS_TEST_DATA();
  for (const std::string& path :
       {sequence("euroc_V1_01_easy/mav0/imu0/data.csv"),
        sequence("euroc_V1_01_easy/mav0/cam0/data.csv"), sequence("kitti_06/full_times_06.txt"),
        sequence("7scenes_redkitchen/frame-000000.pose.txt"),
        sequence("7scenes_redkitchen/frame-000000.depth.png"), test_data::folder() + "README.md"}) {
    EXPECT_THROW(gslam::readTrajectory(path), gslam::ParseError) << path;
  }
}

// Pairs of poses, as evo makes them: by line, or for each of the shorter trajectory the one of the
// longer that is nearest within 10 ms.
std::vector<std::pair<SE3d, SE3d>> pairs(const Trajectory& reference, const Trajectory& estimate,
                                         bool by_line) {
  std::vector<std::pair<SE3d, SE3d>> result;
  const bool swapped = estimate.size() > reference.size();
  const Trajectory& longer = swapped ? estimate : reference;
  for (const StampedPose& p : swapped ? reference : estimate) {
    const StampedPose* const other = longer.nearest(p.stamp);
    if (!by_line && std::llabs(other->stamp - p.stamp) > 10000000) continue;
    result.emplace_back(swapped ? p.pose : other->pose, swapped ? other->pose : p.pose);
  }
  return result;
}

struct Statistics {
  double rmse = 0, mean = 0, max = 0;
  std::int64_t count = 0;
};

Statistics statisticsOf(const std::vector<double>& values) {
  Statistics s;
  for (const double v : values) {
    s.rmse += v * v;
    s.mean += v;
    s.max = std::fmax(s.max, v);
  }
  s.count = static_cast<std::int64_t>(values.size());
  s.rmse = std::sqrt(s.rmse / double(s.count));
  s.mean /= double(s.count);
  return s;
}

std::vector<double> errors(const std::vector<std::pair<SE3d, SE3d>>& of, const std::string& metric,
                           bool translation) {
  std::vector<double> values;
  for (std::size_t i = 0; i < of.size(); ++i) {
    SE3d e = of[i].first.inverse() * of[i].second;
    if (metric == "rpe") {
      if (i + 1 == of.size()) break;
      const SE3d by_reference = of[i].first.inverse() * of[i + 1].first;
      e = by_reference.inverse() * (of[i].second.inverse() * of[i + 1].second);
    }
    values.push_back(translation ? e.translation().norm()
                                 : e.rotation().angle() * 57.295779513082320877);
  }
  return values;
}

TEST(TrajectoryData, EvoComputesTheSameFromTheSameFiles) {
  NEEDS_TEST_DATA();
  const Svar all = gslam::loadJson(test_data::folder() + "trajectories/evo_reference.json");
  int compared = 0;
  for (const char* name : {"fr1_xyz_rgbdslam", "fr1_xyz_rgbdslam_drift", "fr1_xyz_orb_mono_kf",
                           "fr2_desk_orb", "kitti_00_orb"}) {
    for (const char* kind : {"ape/none/translation", "ape/none/rotation_deg", "rpe/1f/translation",
                             "rpe/1f/rotation_deg"}) {
      const Svar& one = all[std::string(name) + "/" + kind];
      SCOPED_TRACE(std::string(name) + "/" + kind);
      const Trajectory reference = load(evoFile(one["case"]["ref"].as<std::string>()));
      const Trajectory estimate = load(evoFile(one["case"]["est"].as<std::string>()));
      const bool by_line = one["case"]["ref_format"].as<std::string>() == "kitti";
      const std::string metric = one["case"]["metric"].as<std::string>();
      const bool translation = std::string(kind).find("translation") != std::string::npos;
      const Statistics ours =
          statisticsOf(errors(pairs(reference, estimate, by_line), metric, translation));
      EXPECT_EQ(ours.count, one["evo"]["count"].as<std::int64_t>());
      // Mostly 1e-14; evo takes KITTI's matrices as they are, and both poses of a stamp.
      const double tolerance = translation ? 1e-6 : 1e-5;
      EXPECT_NEAR(ours.rmse, one["evo"]["rmse"].as<double>(), tolerance);
      EXPECT_NEAR(ours.mean, one["evo"]["mean"].as<double>(), tolerance);
      EXPECT_NEAR(ours.max, one["evo"]["max"].as<double>(), 10 * tolerance);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 20);
}

}  // namespace
