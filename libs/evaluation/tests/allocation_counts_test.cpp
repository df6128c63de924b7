#include <gslam/evaluation/allocation_counts.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "spender_child.h"

namespace {

using gslam::AllocationCounts;

TEST(AllocationCounts, saysWhereTheyAreNotCounted) {
  EXPECT_FALSE(gslam::allocationCounts().is_counted);
  EXPECT_EQ(gslam::allocationCounts().calls, 0u);
  EXPECT_NE(gslam::whyNoAllocations().find("GSLAM::evaluation_malloc"), std::string::npos);
}

TEST(AllocationCounts, areDifferences) {
  AllocationCounts earlier, later;
  earlier.calls = 3;
  earlier.live_blocks = 2;
  later.is_counted = true;
  later.calls = 10;
  later.bytes = 100;
  later.frees = 4;
  later.live_blocks = 7;
  const AllocationCounts done = gslam::allocatedBetween(earlier, later);
  EXPECT_TRUE(done.is_counted);
  EXPECT_EQ(done.calls, 7u);
  EXPECT_EQ(done.bytes, 100u);
  EXPECT_EQ(done.frees, 4u);
  EXPECT_EQ(done.live_blocks, 7);
}

class CountedChild : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(gslam::countAllocationsOfChildren());
    ASSERT_TRUE(gslam::countAllocationsOfChildren());  // again does nothing
    if (!spender::canCount()) GTEST_SKIP() << "sanitizers have a malloc() of their own";
  }
};

// What the program counts itself: exactly what it asks for.
TEST_F(CountedChild, countsExactlyNBlocks) {
  spender::Child child({"blocks", "1000", "100", "1"});
  child.go();
  int is_counted = 0;
  long long calls = 0, bytes = 0, frees = 0, blocks = 0, live = 0;
  ASSERT_EQ(std::sscanf(child.line().c_str(), "%d %lld %lld %lld %lld %lld", &is_counted, &calls,
                        &bytes, &frees, &blocks, &live),
            6);
  EXPECT_EQ(is_counted, 1);
  EXPECT_EQ(calls, 1000);
  EXPECT_EQ(bytes, 100000);
  EXPECT_EQ(frees, 500);
  EXPECT_EQ(blocks, 500);
  EXPECT_GE(live, 500 * 100);
  EXPECT_LE(live, 500 * 120);
}

// And what is seen of it from outside, from threads that have ended.
TEST_F(CountedChild, reachesTheParent) {
  for (const int threads : {1, 4, 50}) {
    spender::Child child({"blocks", "2000", "1000", std::to_string(threads)});
    const AllocationCounts before = gslam::allocationCountsOf(child.number());
    ASSERT_TRUE(before.is_counted);
    child.go();
    if (threads == 1) child.line();
    EXPECT_EQ(child.line(), "done");
    const AllocationCounts after = gslam::allocationCountsOf(child.number());
    const AllocationCounts done = gslam::allocatedBetween(before, after);
    const std::uint64_t blocks = 2000 * std::uint64_t(threads);
    // A thread itself takes a few blocks.
    const std::uint64_t others = threads == 1 ? 0 : 20 + 8 * std::uint64_t(threads);
    EXPECT_GE(done.calls, blocks);
    EXPECT_LE(done.calls, blocks + others);
    EXPECT_GE(done.bytes, 1000 * blocks);
    EXPECT_GE(done.frees, blocks / 2);
    EXPECT_LE(done.frees, blocks / 2 + others);
    EXPECT_NEAR(double(after.live_blocks - before.live_blocks), double(blocks) / 2, double(others));
    EXPECT_GE(double(after.peak_live_bytes), double(after.live_bytes) - 70000.0 * threads);
    EXPECT_LE(double(after.peak_live_bytes - before.live_bytes),
              1016.0 * double(blocks) + 70000.0 * threads);
    EXPECT_GE(double(after.peak_live_bytes - before.live_bytes),
              1000.0 * 2000 - 70000.0 * threads);  // at least one thread had all of its
    child.end();
    EXPECT_EQ(gslam::allocationCountsOf(0).calls, gslam::allocationCountsOf(getpid()).calls);
    EXPECT_GE(gslam::allocationCountsOf(0).calls, after.calls);  // it ended, and counts
    EXPECT_FALSE(gslam::allocationCountsOf(0).is_counted);       // of children alone
  }
}

