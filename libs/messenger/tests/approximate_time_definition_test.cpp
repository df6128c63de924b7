// Sets of messages that are close in time, against the definition: all sets there are.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "synchronizer_rig.h"

namespace {

using gslam::approximateTime;
using gslam::ApproximateTime;
using namespace synchronizer_rig;

// --- the definition, tried on all sets there are

class Definition {
 public:
  Definition(Stamps stamps, const ApproximateTime& policy)
      : stamps_(std::move(stamps)), policy_(policy) {}

  // The best set with places of at least `from`; false where there is none.
  bool next(const Places& from, Places& best) const {
    Sets all;
    Places at(stamps_.size());
    collect(from, 0, at, all);
    if (all.empty()) return false;
    Places first = all.front();
    for (const Places& one : all) first = least(first, one);
    std::int64_t pivot = stamps_[0][first[0]];
    for (std::size_t i = 1; i < first.size(); ++i) {
      pivot = std::max(pivot, stamps_[i][first[i]]);
    }
    best.clear();
    for (const Places& one : all) {
      const bool contiguous = std::none_of(
          all.begin(), all.end(), [&](const Places& other) { return isBefore(other, one); });
      if (!contiguous) continue;
      if (best.empty() || cost(one, pivot) < cost(best, pivot)) best = one;
      if (cost(one, pivot) == cost(best, pivot)) best = least(best, one);
    }
    return true;
  }

  Sets all() const {
    Sets sets;
    Places from(stamps_.size(), 0);
    Places best;
    while (next(from, best)) {
      sets.push_back(best);
      for (std::size_t i = 0; i < from.size(); ++i) from[i] = best[i] + 1;
    }
    return sets;
  }

 private:
  void collect(const Places& from, std::size_t topic, Places& at, Sets& all) const {
    if (topic == stamps_.size()) {
      if (static_cast<std::uint64_t>(spread(at)) <= policy_.max_gap) all.push_back(at);
      return;
    }
    for (at[topic] = from[topic]; at[topic] < stamps_[topic].size(); ++at[topic]) {
      collect(from, topic + 1, at, all);
    }
  }
  static Places least(Places a, const Places& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = std::min(a[i], b[i]);
    return a;
  }
  static bool isBefore(const Places& a, const Places& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] >= b[i]) return false;
    }
    return true;
  }
  std::int64_t latest(const Places& at) const {
    std::int64_t to = stamps_[0][at[0]];
    for (std::size_t i = 1; i < at.size(); ++i) to = std::max(to, stamps_[i][at[i]]);
    return to;
  }
  std::int64_t spread(const Places& at) const {
    std::int64_t from = stamps_[0][at[0]];
    for (std::size_t i = 1; i < at.size(); ++i) from = std::min(from, stamps_[i][at[i]]);
    return latest(at) - from;
  }
  std::int64_t cost(const Places& at, std::int64_t pivot) const {
    const auto beyond = static_cast<double>(std::max<std::int64_t>(0, latest(at) - pivot));
    return spread(at) + static_cast<std::int64_t>(policy_.age_penalty * beyond);
  }

  const Stamps stamps_;
  const ApproximateTime policy_;
};

// --- one against the other

using Random = std::mt19937;

// In order on each topic, in any order across.
std::vector<Arrival> randomArrivals(Random& random, const ApproximateTime& policy,
                                    std::size_t topics, int count) {
  std::vector<Arrival> all;
  std::vector<std::int64_t> now(topics, 0);
  for (int i = 0; i < count; ++i) {
    const auto topic = static_cast<std::size_t>(draw(random, 0, static_cast<int>(topics) - 1));
    now[topic] += policy.least_distance[topic];
    now[topic] += draw(random, 0, 1 + 3 * static_cast<int>(topic));
    all.push_back({topic, now[topic]});
  }
  return all;
}

