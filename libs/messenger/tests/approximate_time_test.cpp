// Sets of messages that are close in time: cases. What is right follows from ApproximateTime.
#include <gmock/gmock.h>
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

#include "synchronizer_rig.h"

namespace {

using gslam::approximateTime;
using testing::ElementsAre;
using namespace synchronizer_rig;

TEST(ApproximateTime, CameraGetsTheNearestImuSample) {
  const std::int64_t ms = 1000000;
  std::mt19937 random(1);
  std::vector<Arrival> arrivals;
  for (std::int64_t i = 0; i < 30; ++i) {
    arrivals.push_back({0, i * 33 * ms + draw(random, 0, 2000000)});
  }
  for (std::int64_t i = 0; i < 220; ++i) {
    arrivals.push_back({1, i * 5 * ms + draw(random, 0, 1000000)});
  }
  std::sort(arrivals.begin(), arrivals.end(),
            [](const Arrival& a, const Arrival& b) { return a.stamp < b.stamp; });
  Two rig(approximateTime(), 10);
  for (const Arrival& one : arrivals) rig.publish(one);
  ASSERT_EQ(rig.set_stamps.size(), 30u);
  for (const std::vector<std::int64_t>& set : rig.set_stamps) {
    for (std::int64_t other : rig.stamps[1]) {
      EXPECT_LE(std::abs(set[0] - set[1]), std::abs(set[0] - other));
    }
  }
  EXPECT_EQ(rig.synchronizer().dropped(0), 0u);
}

TEST(ApproximateTime, MissingMessagesCostTheirSetOnly) {
  Two rig(approximateTime(10));
  for (std::int64_t i = 0; i < 20; ++i) {
    if (i % 5 != 3) rig.publish({0, 100 * i});
    if (i % 7 != 5) rig.publish({1, 100 * i + 4});
  }
  int expected = 0;
  for (int i = 0; i < 20; ++i) expected += i % 5 != 3 && i % 7 != 5 ? 1 : 0;
  for (const std::vector<std::int64_t>& set : rig.set_stamps) EXPECT_EQ(set[1] - set[0], 4);
  EXPECT_GE(static_cast<int>(rig.sets.size()) + 1, expected);  // the last may still wait
  rig.expectBalance();
}

TEST(ApproximateTime, MessagesOutOfOrderAreDroppedUntilReset) {
  Two rig(approximateTime());
  for (std::int64_t stamp : {10, 20, 15, 20}) rig.publish({0, stamp});
  EXPECT_EQ(rig.synchronizer().dropped(0), 1u);
  EXPECT_EQ(rig.synchronizer().waiting(0), 3u);
  for (std::int64_t stamp : {10, 20}) rig.publish({1, stamp});
  EXPECT_THAT(rig.set_stamps, ElementsAre(ElementsAre(10, 10), ElementsAre(20, 20)));
  rig.synchronizer().reset();
  EXPECT_EQ(rig.synchronizer().dropped(0), 2u);
  for (std::size_t topic : {0u, 1u}) rig.publish({topic, 5});
  EXPECT_THAT(rig.set_stamps.back(), ElementsAre(5, 5));
  rig.expectBalance();
}

TEST(ApproximateTime, QueuesAreBounded) {
  Two rig(approximateTime(), 3);
  for (int i = 0; i < 100; ++i) {
    rig.publish({0, i});
    EXPECT_LE(rig.synchronizer().waiting(0), 3u);
  }
  EXPECT_EQ(rig.synchronizer().dropped(0), 97u);
  rig.publish({1, 98});
  EXPECT_THAT(rig.set_stamps, ElementsAre(ElementsAre(98, 98)));
  rig.expectBalance();
}

TEST(ApproximateTime, PenaltyAndDistanceBringSetsEarlier) {
  Two plain(approximateTime());
  Two promised(approximateTime().atLeastApart(0, 100));
  for (Two* rig : {&plain, &promised}) {
    rig->publish({0, 90});
    rig->publish({1, 100});
  }
  EXPECT_TRUE(plain.sets.empty());  // 95 might come
  EXPECT_EQ(promised.sets.size(), 1u);

  Two patient(approximateTime());
  Two hasty(approximateTime().agePenalty(1));
  for (Two* rig : {&patient, &hasty}) {
    for (std::int64_t stamp : {90, 106}) rig->publish({0, stamp});
    rig->publish({1, 100});
  }
  EXPECT_THAT(patient.set_stamps, ElementsAre(ElementsAre(106, 100)));
  EXPECT_THAT(hasty.set_stamps, ElementsAre(ElementsAre(90, 100)));
}

TEST(ApproximateTime, AnyStampWillDo) {
  const std::int64_t low = std::numeric_limits<std::int64_t>::min();
  const std::int64_t high = std::numeric_limits<std::int64_t>::max();
  for (double penalty : {0.0, 1.0, std::numeric_limits<double>::infinity()}) {
    Two rig(approximateTime().agePenalty(penalty).atLeastApart(0, high));
    for (std::int64_t stamp : {low, low, high, high}) rig.publish({0, stamp});
    for (std::int64_t stamp : {low, high}) rig.publish({1, stamp});
    EXPECT_THAT(rig.set_stamps, ElementsAre(ElementsAre(low, low), ElementsAre(high, high)));
    rig.expectBalance();
  }
  Two narrow(approximateTime(high));
  for (std::int64_t stamp : {low, high}) narrow.publish({0, stamp});
  narrow.publish({1, high});
  EXPECT_THAT(narrow.set_stamps, ElementsAre(ElementsAre(high, high)));
}

TEST(ApproximateTime, RefusesWhatCannotBe) {
  EXPECT_THROW(approximateTime(-1), gslam::ArgumentError);
  EXPECT_THROW(approximateTime().agePenalty(-0.5), gslam::ArgumentError);
  EXPECT_THROW(approximateTime().agePenalty(std::nan("")), gslam::ArgumentError);
  EXPECT_THROW(approximateTime().atLeastApart(4, 1), gslam::ArgumentError);
  EXPECT_THROW(approximateTime().atLeastApart(0, -1), gslam::ArgumentError);
}

}  // namespace
