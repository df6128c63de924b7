// Absolute and relative errors.
#include <gslam/base/error.h>
#include <gslam/evaluation/align.h>
#include <gslam/evaluation/ape.h>
#include <gslam/evaluation/rpe.h>
#include <gslam/geometry/mat.h>
#include <gtest/gtest.h>

#include <cmath>

#include "made_trajectory.h"

namespace {

using gslam::absoluteErrors;
using gslam::PairRange;
using gslam::parseRpe;
using gslam::PoseErrors;
using gslam::PosePairs;
using gslam::rangesOf;
using gslam::relativeErrors;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::Trajectory;
using made::kSecond;

PosePairs somePairs(std::size_t count = 200) {
  const Trajectory reference = made::trajectory(count);
  return made::pairs(reference, made::noisy(reference, 0.1, 0.03));
}

void expectSame(const PoseErrors& a, const PoseErrors& b, double tolerance) {
  ASSERT_EQ(a.translation.size(), b.translation.size());
  for (std::size_t i = 0; i < a.translation.size(); ++i) {
    ASSERT_NEAR(a.translation[i], b.translation[i], tolerance);
    ASSERT_NEAR(a.rotation[i], b.rotation[i], tolerance);
    ASSERT_NEAR(a.full[i], b.full[i], tolerance);
  }
}

PosePairs leftMoved(const PosePairs& pairs, const SE3d& reference, const SE3d& estimate) {
  PosePairs result = pairs;
  for (SE3d& pose : result.reference) pose = reference * pose;
  for (SE3d& pose : result.estimate) pose = estimate * pose;
  return result;
}

TEST(ape, is_that_of_the_matrices) {
  const PosePairs pairs = somePairs();
  const PoseErrors errors = absoluteErrors(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const gslam::Mat4d e = pairs.reference[i].inverse().matrix() * pairs.estimate[i].matrix();
    const double t = std::hypot(e(0, 3), e(1, 3), e(2, 3));
    double full = 0;
    for (std::size_t k = 0; k < 16; ++k) {
      const double rest = e.values[k] - (k % 5 == 0 ? 1 : 0);
      full += rest * rest;
    }
    ASSERT_NEAR(errors.translation[i], t, 1e-12);
    ASSERT_NEAR(errors.rotation[i], std::acos(0.5 * (e(0, 0) + e(1, 1) + e(2, 2) - 1)), 1e-7);
    ASSERT_NEAR(errors.full[i], std::sqrt(full), 1e-12);
  }
}

TEST(ape, a_known_shift_is_the_error) {
  const Trajectory reference = made::trajectory(50);
  const Trajectory estimate = made::changed(reference, [](const SE3d& pose) {
    return SE3d(pose.rotation() * SO3d::exp({{0, 0, 0.01}}),
                pose.translation() + gslam::Vec3d{{3, 4, 0}});
  });
  const gslam::PoseErrorStatistics s =
      statisticsOf(absoluteErrors(made::pairs(reference, estimate)));
  EXPECT_NEAR(s.translation.rmse, 5, 1e-12);
  EXPECT_NEAR(s.translation.std, 0, 1e-9);
  EXPECT_NEAR(s.rotation_deg.mean, 0.01 * 180 / 3.14159265358979, 1e-9);
}

TEST(ape, does_not_change_when_both_worlds_move) {
  const PosePairs pairs = somePairs();
  const SE3d moved = made::someMotion();
  expectSame(absoluteErrors(leftMoved(pairs, moved, moved)), absoluteErrors(pairs), 1e-12);
}

TEST(ape, after_alignment_does_not_depend_on_the_map) {
  const PosePairs pairs = somePairs();
  const PosePairs moved = leftMoved(pairs, SE3d(), made::someMotion());
  const SIM3d a = align(pairs).S_world_map, b = align(moved).S_world_map;
  expectSame(absoluteErrors(moved, b), absoluteErrors(pairs, a), 1e-9);
}

TEST(rpe, does_not_change_when_either_world_moves) {
  const PosePairs pairs = somePairs();
  const PosePairs moved = leftMoved(pairs, made::someMotion(), made::someMotion().inverse());
  for (const char* const text : {"1f", "7f:all", "2m", "2m:all", "1s:all", "20deg", "20deg:all"}) {
    const std::vector<PairRange> ranges = rangesOf(pairs, parseRpe(text));
    ASSERT_GT(ranges.size(), 3U) << text;
    expectSame(relativeErrors(moved, ranges), relativeErrors(pairs, ranges), 1e-11);
  }
}

TEST(rpe, of_a_perfect_estimate_is_zero_and_a_scale_shows) {
  const Trajectory reference = made::trajectory(100);
  const PosePairs perfect = made::pairs(reference, reference);
  const std::vector<PairRange> ranges = rangesOf(perfect, parseRpe("5f:all"));
  EXPECT_LT(statisticsOf(relativeErrors(perfect, ranges)).translation.max, 1e-12);
  const PosePairs doubled = made::pairs(reference, made::changed(reference, [](const SE3d& pose) {
                                          return SE3d(pose.rotation(), 2 * pose.translation());
                                        }));
  EXPECT_LT(statisticsOf(relativeErrors(doubled, ranges, 0.5)).translation.max, 1e-12);
  const PoseErrors wrong = relativeErrors(doubled, ranges);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double way = (perfect.reference[ranges[i].last].translation() -
                        perfect.reference[ranges[i].first].translation())
                           .norm();
    ASSERT_NEAR(wrong.translation[i], way, 1e-12);
  }
}

