#include <gslam/base/error.h>
#include <gslam/evaluation/coverage.h>
#include <gslam/evaluation/score.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "made_trajectory.h"

namespace {

using gslam::Coverage;
using gslam::coverageOf;
using gslam::CoverageOptions;
using gslam::Score;
using gslam::scoreOf;
using gslam::ScoreOptions;
using gslam::SE3d;
using gslam::Trajectory;
using made::kSecond;

// Those of which a function says so.
template <class Keep>
Trajectory part(const Trajectory& trajectory, const Keep& keep) {
  std::vector<gslam::StampedPose> poses;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (keep(i)) poses.push_back(trajectory[i]);
  }
  return Trajectory(std::move(poses));
}

// ---- coverage of frames

std::vector<gslam::TrackedFrame> frames(const std::string& states) {
  std::vector<gslam::TrackedFrame> result;
  for (std::size_t i = 0; i < states.size(); ++i) {
    result.push_back({std::int64_t(i) * kSecond / 10, states[i] == 'T'});
  }
  return result;
}

TEST(coverage, of_frames_whose_state_is_known) {
  const Coverage c = coverageOf(frames("--TTTT---TT--T--TT---"));
  EXPECT_EQ(c.tracked_frames, 9U);
  EXPECT_EQ(c.total_frames, 21U);
  EXPECT_DOUBLE_EQ(c.frames, 9.0 / 21);
  EXPECT_DOUBLE_EQ(c.time, 5.0 / 20);  // steps between two tracked ones
  EXPECT_EQ(c.losses, 4U);             // that at the end, too
  EXPECT_NEAR(c.longest_loss, 0.4, 1e-12);
  EXPECT_TRUE(c.is_initialised);
  EXPECT_NEAR(c.time_to_initialise, 0.2, 1e-12);
}

TEST(coverage, of_all_and_of_nothing) {
  const Coverage all = coverageOf(frames("TTTTT"));
  EXPECT_EQ(all.time, 1);
  EXPECT_EQ(all.frames, 1);
  EXPECT_EQ(all.losses, 0U);
  EXPECT_EQ(all.longest_loss, 0);
  const Coverage none = coverageOf(frames("-----"));
  EXPECT_EQ(none.time, 0);
  EXPECT_EQ(none.frames, 0);
  EXPECT_EQ(none.losses, 0U);
  EXPECT_FALSE(none.is_initialised);
  EXPECT_EQ(coverageOf(frames("T")).time, 1);
}

TEST(coverage, refuses_wrong_frames) {
  EXPECT_THROW(coverageOf(std::vector<gslam::TrackedFrame>()), gslam::ArgumentError);
  std::vector<gslam::TrackedFrame> twice = frames("TT");
  twice[1].stamp = twice[0].stamp;
  EXPECT_THROW(coverageOf(twice), gslam::ArgumentError);
}

// ---- coverage of trajectories

TEST(coverage, of_an_estimate_that_is_lost_in_the_middle) {
  const Trajectory reference = made::trajectory(1001, kSecond / 100);  // 10 s
  const Trajectory all = made::trajectory(201, kSecond / 20);
  const Coverage whole = coverageOf(reference, all);
  EXPECT_EQ(whole.time, 1);
  EXPECT_EQ(whole.frames, 1);
  EXPECT_EQ(whole.losses, 0U);
  // Poses at 1 to 4 s and 6 to 8 s, 25 ms more on each side.
  const Coverage c = coverageOf(reference, part(all, [](std::size_t i) {
                                  return (i >= 20 && i <= 80) || (i >= 120 && i <= 160);
                                }));
  EXPECT_NEAR(c.time, 0.51, 1e-9);
  EXPECT_NEAR(c.frames, (305.0 + 205.0) / 1001, 1e-9);
  EXPECT_EQ(c.losses, 2U);
  EXPECT_NEAR(c.longest_loss, 2, 1e-9);
  EXPECT_NEAR(c.time_to_initialise, 1, 1e-9);
  EXPECT_NEAR(c.lost_after, 0.5, 1e-12);
}

TEST(coverage, keyframes_and_what_is_no_loss) {
  const Trajectory reference = made::trajectory(1001, kSecond / 100);
  const Trajectory keyframes = made::trajectory(11, kSecond);
  EXPECT_EQ(coverageOf(reference, keyframes).time, 1);
  CoverageOptions options;
  options.lost_after = kSecond / 2;
  EXPECT_EQ(coverageOf(reference, keyframes, options).losses, 10U);
  EXPECT_EQ(coverageOf(reference, Trajectory()).time, 0);
  EXPECT_FALSE(coverageOf(reference, Trajectory()).is_initialised);
}

TEST(coverage, outside_of_the_reference_nothing_counts) {
  const Trajectory reference = made::trajectory(101, kSecond / 100, 1010 * kSecond);
  const Coverage c = coverageOf(reference, made::trajectory(1000));
  EXPECT_EQ(c.time, 1);
  EXPECT_EQ(c.losses, 0U);
  EXPECT_EQ(c.time_to_initialise, 0);
  CoverageOptions options;
  options.time_offset = 100 * kSecond;
  EXPECT_EQ(coverageOf(reference, made::trajectory(1000), options).time, 0);
}

