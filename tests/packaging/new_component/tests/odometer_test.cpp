#include <gslam/odometer.h>
#include <gtest/gtest.h>

TEST(Odometer, AddsUpSteps) {
  gslam::Odometer odometer;
  odometer.add({1, 1, 1});
  EXPECT_EQ(odometer.length(), 0.0);
  odometer.add({1, 1, 3});
  odometer.add({1, 1, 0});
  EXPECT_EQ(odometer.length(), 5.0);
}