TEST(rpe, of_constant_drift_is_the_drift) {
  const SE3d drift = SE3d::exp({{0.01, 0, 0, 0, 0, 0.002}});
  const Trajectory reference = made::trajectory(100);
  Trajectory estimate;
  SE3d pose;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (i > 0) pose = pose * (reference[i - 1].pose.inverse() * reference[i].pose) * drift;
    estimate.add(reference[i].stamp, pose);
  }
  const PosePairs pairs = made::pairs(reference, estimate);
  const gslam::PoseErrorStatistics s =
      statisticsOf(relativeErrors(pairs, rangesOf(pairs, parseRpe("1f"))));
  EXPECT_EQ(s.translation.count, 99U);
  EXPECT_NEAR(s.translation.min, drift.translation().norm(), 1e-12);
  EXPECT_NEAR(s.translation.max, drift.translation().norm(), 1e-12);
  EXPECT_NEAR(s.rotation_deg.mean, 0.002 * 180 / 3.14159265358979, 1e-9);
}

// All pairs by trying all, from the definition.
std::vector<PairRange> byTrying(const std::vector<double>& marks, double delta, double slack) {
  std::vector<PairRange> ranges;
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    std::size_t nearest = i + 1;
    for (std::size_t j = i + 1; j < marks.size(); ++j) {
      if (std::fabs(marks[j] - marks[i] - delta) < std::fabs(marks[nearest] - marks[i] - delta)) {
        nearest = j;
      }
    }
    if (std::fabs(marks[nearest] - marks[i] - delta) <= slack) ranges.push_back({i, nearest});
  }
  return ranges;
}

TEST(rpe, all_pairs_are_those_that_trying_finds) {
  const PosePairs pairs = somePairs(300);
  std::vector<double> metres = {0}, degrees = {0}, seconds = {0};
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const SE3d step = pairs.reference[i - 1].inverse() * pairs.reference[i];
    metres.push_back(metres.back() + step.translation().norm());
    degrees.push_back(degrees.back() + step.rotation().angle() * 180 / 3.14159265358979323846);
    seconds.push_back(1e-9 * double(pairs.stamps[i] - pairs.stamps[0]));
  }
  const auto expect = [&](const std::string& text, const std::vector<double>& marks) {
    const gslam::RpeOptions options = parseRpe(text);
    const auto expected = byTrying(marks, options.delta, 0.1 * options.delta);
    const auto found = rangesOf(pairs, options);
    ASSERT_EQ(found.size(), expected.size()) << text;
    ASSERT_GT(found.size(), 0U) << text;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].first, expected[i].first) << text;
      // Where two are as near, sums of steps decide by their last bits.
      ASSERT_NEAR(std::fabs(marks[found[i].last] - marks[found[i].first] - options.delta),
                  std::fabs(marks[expected[i].last] - marks[expected[i].first] - options.delta),
                  1e-9)
          << text;
    }
  };
  for (const char* const text : {"0.5m:all", "3m:all", "20m:all"}) expect(text, metres);
  for (const char* const text : {"5deg:all", "90deg:all"}) expect(text, degrees);
  for (const char* const text : {"0.2s:all", "3.01s:all"}) expect(text, seconds);
}