TEST(coverage, of_numbered_frames) {
  Trajectory reference, estimate;
  for (std::int64_t i = 0; i < 10; ++i) {
    reference.add(i, SE3d());
    if (i != 0 && i != 5 && i != 6) estimate.add(i, SE3d());
  }
  CoverageOptions options;
  options.is_numbered = true;
  const Coverage c = coverageOf(reference, estimate, options);
  EXPECT_DOUBLE_EQ(c.frames, 0.7);
  EXPECT_EQ(c.losses, 1U);
  EXPECT_EQ(c.longest_loss, 3);
  EXPECT_EQ(c.time_to_initialise, 1);
}

TEST(coverage, refuses_wrong_arguments) {
  EXPECT_THROW(coverageOf(Trajectory(), made::trajectory(3)), gslam::ArgumentError);
  CoverageOptions options;
  options.lost_after = -1;
  EXPECT_THROW(coverageOf(made::trajectory(3), made::trajectory(3), options), gslam::ArgumentError);
}

// ---- the score

TEST(score, is_one_for_the_truth_and_zero_for_nothing) {
  const Trajectory reference = made::trajectory(600);
  EXPECT_EQ(scoreOf(reference, reference).value, 1);
  EXPECT_EQ(scoreOf(reference, Trajectory()).value, 0);
  EXPECT_GT(scoreOf(reference, reference).parts, 200U);
  // In another world, and with poses between those of the reference.
  const Trajectory other = made::changed(made::trajectory(900, kSecond / 30), [](const SE3d& pose) {
    return made::someMotion() * pose;
  });
  EXPECT_GT(scoreOf(reference, other).value, 0.999);
}

TEST(score, a_free_scale_is_the_one_with_which_most_is_right) {
  const Trajectory reference = made::trajectory(600);
  const Trajectory small = made::changed(
      reference, [](const SE3d& pose) { return SE3d(pose.rotation(), 0.25 * pose.translation()); });
  EXPECT_EQ(scoreOf(reference, small).value, 0);
  ScoreOptions options;
  options.has_scale = true;
  const Score score = scoreOf(reference, small, options);
  EXPECT_EQ(score.value, 1);
  EXPECT_NEAR(score.levels[0].scale, 4, 0.1);
  // A third of the way has another scale: two thirds can be right, but for the parts across.
  std::size_t i = 0;
  const Trajectory two = made::changed(reference, [&](const SE3d& pose) {
    return SE3d(pose.rotation(), (i++ < 200 ? 0.5 : 0.25) * pose.translation());
  });
  const Score most = scoreOf(reference, two, options);
  EXPECT_NEAR(most.levels[0].scale, 4, 0.1);
  EXPECT_GT(most.value, 0.5);
  EXPECT_LT(most.value, 0.75);
}

// Two halves of a straight way whose scales hardly meet: 0.9 to 1.1 times each, 0.01 % in common.
TEST(score, scales_that_hardly_meet_are_found) {
  for (const double apart : {0.9999, 1.0001}) {
    const double other = 1.1 / 0.9 * apart;
    Trajectory reference, estimate;
    for (std::int64_t i = 0; i <= 400; ++i) {
      const double x = 0.05 * double(i);
      reference.add(i * kSecond / 20, SE3d({}, {{x, 0, 0}}));
      estimate.add(i * kSecond / 20, SE3d({}, {{x < 10 ? x : 10 + (x - 10) / other, 0, 0}}));
    }
    ScoreOptions options;
    options.has_scale = true;
    options.slot = kSecond / 20;
    options.thresholds = {0.1};
    const Score score = scoreOf(reference, estimate, options);
    if (apart < 1) {
      EXPECT_EQ(score.value, 1);
      EXPECT_NEAR(score.levels[0].scale, 1.1, 1e-4);
    } else {
      EXPECT_LT(score.value, 0.6);
    }
  }
}

// No scale that is tried does better than the one that is found.
TEST(score, no_other_scale_is_better) {
  const Trajectory reference = made::trajectory(400);
  std::mt19937 random(2);
  const Trajectory estimate = made::noisy(reference, 0.2, 0.03);
  ScoreOptions options;
  options.has_scale = true;
  const Score best = scoreOf(reference, estimate, options);
  EXPECT_GT(best.value, 0);
  // With the scales that it names, it is as good as it says.
  for (std::size_t k = 0; k < best.levels.size(); ++k) {
    const Score fixed =
        scoreOf(reference, made::changed(estimate, [&](const SE3d& pose) {
                  return SE3d(pose.rotation(), best.levels[k].scale * pose.translation());
                }));
    EXPECT_EQ(fixed.levels[k].fraction, best.levels[k].fraction);
  }
  std::vector<double> scales;  // coarse ones, and fine ones about 1
  for (int i = -30; i <= 30; ++i) scales.push_back(std::exp(0.02 * i));
  for (int i = -150; i <= 150; ++i) scales.push_back(std::exp(0.0002 * i));
  for (const double scale : scales) {
    const Score fixed = scoreOf(reference, made::changed(estimate, [&](const SE3d& pose) {
                                  return SE3d(pose.rotation(), scale * pose.translation());
                                }));
    for (std::size_t k = 0; k < best.levels.size(); ++k) {
      ASSERT_LE(fixed.levels[k].fraction, best.levels[k].fraction) << scale;
    }
  }
}

