// All figures together, and what is printed of them.
#include <gmock/gmock.h>
#include <gslam/base/error.h>
#include <gslam/core/trajectory_file.h>
#include <gslam/evaluation.h>
#include <gslam/svar/json.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <sstream>

#include "made_trajectory.h"

namespace {

using gslam::Evaluation;
using gslam::EvaluationOptions;
using gslam::SE3d;
using gslam::Svar;
using gslam::Trajectory;
using testing::HasSubstr;
using testing::Not;

EvaluationOptions all() {
  EvaluationOptions options;
  for (const char* const text : {"1f", "10f:all", "5m", "2s", "10deg"}) {
    options.rpe.push_back(gslam::parseRpe(text));
  }
  options.has_kitti = true;
  options.segments = {10, 20};
  return options;
}

Svar jsonOf(const Evaluation& evaluation) {
  return gslam::parseJson(gslam::printJson(evaluationToSvar(evaluation)));
}

void expectMembers(const Svar& object, const std::vector<std::string>& names) {
  for (const std::string& name : names) EXPECT_TRUE(object.contains(name)) << name;
}

TEST(evaluate, json_has_what_the_contract_says) {
  const Trajectory reference = made::trajectory(3000);
  const Svar json = jsonOf(evaluate(reference, made::noisy(reference, 0.1, 0.01), all()));
  expectMembers(json, {"protocol", "association", "coverage", "alignment", "ape", "rpe", "kitti",
                       "segments", "drift", "score"});
  expectMembers(json["association"], {"pairs", "dropped_ref", "dropped_est", "max_gap_s"});
  expectMembers(json["coverage"], {"time", "frames", "losses", "time_to_initialise_s"});
  expectMembers(json["alignment"], {"scale", "rotation", "translation"});
  const std::vector<std::string> figures = {"rmse", "mean",  "median", "std", "min", "max",
                                            "sse",  "count", "p90",    "p95", "p99"};
  for (const char* const kind : {"translation", "rotation_deg", "full"}) {
    expectMembers(json["ape"][kind], figures);
    EXPECT_EQ(json["ape"][kind]["count"].as<int>(), 3000);
  }
  ASSERT_EQ(json["rpe"].size(), 5U);
  EXPECT_EQ(json["rpe"][1]["delta"].as<std::string>(), "10f:all");
  expectMembers(json["rpe"][1]["translation"], figures);
  expectMembers(json["rpe"][1]["rotation_deg"], figures);
  expectMembers(json["kitti"], {"t_err_percent", "r_err_deg_per_m", "segments"});
  expectMembers(json["kitti"]["segments"][0],
                {"length_m", "count", "t_err_percent", "r_err_deg_per_m"});
  EXPECT_EQ(json["segments"][1]["length_m"].as<double>(), 20);
  EXPECT_EQ(json["protocol"]["alignment"].as<std::string>(), "se3");
  EXPECT_EQ(json["protocol"]["association"]["method"].as<std::string>(), "one-to-one");
  EXPECT_EQ(json["protocol"]["versions"]["evaluation"].as<std::string>(), GSLAM_EVALUATION_VERSION);
}

TEST(evaluate, figures_are_those_of_the_parts) {
  const Trajectory reference = made::trajectory(500);
  const Trajectory estimate = made::changed(made::noisy(reference, 0.1, 0.01), [](const SE3d& t) {
    return SE3d(t.rotation(), 0.5 * t.translation());
  });
  EvaluationOptions options = all();
  options.alignment.method = gslam::AlignmentMethod::sim3;
  const Evaluation e = evaluate(reference, estimate, options);
  const gslam::PosePairs pairs = made::pairs(reference, estimate);
  const gslam::SIM3d s = align(pairs, options.alignment).S_world_map;
  EXPECT_NEAR(s.scale(), 2, 0.01);
  EXPECT_EQ(e.ape.translation.rmse, statisticsOf(absoluteErrors(pairs, s)).translation.rmse);
  for (std::size_t i = 0; i < options.rpe.size(); ++i) {
    const auto errors = relativeErrors(pairs, rangesOf(pairs, options.rpe[i]), s.scale());
    EXPECT_EQ(e.rpe[i].statistics.translation.rmse, statisticsOf(errors).translation.rmse);
  }
  EXPECT_EQ(e.kitti.t_err_percent, kittiErrors(pairs, {}, s.scale()).t_err_percent);
  EXPECT_EQ(e.drift.translation_percent, driftOf(pairs, s.scale()).translation_percent);
  EXPECT_GT(e.score.value, 0.3) << "the scale is free where the alignment has one";
}

TEST(evaluate, a_refused_alignment_leaves_what_does_not_need_it) {
  Trajectory line;
  for (std::int64_t i = 0; i < 300; ++i) {
    line.add(i * made::kSecond / 10, SE3d({}, {{double(i), 0, 0}}));
  }
  EvaluationOptions options = all();
  const Evaluation rigid = evaluate(line, line, options);
  EXPECT_FALSE(rigid.has_ape);
  EXPECT_TRUE(rigid.has_relative);
  const Svar json = jsonOf(rigid);
  EXPECT_TRUE(json["ape"].type() == gslam::SvarType::null);
  EXPECT_THAT(json["alignment"]["reason"].as<std::string>(), HasSubstr("lie on a line"));
  EXPECT_EQ(json["rpe"].size(), 5U);
  EXPECT_TRUE(json["rpe"][4]["translation"]["rmse"].type() == gslam::SvarType::null);  // no degree
  EXPECT_EQ(json["rpe"][4]["translation"]["count"].as<int>(), 0);
  options.alignment.method = gslam::AlignmentMethod::sim3;
  const Evaluation similar = evaluate(line, line, options);
  EXPECT_FALSE(similar.has_relative);
  EXPECT_EQ(jsonOf(similar)["rpe"].size(), 0U);
  EXPECT_THAT(evaluationText(similar), HasSubstr("refused"));
}

TEST(evaluate, no_error_is_printed_without_its_coverage) {
  const Trajectory reference = made::trajectory(1000);
  Trajectory estimate;
  for (std::size_t i = 200; i < 600; ++i) estimate.add(reference[i].stamp, reference[i].pose);
  EvaluationOptions options = all();
  options.alignment.method = gslam::AlignmentMethod::none;
  const std::string text = evaluationText(evaluate(reference, estimate, options));
  std::istringstream lines(text);
  std::size_t errors = 0;
  for (std::string line; std::getline(lines, line);) {
    for (const char* const name : {"APE", "RPE", "segments", "KITTI", "drift", "score"}) {
      if (line.compare(0, std::string(name).size(), name) != 0) continue;
      ++errors;
      EXPECT_TRUE(line.find("40.0 %") != std::string::npos ||
                  line.find("none") != std::string::npos)
          << line;
    }
  }
  EXPECT_GE(errors, 3U + 10U + 4U + 3U);
}

TEST(evaluate, known_frames_are_what_coverage_is_of) {
  const Trajectory reference = made::trajectory(100);
  EvaluationOptions options;
  for (std::size_t i = 0; i < 100; ++i) options.frames.push_back({reference[i].stamp, i >= 50});
  const Evaluation e = evaluate(reference, reference, options);
  EXPECT_DOUBLE_EQ(e.coverage.frames, 0.5);
  EXPECT_EQ(jsonOf(e)["protocol"]["coverage"].as<std::string>(), "frames delivered");
}

TEST(evaluate, the_callers_protocol_is_kept) {
  const Trajectory reference = made::trajectory(100);
  EvaluationOptions options;
  options.protocol = Svar::object({{"dataset", "made"}, {"seed", 7}});
  const Svar json = jsonOf(evaluate(reference, reference, options));
  EXPECT_EQ(json["protocol"]["dataset"].as<std::string>(), "made");
  EXPECT_EQ(json["protocol"]["seed"].as<int>(), 7);
  EXPECT_FALSE(options.protocol.contains("alignment")) << "the caller's object is not changed";
}

TEST(evaluate, covariances_give_a_nees) {
  const Trajectory reference = made::trajectory(100);
  EvaluationOptions options;
  gslam::PoseCovariance covariance = gslam::PoseCovariance::identity();
  covariance *= 1e-4;
  options.covariances.assign(100, covariance);
  options.alignment.method = gslam::AlignmentMethod::none;
  const Evaluation e = evaluate(reference, made::noisy(reference, 0.01, 0.01), options);
  EXPECT_NEAR(e.nees.mean, 6, 1.5);
  expectMembers(jsonOf(e)["nees"], {"mean", "freedom", "mean_95"});
  options.covariances.pop_back();
  EXPECT_THROW(evaluate(reference, reference, options), gslam::ArgumentError);
}

// Of matrices that are rotations, evo's arithmetic makes what ours makes.
TEST(evaluate, matrices_of_rotations_change_nothing) {
  const Trajectory reference = made::trajectory(300);
  const Trajectory estimate = made::noisy(reference, 0.1, 0.02);
  EvaluationOptions options;
  options.association.method = gslam::AssociationMethod::evo;
  options.rpe = {gslam::parseRpe("1f"), gslam::parseRpe("5m:all")};
  for (const char* const alignment : {"none", "origin", "se3", "sim3", "scale", "yaw"}) {
    options.alignment = gslam::parseAlignment(alignment);
    options.reference_matrices.clear();
    options.estimate_matrices.clear();
    const Evaluation ours = evaluate(reference, estimate, options);
    for (const auto& pose : reference) {
      options.reference_matrices.push_back(pose.pose.matrix3x4());
    }
    for (const auto& pose : estimate) {
      options.estimate_matrices.push_back(pose.pose.matrix3x4());
    }
    const Evaluation evo = evaluate(reference, estimate, options);
    EXPECT_NEAR(evo.ape.translation.rmse, ours.ape.translation.rmse, 1e-10) << alignment;
    EXPECT_NEAR(evo.ape.full.rmse, ours.ape.full.rmse, 1e-10) << alignment;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(evo.rpe[i].statistics.translation.rmse, ours.rpe[i].statistics.translation.rmse,
                  1e-10)
          << alignment;
    }
  }
  options.estimate_matrices.pop_back();
  EXPECT_THROW(evaluate(reference, estimate, options), gslam::ArgumentError);
}

