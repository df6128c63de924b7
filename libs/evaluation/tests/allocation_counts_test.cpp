#include <gslam/evaluation/allocation_counts.h>
#include <gtest/gtest.h>

#include <cstdio>

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
    EXPECT_GE(after.peak_live_bytes, after.live_bytes);
    EXPECT_NEAR(double(after.peak_live_bytes - before.live_bytes), 1016.0 * double(blocks) * 0.5,
                1016.0 * double(blocks) * 0.5 + 70000.0 * threads);
    EXPECT_GE(double(after.peak_live_bytes - before.live_bytes),
              1000.0 * 2000 - 70000.0 * threads);  // at least one thread had all of its
    child.end();
    EXPECT_EQ(gslam::allocationCountsOf(0).calls, gslam::allocationCountsOf(getpid()).calls);
    EXPECT_GE(gslam::allocationCountsOf(0).calls, after.calls);  // it ended, and counts
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

// A forked child counts for itself: what it does is not in its parent's counts.
TEST_F(CountedChild, staysRightOverAFork) {
  spender::Child child({"fork", "3000"});
  const AllocationCounts before = gslam::allocationCountsOf(child.number());
  child.go();
  EXPECT_EQ(child.line(), "child 1 3000");
  EXPECT_EQ(child.line(), "done");
  const AllocationCounts done =
      gslam::allocatedBetween(before, gslam::allocationCountsOf(child.number()));
  EXPECT_LE(done.calls, 100u);
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