TEST_F(CountedChild, tellsTheLargestLife) {
  spender::Child child({"touch", "64"});
  const AllocationCounts before = gslam::allocationCountsOf(child.number());
  child.go();
  EXPECT_EQ(child.line(), "touched 1");
  const AllocationCounts touched = gslam::allocationCountsOf(child.number());
  child.go();
  EXPECT_EQ(child.line(), "done");
  const AllocationCounts after = gslam::allocationCountsOf(child.number());
  EXPECT_NEAR(double(touched.live_bytes - before.live_bytes), 64e6, 1e5);
  EXPECT_NEAR(double(after.live_bytes - before.live_bytes), 0, 1e5);
  EXPECT_NEAR(double(after.peak_live_bytes - before.live_bytes), 64e6, 2e5);
  EXPECT_EQ(after.calls - before.calls, 1u);
  EXPECT_EQ(after.frees - before.frees, 1u);
}

// All kinds of calls, and what makes no block.
TEST_F(CountedChild, countsEveryKind) {
  spender::Child child({"kinds"});
  child.go();
  for (std::string line = child.line(); line != "done"; line = child.line()) {
    ASSERT_FALSE(line.empty());
    char name[64] = {0};
    int calls = 0, frees = 0, bytes = 0, wanted_calls = 0, wanted_frees = 0, wanted_bytes = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%63s %d %d %d expected %d %d %d", name, &calls, &frees,
                          &bytes, &wanted_calls, &wanted_frees, &wanted_bytes),
              7)
        << line;
    EXPECT_EQ(calls, wanted_calls) << name;
    EXPECT_EQ(frees, wanted_frees) << name;
    EXPECT_EQ(bytes, wanted_bytes) << name;
  }
}

// A forked child counts for itself, from 0, and as any child.
TEST_F(CountedChild, staysRightOverAFork) {
  spender::Child child({"fork", "3000"});
  const AllocationCounts before = gslam::allocationCountsOf(child.number());
  child.go();
  EXPECT_EQ(child.line(), "child 1 3000");
  EXPECT_EQ(child.line(), "done");
  const AllocationCounts done =
      gslam::allocatedBetween(before, gslam::allocationCountsOf(child.number()));
  EXPECT_GE(done.calls, 3000u);
  EXPECT_LE(done.calls, 3100u);
}

TEST_F(CountedChild, includesForkedDescendants) {
  spender::Child child({"forks", "3000"});
  const AllocationCounts before = gslam::allocationCountsOf(child.number());
  child.go();
  EXPECT_EQ(child.line(), "done");
  const AllocationCounts done =
      gslam::allocatedBetween(before, gslam::allocationCountsOf(child.number()));
  EXPECT_GE(done.calls, 6000u);
  EXPECT_LE(done.calls, 6600u);
}

// More than there are tables: places of those that are gone are taken again, and nothing is lost.
TEST_F(CountedChild, countsAnyNumberOfChildren) {
  constexpr std::uint64_t kChildren = 1300;
  spender::Child child({"many", "100", std::to_string(kChildren)});
  spender::Child other({"blocks", "1000", "100", "1"});  // which lives all the time
  const AllocationCounts before = gslam::allocationCountsOf(child.number());
  const AllocationCounts all_before = gslam::allocationCountsOf(0);
  child.go();
  EXPECT_EQ(child.line(), "done");
  const AllocationCounts after = gslam::allocationCountsOf(child.number());
  const AllocationCounts done = gslam::allocatedBetween(before, after);
  EXPECT_TRUE(after.is_counted);
  EXPECT_GE(done.calls, 100 * kChildren);
  EXPECT_LE(done.calls, 200 * kChildren);  // a program itself takes a few
  EXPECT_GE(done.bytes, 10 * 100 * kChildren);
  EXPECT_GE(done.frees, 50 * kChildren);
  EXPECT_EQ(gslam::allocatedBetween(all_before, gslam::allocationCountsOf(0)).calls, done.calls);
  const auto begin = std::chrono::steady_clock::now();
  constexpr int kTimes = 1000;
  for (int i = 0; i < kTimes; ++i)
    ASSERT_TRUE(gslam::allocationCountsOf(child.number()).is_counted);
  EXPECT_LT(spender::secondsSince(begin) / kTimes, 1e-4);  // a few us; it was 12 ms
  // Where it ended, what it was is its parent's, and those that come are counted.
  child.end();
  const AllocationCounts ended = gslam::allocationCountsOf(0);
  for (int i = 0; i < 40; ++i) {
    spender::Child late({"blocks", "10", "100", "1"});
    EXPECT_TRUE(gslam::allocationCountsOf(late.number()).is_counted);
  }
  const AllocationCounts at_end = gslam::allocationCountsOf(0);
  EXPECT_GE(at_end.calls, ended.calls);
  EXPECT_LE(at_end.calls, ended.calls + 40 * 100);
  EXPECT_TRUE(gslam::allocationCountsOf(other.number()).is_counted);
  other.go();
  EXPECT_EQ(other.line().substr(0, 7), "1 1000 ");
}