TEST(evaluate, numbers_of_frames_are_called_frames) {
  Trajectory reference;
  for (std::int64_t i = 0; i < 100; ++i) reference.add(i, made::poseAt(0.1 * double(i)));
  EvaluationOptions options;
  options.association.is_numbered = true;
  const Evaluation e = evaluate(reference, reference, options);
  const Svar json = jsonOf(e);
  EXPECT_TRUE(json["association"]["max_gap_s"].type() == gslam::SvarType::null);
  EXPECT_EQ(json["association"]["max_gap_frames"].as<int>(), 1);
  EXPECT_TRUE(json["coverage"].contains("time_to_initialise_frames"));
  EXPECT_THAT(evaluationText(e), HasSubstr("by numbers of frames"));
}

TEST(evaluate, one_pose) {
  const Trajectory one = made::trajectory(1);
  EvaluationOptions options = all();
  options.rpe.resize(2);
  EXPECT_FALSE(evaluate(one, one, options).has_ape);
  options.alignment.method = gslam::AlignmentMethod::origin;
  const Evaluation e = evaluate(one, one, options);
  EXPECT_EQ(e.ape.translation.count, 1U);
  EXPECT_EQ(e.rpe[0].statistics.translation.count, 0U);
  EXPECT_NO_THROW(jsonOf(e));
  EXPECT_THAT(evaluationText(e), Not(HasSubstr("nan")));
}

