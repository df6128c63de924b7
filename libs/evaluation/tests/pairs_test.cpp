#include <gslam/base/error.h>
#include <gslam/evaluation/pairs.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "made_trajectory.h"

namespace {

using gslam::AssociationMethod;
using gslam::AssociationOptions;
using gslam::pairPoses;
using gslam::PosePairs;
using gslam::SE3d;
using gslam::Trajectory;
using made::kSecond;

constexpr std::int64_t kMilli = 1000000;

AssociationOptions by(AssociationMethod method, std::int64_t max_dt = 10 * kMilli) {
  AssociationOptions options;
  options.method = method;
  options.max_dt = max_dt;
  return options;
}

Trajectory posesAt(const std::vector<std::int64_t>& stamps) {
  std::vector<gslam::StampedPose> poses;
  for (const std::int64_t stamp : stamps)
    poses.push_back({stamp, made::poseAt(1e-9 * double(stamp))});
  return Trajectory(std::move(poses));
}

std::string messageOf(const Trajectory& reference, const Trajectory& estimate,
                      const AssociationOptions& options = {}) {
  try {
    pairPoses(reference, estimate, options);
  } catch (const gslam::ArgumentError& error) {
    return error.what();
  }
  return "no error";
}

TEST(pairs, one_to_one_and_evo_differ_as_they_say) {
  // Both of the estimate's first two are nearest to the reference's first.
  const Trajectory reference = posesAt({0, 100 * kMilli, 200 * kMilli});
  const Trajectory estimate = posesAt({1 * kMilli, 3 * kMilli, 203 * kMilli});
  const PosePairs ours = pairPoses(reference, estimate);
  ASSERT_EQ(ours.size(), 2U);
  EXPECT_EQ(ours.estimate_places, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(ours.reference_places, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(ours.dropped_reference, 1U);
  EXPECT_EQ(ours.dropped_estimate, 1U);
  EXPECT_EQ(ours.max_gap, 200 * kMilli);
  EXPECT_EQ(ours.max_apart, 3 * kMilli);
  const PosePairs evo = pairPoses(reference, estimate, by(AssociationMethod::evo));
  EXPECT_EQ(evo.estimate_places, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(evo.reference_places, (std::vector<std::size_t>{0, 0, 2}));
  EXPECT_EQ(evo.dropped_estimate, 0U);
}

TEST(pairs, evo_lets_the_shorter_one_drive) {
  const Trajectory few = posesAt({0, 100 * kMilli}),
                   many = posesAt({1 * kMilli, 3 * kMilli, 99 * kMilli});
  EXPECT_EQ(pairPoses(few, many, by(AssociationMethod::evo)).estimate_places,
            (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(pairPoses(many, few, by(AssociationMethod::evo)).reference_places,
            (std::vector<std::size_t>{0, 2}));
}

TEST(pairs, poses_are_those_of_their_places) {
  const Trajectory reference = made::trajectory(200, kSecond / 100);
  const Trajectory estimate = made::trajectory(60, kSecond / 30, 1000 * kSecond + 2 * kMilli);
  for (const AssociationMethod method : {AssociationMethod::one_to_one, AssociationMethod::evo}) {
    const PosePairs pairs = pairPoses(reference, estimate, by(method));
    ASSERT_GT(pairs.size(), 50U);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto& ours = reference[pairs.reference_places[i]];
      ASSERT_TRUE(pairs.reference[i].isApprox(ours.pose, 0));
      ASSERT_TRUE(pairs.estimate[i].isApprox(estimate[pairs.estimate_places[i]].pose, 0));
      ASSERT_EQ(pairs.stamps[i], ours.stamp);
      ASSERT_LE(std::abs(ours.stamp - estimate[pairs.estimate_places[i]].stamp), 10 * kMilli);
    }
    ASSERT_EQ(pairs.dropped_estimate, estimate.size() - pairs.size());
  }
}

// Along a screw with constant velocity, interpolation is exact.
TEST(pairs, interpolates_on_se3) {
  const SE3d::Tangent speed = {{1, 0.5, -0.2, 0.3, -0.4, 0.8}};
  const auto screw = [&](std::int64_t first, std::int64_t step, std::size_t count) {
    Trajectory result;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t stamp = first + step * std::int64_t(i);
      result.add(stamp, made::someMotion() * SE3d::exp(speed * (1e-9 * double(stamp))));
    }
    return result;
  };
  const Trajectory dense = screw(0, 10 * kMilli, 300), sparse = screw(3 * kMilli, 33 * kMilli, 80);
  for (const bool estimate_is_dense : {false, true}) {
    const PosePairs pairs = estimate_is_dense
                                ? pairPoses(sparse, dense, by(AssociationMethod::interpolate))
                                : pairPoses(dense, sparse, by(AssociationMethod::interpolate));
    ASSERT_EQ(pairs.size(), 80U);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      ASSERT_TRUE(pairs.reference[i].isApprox(pairs.estimate[i], 1e-12)) << i;
    }
    EXPECT_LE(pairs.max_apart, 5 * kMilli);
    EXPECT_EQ(estimate_is_dense ? pairs.dropped_reference : pairs.dropped_estimate, 0U);
  }
}

TEST(pairs, interpolates_over_no_gap_and_not_beyond_the_ends) {
  const Trajectory reference = posesAt({0, 10 * kMilli, 20 * kMilli, 500 * kMilli, 510 * kMilli});
  const Trajectory estimate =
      posesAt({-5 * kMilli, 5 * kMilli, 25 * kMilli, 250 * kMilli, 505 * kMilli, 515 * kMilli});
  const PosePairs pairs = pairPoses(reference, estimate, by(AssociationMethod::interpolate));
  EXPECT_EQ(pairs.estimate_places, (std::vector<std::size_t>{1, 2, 4}));
  EXPECT_EQ(pairs.dropped_estimate, 3U);
  EXPECT_EQ(pairs.max_gap, 480 * kMilli);
}

TEST(pairs, the_ends_count_as_gaps) {
  const Trajectory reference = made::trajectory(100, kSecond / 10);
  const Trajectory estimate = made::trajectory(20, kSecond / 10, 1003 * kSecond);
  EXPECT_EQ(pairPoses(reference, estimate).max_gap, 99 * kSecond / 10 - 49 * kSecond / 10);
}

TEST(pairs, numbers_of_frames_pair_equals) {
  AssociationOptions options = by(AssociationMethod::one_to_one);
  options.is_numbered = true;
  const PosePairs pairs = pairPoses(posesAt({0, 1, 2, 3, 4}), posesAt({1, 2, 4, 7}), options);
  EXPECT_EQ(pairs.reference_places, (std::vector<std::size_t>{1, 2, 4}));
  EXPECT_EQ(pairs.dropped_estimate, 1U);
  options.method = AssociationMethod::evo;
  EXPECT_EQ(pairPoses(posesAt({0, 1, 2, 3, 4}), posesAt({1, 2, 4, 7}), options).size(), 3U);
  options.method = AssociationMethod::interpolate;
  EXPECT_THROW(pairPoses(posesAt({0, 1}), posesAt({0, 1}), options), gslam::ArgumentError);
  options = by(AssociationMethod::one_to_one);
  options.is_numbered = true;
  options.time_offset = 1;
  EXPECT_THROW(pairPoses(posesAt({0, 1}), posesAt({0, 1}), options), gslam::ArgumentError);
}

TEST(pairs, a_given_offset_is_added_to_the_estimate) {
  const Trajectory reference = made::trajectory(50);
  const Trajectory estimate = made::trajectory(50, kSecond / 20, 900 * kSecond);
  AssociationOptions options;
  options.time_offset = 100 * kSecond;
  EXPECT_EQ(pairPoses(reference, estimate, options).size(), 50U);
  options.time_offset = INT64_MAX;
  EXPECT_NE(messageOf(reference, estimate, options).find("out of the range"), std::string::npos);
}

TEST(pairs, units_are_named) {
  const Trajectory reference = made::trajectory(200);
  for (const int power : {3, 6, 9}) {
    const auto factor = std::int64_t(std::llround(std::pow(10, power)));
    std::vector<std::int64_t> few;
    for (const auto& pose : reference) few.push_back(pose.stamp / factor);
    few.erase(std::unique(few.begin(), few.end()), few.end());
    if (few.size() <
        2) {  // all in one or two nanoseconds: spread as if they were at least ascending
      few.clear();
      for (std::int64_t i = 0; i < 10; ++i) few.push_back(1000 + i);
    }
    const std::string times = "1e" + std::to_string(power) + " times ";
    const std::string smaller = messageOf(reference, posesAt(few));
    EXPECT_NE(smaller.find(times + "smaller"), std::string::npos) << smaller;
    const std::string larger = messageOf(posesAt(few), reference);
    EXPECT_NE(larger.find(times + "larger"), std::string::npos) << larger;
  }
}

TEST(pairs, a_slow_or_short_estimate_is_no_other_unit) {
  const Trajectory reference = made::trajectory(20000, kSecond / 100);
  EXPECT_EQ(pairPoses(reference, made::trajectory(8, 25 * kSecond)).size(), 8U);     // keyframes
  EXPECT_EQ(pairPoses(reference, made::trajectory(20, kSecond / 100)).size(), 20U);  // lost early
  EXPECT_EQ(pairPoses(reference, made::trajectory(1)).size(), 1U);
}

TEST(pairs, no_pair_says_what_to_do) {
  const Trajectory reference = made::trajectory(100);
  const std::string later =
      messageOf(reference, made::trajectory(100, kSecond / 20, 2000 * kSecond));
  EXPECT_NE(later.find("995.05 s later"), std::string::npos) << later;
  EXPECT_NE(later.find("--time-offset auto"), std::string::npos);
  const std::string between =
      messageOf(reference, made::trajectory(50, kSecond / 20, 1000 * kSecond + 20 * kMilli));
  EXPECT_NE(between.find("nearest two are 0.02 s apart"), std::string::npos) << between;
  EXPECT_NE(between.find("--max-dt"), std::string::npos);
}

TEST(pairs, bad_input_is_refused) {
  const Trajectory some = made::trajectory(10);
  EXPECT_NE(messageOf(Trajectory(), some).find("reference has no pose"), std::string::npos);
  EXPECT_NE(messageOf(some, Trajectory()).find("estimate has no pose"), std::string::npos);
  const Trajectory no_number = made::changed(some, [](const SE3d& pose) {
    return SE3d(pose.rotation(), {{0, std::nan(""), 0}});
  });
  EXPECT_NE(messageOf(some, no_number).find("not finite"), std::string::npos);
  EXPECT_NE(messageOf(some, some, by(AssociationMethod::one_to_one, -1)).find("max_dt"),
            std::string::npos);
  EXPECT_THROW(gslam::associationMethod("nearest"), gslam::ArgumentError);
  for (const char* const name : {"one-to-one", "interpolate", "evo"}) {
    EXPECT_STREQ(gslam::associationMethodName(gslam::associationMethod(name)), name);
  }
}

TEST(pairs, survive_the_ends_of_time) {
  const Trajectory far = posesAt({INT64_MIN, 0, INT64_MAX});
  for (const AssociationMethod method :
       {AssociationMethod::one_to_one, AssociationMethod::interpolate, AssociationMethod::evo}) {
    EXPECT_EQ(pairPoses(far, far, by(method)).size(), 3U);
  }
  EXPECT_EQ(pairPoses(far, posesAt({5})).max_gap, INT64_MAX);
}

// ---- the offset of two clocks

Trajectory shifted(const Trajectory& trajectory, std::int64_t by_ns) {
  std::vector<gslam::StampedPose> poses;
  for (const auto& pose : trajectory) poses.push_back({pose.stamp + by_ns, pose.pose});
  return Trajectory(std::move(poses));
}

TEST(time_offset, is_recovered) {
  const Trajectory reference = made::trajectory(6000, kSecond / 100);
  for (const std::int64_t offset : {0L, 7L, -123L, 2345L, -4100L}) {
    for (const double noise : {0.0, 0.005}) {
      // Another rate, another world, another scale, a part of the time.
      const Trajectory there = made::changed(
          made::noisy(made::trajectory(1200, kSecond / 30, 1005 * kSecond + 3 * kMilli), noise,
                      0.2 * noise),
          [](const SE3d& pose) {
            const SE3d turned = made::someMotion() * pose;
            return SE3d(turned.rotation(), 0.3 * turned.translation());
          });
      // made::trajectory() begins its way at its first stamp, so that here it is 5.003 s late.
      const gslam::TimeOffset found =
          gslam::estimateTimeOffset(reference, shifted(there, -offset * kMilli));
      ASSERT_TRUE(found.is_valid) << found.reason;
      EXPECT_NEAR(double(found.offset), double(offset * kMilli - 5003 * kMilli),
                  (noise > 0 ? 3.0 : 0.5) * kMilli);
      EXPECT_GT(found.correlation, noise > 0 ? 0.3 : 0.95);
    }
  }
}

TEST(time_offset, of_an_estimate_that_begins_late) {
  const Trajectory reference = made::trajectory(9000, kSecond / 50);
  std::vector<gslam::StampedPose> late;
  for (std::size_t i = 5000; i < 7000; ++i) {
    late.push_back({reference[i].stamp - 300 * kMilli, reference[i].pose});
  }
  const gslam::TimeOffset found = gslam::estimateTimeOffset(reference, Trajectory(late));
  ASSERT_TRUE(found.is_valid) << found.reason;
  EXPECT_NEAR(double(found.offset), 300e6, 1e5);
}

TEST(time_offset, of_clocks_that_share_no_time) {
  const Trajectory reference = made::trajectory(3000, kSecond / 50);
  const Trajectory estimate = made::trajectory(2000, kSecond / 50, 0);
  const gslam::TimeOffset found = gslam::estimateTimeOffset(reference, estimate);
  ASSERT_TRUE(found.is_valid) << found.reason;
  EXPECT_NEAR(double(found.offset), 1000e9, 1e6);
  AssociationOptions options;
  options.finds_offset = true;
  const PosePairs pairs = pairPoses(reference, estimate, options);
  EXPECT_EQ(pairs.size(), 2000U);
  EXPECT_EQ(pairs.time_offset, found.offset);
  EXPECT_GT(pairs.offset_correlation, 0.99);
}

TEST(time_offset, is_refused_where_there_is_none_to_find) {
  Trajectory uniform;
  for (std::int64_t i = 0; i < 300; ++i) {
    uniform.add(i * kSecond / 10, SE3d({}, {{0.1 * double(i), 0, 0}}));
  }
  const gslam::TimeOffset still = gslam::estimateTimeOffset(uniform, uniform);
  EXPECT_FALSE(still.is_valid) << still.offset;
  EXPECT_NE(still.reason.find("do not vary"), std::string::npos) << still.reason;
  EXPECT_FALSE(gslam::estimateTimeOffset(made::trajectory(5), made::trajectory(5)).is_valid);
  std::vector<std::int64_t> far = {INT64_MIN};
  for (std::int64_t i = 0; i < 50; ++i) far.push_back(i * kSecond / 20);
  for (const bool is_estimate : {false, true}) {
    const gslam::TimeOffset none =
        is_estimate ? gslam::estimateTimeOffset(made::trajectory(50), posesAt(far))
                    : gslam::estimateTimeOffset(posesAt(far), made::trajectory(50));
    EXPECT_FALSE(none.is_valid);
    EXPECT_NE(none.reason.find("centuries"), std::string::npos) << none.reason;
  }
  // Two ways that have nothing in common.
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto someWay = [&] {
    Trajectory way;
    SE3d pose;
    for (std::int64_t i = 0; i < 3000; ++i) {
      way.add(i * kSecond / 10, pose);
      pose *= SE3d::exp({{normal(random), normal(random), 0, 0, 0, normal(random)}});
    }
    return way;
  };
  const gslam::TimeOffset other = gslam::estimateTimeOffset(someWay(), someWay());
  EXPECT_FALSE(other.is_valid) << other.correlation;
  AssociationOptions options;
  options.finds_offset = true;
  EXPECT_NE(messageOf(uniform, uniform, options).find("--time-offset"), std::string::npos);
}

}  // namespace