// The property that it was made for: whatever is left out, nothing is gained.
TEST(score, is_never_improved_by_giving_up) {
  std::mt19937 random(3);
  int smaller = 0;
  for (int round = 0; round < 300; ++round) {
    const Trajectory reference = made::trajectory(300, kSecond / 20);
    // Good at first, wrong in parts: those a tracker would like to hide.
    const unsigned bad_from = unsigned(random() % 300), bad_count = unsigned(random() % 150);
    std::size_t i = 0;
    const Trajectory noisy =
        made::noisy(made::trajectory(450, kSecond / 30), 0.03, 0.005, unsigned(round));
    const Trajectory estimate = made::changed(noisy, [&](const SE3d& pose) {
      const bool is_bad = i >= bad_from && i < bad_from + bad_count;
      ++i;
      return is_bad ? SE3d(pose.rotation(), 1.3 * pose.translation()) : pose;
    });
    ScoreOptions options;
    options.has_scale = round % 2 == 1;
    const double share = double(random() % 100) / 100;
    const int kind = int(random() % 3);
    const Trajectory rest = part(estimate, [&](std::size_t k) {
      if (kind == 0) return double(random() % 1000) / 1000 < share;     // here and there
      if (kind == 1) return k < bad_from || k >= bad_from + bad_count;  // the wrong ones
      return double(k) < share * 450;                                   // the end
    });
    const Score before = scoreOf(reference, estimate, options);
    const Score after = scoreOf(reference, rest, options);
    ASSERT_TRUE(before.is_valid);
    ASSERT_EQ(before.parts, after.parts);
    for (std::size_t k = 0; k < before.levels.size(); ++k) {
      ASSERT_LE(after.levels[k].fraction, before.levels[k].fraction) << round;
    }
    smaller += after.value < before.value ? 1 : 0;
  }
  EXPECT_GT(smaller, 150);  // leaving out what was right costs
}

// Where ground truth has a hole, nobody knows who is right.
TEST(score, reference_is_not_interpolated_over_a_hole) {
  Trajectory reference, estimate;
  for (std::int64_t i = 0; i <= 400; ++i) {
    const std::int64_t stamp = i * kSecond / 20;
    if (i > 100 && i < 300) continue;
    reference.add(stamp, made::poseAt(1e-9 * double(stamp)));
    if (i != 100) estimate.add(stamp, reference.back().pose);
  }
  const double before = scoreOf(reference, estimate).value;
  SE3d guess;
  const std::int64_t behind = 5 * kSecond + kSecond / 25;
  ASSERT_TRUE(reference.interpolate(behind, guess));
  estimate.add(behind, guess);
  EXPECT_EQ(scoreOf(reference, estimate).value, before);
  EXPECT_LT(before, 1);
}

TEST(score, of_numbered_frames) {
  Trajectory reference, estimate;
  for (std::int64_t i = 0; i < 100; ++i) {
    reference.add(i, made::poseAt(0.1 * double(i)));
    if (i < 50) estimate.add(i, reference[std::size_t(i)].pose);
  }
  ScoreOptions options;
  options.is_numbered = true;
  const Score score = scoreOf(reference, estimate, options);
  ASSERT_TRUE(score.is_valid);
  EXPECT_GT(score.value, 0.3);
  EXPECT_LT(score.value, 0.6);
  EXPECT_EQ(scoreOf(reference, reference, options).value, 1);
}

TEST(score, says_why_there_is_none) {
  Trajectory still;
  for (std::int64_t i = 0; i < 20; ++i) still.add(i * kSecond, SE3d());
  EXPECT_NE(scoreOf(still, still).reason.find("does not move"), std::string::npos);
  ScoreOptions options;
  options.length = 1e6;
  const Score score = scoreOf(made::trajectory(100), made::trajectory(100), options);
  EXPECT_FALSE(score.is_valid);
  EXPECT_NE(score.reason.find("shorter than a part"), std::string::npos);
}

TEST(score, refuses_wrong_options) {
  const Trajectory some = made::trajectory(10);
  EXPECT_THROW(scoreOf(Trajectory(), some), gslam::ArgumentError);
  ScoreOptions options;
  options.slot = 0;
  EXPECT_THROW(scoreOf(some, some, options), gslam::ArgumentError);
  options = {};
  options.thresholds = {0.1, 0};
  EXPECT_THROW(scoreOf(some, some, options), gslam::ArgumentError);
  options = {};
  options.length = std::nan("");
  EXPECT_THROW(scoreOf(some, some, options), gslam::ArgumentError);
}

}  // namespace
