#include <gslam/base/error.h>
#include <gslam/evaluation/statistics.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace {

using gslam::percentile;
using gslam::statisticsOf;

TEST(statistics, of_numbers_worked_out_by_hand) {
  const gslam::Statistics s = statisticsOf({4, 1, 3, 2});
  EXPECT_EQ(s.count, 4U);
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(30.0 / 4));
  EXPECT_DOUBLE_EQ(s.sse, 30);
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(1.25));
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.max, 4);
  EXPECT_NEAR(s.p90, 3.7, 1e-14);
  EXPECT_NEAR(s.p95, 3.85, 1e-14);
  EXPECT_NEAR(s.p99, 3.97, 1e-14);
}

TEST(statistics, percentiles_are_those_of_the_sorted_list) {
  std::mt19937 random(3);
  for (std::size_t count = 1; count < 60; ++count) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(double(random() % 20));
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const auto expected = [&](double part) {
      const double place = part * double(count - 1);
      const auto below = std::size_t(std::floor(place));
      const std::size_t above = std::min(below + 1, count - 1);
      return sorted[below] + (place - double(below)) * (sorted[above] - sorted[below]);
    };
    for (const double part : {0.0, 0.1, 0.25, 0.5, 0.77, 0.9, 1.0}) {
      ASSERT_NEAR(percentile(values, part), expected(part), 1e-12) << count << " " << part;
    }
    const gslam::Statistics s = statisticsOf(values);
    ASSERT_NEAR(s.median, expected(0.5), 1e-12);
    ASSERT_NEAR(s.p90, expected(0.9), 1e-12);
    ASSERT_NEAR(s.p95, expected(0.95), 1e-12);
    ASSERT_NEAR(s.p99, expected(0.99), 1e-12);
  }
}

TEST(statistics, rmse_has_mean_and_std_as_its_sides) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(3, 0.5);
  std::vector<double> values;
  for (int i = 0; i < 10000; ++i) values.push_back(normal(random));
  const gslam::Statistics s = statisticsOf(values);
  EXPECT_NEAR(s.rmse * s.rmse, s.mean * s.mean + s.std * s.std, 1e-10);
  EXPECT_NEAR(s.mean, 3, 0.03);
  EXPECT_NEAR(s.std, 0.5, 0.02);
}

TEST(statistics, of_nothing_and_of_one) {
  EXPECT_EQ(statisticsOf(std::vector<double>()).count, 0U);
  const gslam::Statistics one = statisticsOf({7});
  for (const double value : {one.rmse, one.mean, one.median, one.min, one.max, one.p90, one.p99}) {
    EXPECT_EQ(value, 7);
  }
  EXPECT_EQ(one.std, 0);
}

TEST(statistics, refuses_what_is_no_number) {
  EXPECT_THROW(statisticsOf({1, std::nan("")}), gslam::ArgumentError);
  EXPECT_THROW(statisticsOf({std::numeric_limits<double>::infinity()}), gslam::ArgumentError);
  EXPECT_THROW(percentile({}, 0.5), gslam::ArgumentError);
  EXPECT_THROW(percentile({1}, 1.5), gslam::ArgumentError);
  EXPECT_THROW(percentile({1}, std::nan("")), gslam::ArgumentError);
}

}  // namespace