TEST(rpe, consecutive_ways_join) {
  const PosePairs pairs = somePairs(300);
  for (const char* const text : {"3f", "2m", "1s", "15deg"}) {
    const std::vector<PairRange> ranges = rangesOf(pairs, parseRpe(text));
    ASSERT_GT(ranges.size(), 5U) << text;
    ASSERT_EQ(ranges[0].first, 0U);
    for (std::size_t i = 1; i < ranges.size(); ++i) ASSERT_EQ(ranges[i].first, ranges[i - 1].last);
  }
  EXPECT_EQ(rangesOf(pairs, parseRpe("1s")).size(), 14U);  // 300 poses at 20 Hz last 14.95 s
  EXPECT_EQ(rangesOf(pairs, parseRpe("1s"))[0].last, 20U);
  // Ten tenths are less than one, as double.
  const Trajectory tenths = made::trajectory(50, kSecond / 10);
  EXPECT_EQ(rangesOf(made::pairs(tenths, tenths), parseRpe("1s"))[0].last, 10U);
}

TEST(rpe, survives_the_ends_of_time) {
  Trajectory far;
  for (const std::int64_t stamp : {INT64_MIN, std::int64_t(0), INT64_MAX}) far.add(stamp, SE3d());
  EXPECT_EQ(rangesOf(made::pairs(far, far), parseRpe("1s")).size(), 2U);
}

TEST(rpe, ways_that_are_too_long_are_none) {
  const PosePairs pairs = somePairs(20);
  for (const char* const text : {"20f", "20f:all", "1000m", "1000m:all", "99s", "9999deg:all"}) {
    EXPECT_TRUE(rangesOf(pairs, parseRpe(text)).empty()) << text;
  }
  EXPECT_EQ(rangesOf(pairs, parseRpe("19f")).size(), 1U);
  EXPECT_TRUE(rangesOf(somePairs(1), parseRpe("1f")).empty());
}

TEST(rpe, a_standing_reference_has_ways_of_no_length) {
  Trajectory still;
  for (std::int64_t i = 0; i < 20; ++i) still.add(i, SE3d());
  const PosePairs pairs = made::pairs(still, still);
  EXPECT_TRUE(rangesOf(pairs, parseRpe("1m:all")).empty());
  EXPECT_TRUE(rangesOf(pairs, parseRpe("1deg")).empty());
  EXPECT_EQ(gslam::driftOf(pairs).length, 0);
  EXPECT_EQ(gslam::driftOf(pairs).translation_percent, 0);
}

TEST(rpe, texts) {
  for (const char* const text : {"1f", "10f:all", "5m", "0.25m:all", "2s", "10deg", "10deg:all"}) {
    EXPECT_EQ(gslam::rpeText(parseRpe(text)), text);
  }
  for (const char* const text : {"", "f", "1", "1x", "-1f", "0f", "1.5f", "1f:", "1f:some", "1 f",
                                 "1..2m", "infm", "1e3m", "1fall", ":all"}) {
    EXPECT_THROW(parseRpe(text), gslam::ArgumentError) << text;
  }
}

TEST(rpe, refuses_wrong_arguments) {
  PosePairs pairs = somePairs(10);
  gslam::RpeOptions options;
  options.delta = std::nan("");
  EXPECT_THROW(rangesOf(pairs, options), gslam::ArgumentError);
  options = parseRpe("1s");
  pairs.is_numbered = true;
  EXPECT_THROW(rangesOf(pairs, options), gslam::ArgumentError);
  options = parseRpe("1m");
  options.tolerance = -1;
  EXPECT_THROW(rangesOf(pairs, options), gslam::ArgumentError);
  const std::vector<PairRange> outside = {{3, 10}};
  EXPECT_THROW(relativeErrors(pairs, outside), gslam::ArgumentError);
}

TEST(drift, is_what_the_end_is_off_by) {
  Trajectory reference, estimate;
  for (std::int64_t i = 0; i <= 100; ++i) {
    reference.add(i * kSecond, SE3d({}, {{double(i), 0, 0}}));
    estimate.add(i * kSecond,
                 SE3d(SO3d::exp({{0, 0, 0.001 * double(i)}}), {{double(i), 0.02 * double(i), 0}}));
  }
  const gslam::Drift drift = driftOf(made::pairs(reference, estimate));
  EXPECT_NEAR(drift.length, 100, 1e-9);
  EXPECT_NEAR(drift.translation_percent, 2, 1e-9);
  EXPECT_NEAR(drift.rotation_deg_per_m, 0.001 * 180 / 3.14159265358979, 1e-9);
  EXPECT_THROW(gslam::driftOf(PosePairs()), gslam::ArgumentError);
}

}  // namespace