// ---- files as they come

Trajectory readText(const std::string& text, gslam::TrajectoryFileOptions options = {}) {
  return gslam::parseTrajectory(text, "file", options);
}

TEST(evaluate, files_with_what_people_do_to_them) {
  const Trajectory truth =
      readText("0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 1 1 0 0 0 0 1\n3 1 1 1 0 0 0 1\n");
  EvaluationOptions options;
  options.alignment.method = gslam::AlignmentMethod::none;
  // Windows line ends, another order, tabs, comments, a sign, quaternions of nearly length 1.
  const Trajectory odd = readText(
      "\xef\xbb\xbf# made by hand\r\n3\t1 1\t1 0 0 0 1.001\r\n\r\n1 +1.0 0 0  0 0 0 0.999 # "
      "here\r\n"
      "0 0 0 0 0 0 0 -1\r\n2 1e0 1 0 0 0 0 1\r\n");
  const Evaluation e = evaluate(truth, odd, options);
  EXPECT_EQ(e.pairs.size(), 4U);
  EXPECT_LT(e.ape.translation.max, 1e-12);
  EXPECT_LT(e.ape.rotation_deg.max, 1e-9);
}

TEST(evaluate, files_that_are_wrong_are_refused_by_name) {
  for (const char* const text :
       {"", "# nothing\n", "0 0 0 nan 0 0 0 1\n", "0 0 0 inf 0 0 0 1\n", "0 0 0 0 0 0 0 0\n",
        "0 0 0 0 0 0 0 2\n", "0 0 0 0 0 0 0\n", "0 0 0 0 0 0 0 1\n0 1 0 0 0 0 0 1\n"}) {
    EXPECT_THROW(readText(text), gslam::ParseError) << text;
  }
  gslam::TrajectoryFileOptions first;
  first.duplicates = gslam::DuplicateStamps::keep_first;
  EXPECT_EQ(readText("0 0 0 0 0 0 0 1\n0 1 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n", first).size(), 2U);
}

TEST(evaluate, a_million_poses) {
  const std::size_t count = 1000000;
  const Trajectory reference = made::trajectory(count, made::kSecond / 200);
  const Trajectory estimate = made::noisy(reference, 0.05, 0.01);
  EvaluationOptions options;
  options.rpe = {gslam::parseRpe("1f"), gslam::parseRpe("10f:all"), gslam::parseRpe("5m:all")};
  const Evaluation e = evaluate(reference, estimate, options);
  EXPECT_EQ(e.ape.translation.count, count);
  EXPECT_EQ(e.rpe[1].statistics.translation.count, count - 10);
  // Lengths of normal vectors in space: rmse sigma * sqrt(3).
  EXPECT_NEAR(e.ape.translation.rmse, 0.05 * std::sqrt(3.0), 1e-3);
  EXPECT_EQ(e.coverage.time, 1);
}

}  // namespace