// More threads than have places of their own, all at once, allocating while others fork.
TEST_F(CountedChild, hasRoomForManyThreads) {
  spender::Child child({"crowd", "1200", "10"});
  const AllocationCounts before = gslam::allocationCountsOf(child.number());
  child.go();
  EXPECT_EQ(child.line(), "done");
  const AllocationCounts after = gslam::allocationCountsOf(child.number());
  EXPECT_GE(after.calls - before.calls, 12000u);
  EXPECT_LE(after.calls - before.calls, 12000u + 1200 * 8);
  EXPECT_LE(after.live_blocks - before.live_blocks, 1300);  // what the system keeps of threads
}

// Processes that a counted one starts count for it.
TEST_F(CountedChild, includesDescendants) {
  spender::Child child({"spawn", "5000"});
  const AllocationCounts before = gslam::allocationCountsOf(child.number());
  child.go();
  EXPECT_EQ(child.line(), "done");
  const AllocationCounts done =
      gslam::allocatedBetween(before, gslam::allocationCountsOf(child.number()));
  EXPECT_GE(done.calls, 5000u);
  EXPECT_LE(done.calls, 5500u);
}

// Their children come and go at the same time and take each other's places.
TEST_F(CountedChild, sharesPlacesAmongMany) {
  std::vector<std::unique_ptr<spender::Child>> children;
  std::vector<AllocationCounts> before;
  for (int i = 0; i < 4; ++i) {
    children.push_back(std::make_unique<spender::Child>(
        std::vector<std::string>{"many", std::to_string(1000 * (i + 1)), "60"}));
    before.push_back(gslam::allocationCountsOf(children.back()->number()));
  }
  for (const auto& child : children) child->go();
  for (const auto& child : children) EXPECT_EQ(child->line(), "done");
  for (std::size_t i = 0; i < children.size(); ++i) {
    const AllocationCounts done =
        gslam::allocatedBetween(before[i], gslam::allocationCountsOf(children[i]->number()));
    EXPECT_GE(done.calls, 60 * 1000 * (i + 1));
    EXPECT_LE(done.calls, 60 * 1000 * (i + 1) + 60 * 100);
  }
}

TEST_F(CountedChild, knowsNoOthers) {
  EXPECT_FALSE(gslam::allocationCountsOf(1).is_counted);
  EXPECT_FALSE(gslam::allocationCountsOf(-5).is_counted);
}

// A child that is told nonsense counts for itself and runs as ever.
TEST_F(CountedChild, survivesNonsense) {
  const std::string before = getenv("GSLAM_ALLOCATION_COUNTS");
  for (const char* text : {"", ":", "0:0", "99999:1", "-1:5", "x:y", "12", "3:3:3"}) {
    setenv("GSLAM_ALLOCATION_COUNTS", text, 1);
    spender::Child child({"blocks", "10", "100", "1"});
    EXPECT_FALSE(gslam::allocationCountsOf(child.number()).is_counted) << text;
    child.go();
    EXPECT_EQ(child.line().substr(0, 5), "1 10 ") << text;
  }
  setenv("GSLAM_ALLOCATION_COUNTS", before.c_str(), 1);
}

}  // namespace