ApproximateTime randomPolicy(Random& random) {
  ApproximateTime policy =
      draw(random, 0, 1) == 0 ? approximateTime() : approximateTime(draw(random, 0, 8));
  if (draw(random, 0, 1) == 0) policy = policy.atLeastApart(0, draw(random, 1, 5));
  if (draw(random, 0, 2) == 0) policy = policy.agePenalty(0.5 * draw(random, 1, 4));
  return policy;
}

template <class TheRig>
void expectDefinition(std::size_t topics, int runs, int count) {
  Random random(20260101);
  for (int run = 0; run < runs; ++run) {
    SCOPED_TRACE(run);
    const ApproximateTime policy = randomPolicy(random);
    TheRig rig(policy);
    for (const Arrival& one : randomArrivals(random, policy, topics, count)) rig.publish(one);
    const Sets early = rig.sets;
    rig.expectBalance();
    const Sets at_end = Definition(rig.stamps, policy).all();
    ASSERT_LE(early.size(), at_end.size());
    ASSERT_TRUE(std::equal(early.begin(), early.end(), at_end.begin()));
    // what is far beyond makes all sure
    for (std::size_t i = 0; i < topics; ++i) rig.publish({i, 1000});
    const Sets all = Definition(rig.stamps, policy).all();
    ASSERT_GE(rig.sets.size() + 1, all.size());
    ASSERT_TRUE(std::equal(rig.sets.begin(), rig.sets.end(), all.begin()));
  }
}

TEST(ApproximateTime, TwoTopicsAreAsDefined) {
  expectDefinition<Two>(2, 1500, 16);
}
TEST(ApproximateTime, ThreeTopicsAreAsDefined) {
  expectDefinition<Three>(3, 400, 15);
}
TEST(ApproximateTime, FourTopicsAreAsDefined) {
  expectDefinition<Four>(4, 60, 14);
}

// Whether some message to come, at most one on each topic, makes another set the next.
bool mayChange(const Stamps& stamps, const ApproximateTime& policy, const Places& from,
               std::size_t topic, const Places& expected) {
  Places best;
  if (!Definition(stamps, policy).next(from, best) || best != expected) return true;
  if (topic == stamps.size()) return false;
  if (mayChange(stamps, policy, from, topic + 1, expected)) return true;
  for (std::int64_t ahead = policy.least_distance[topic]; ahead < 14; ++ahead) {
    Stamps more = stamps;
    more[topic].push_back(stamps[topic].empty() ? ahead : stamps[topic].back() + ahead);
    if (mayChange(more, policy, from, topic + 1, expected)) return true;
  }
  return false;
}

// A set that has not come would, with some message to come, be another.
TEST(ApproximateTime, WaitsNoLongerThanItMust) {
  Random random(7);
  int waited = 0;
  for (int run = 0; run < 150; ++run) {
    SCOPED_TRACE(run);
    const ApproximateTime policy = randomPolicy(random);
    Two rig(policy);
    for (const Arrival& one : randomArrivals(random, policy, 2, 10)) {
      rig.publish(one);
      Places from(2, 0);
      if (!rig.sets.empty()) from = {rig.sets.back()[0] + 1, rig.sets.back()[1] + 1};
      Places next;
      if (!Definition(rig.stamps, policy).next(from, next)) continue;
      ++waited;
      ASSERT_TRUE(mayChange(rig.stamps, policy, from, 0, next));
    }
  }
  EXPECT_GT(waited, 100);
}

TEST(ApproximateTime, DoesNotDependOnWhichTopicIsFaster) {
  Random random(3);
  for (int run = 0; run < 200; ++run) {
    const ApproximateTime policy = randomPolicy(random);
    std::vector<Arrival> arrivals = randomArrivals(random, policy, 3, 60);
    Three mixed(policy);
    for (const Arrival& one : arrivals) mixed.publish(one);
    std::stable_sort(arrivals.begin(), arrivals.end(),
                     [](const Arrival& a, const Arrival& b) { return a.topic < b.topic; });
    Three sorted(policy);
    for (const Arrival& one : arrivals) sorted.publish(one);
    ASSERT_EQ(mixed.sets, sorted.sets);
  }
}

}  // namespace
