#include <gslam/base/parallel.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using gslam::ParallelOptions;
using gslam::ThreadPool;

ParallelOptions on(ThreadPool& pool, std::size_t grain, unsigned threads = 0) {
  ParallelOptions options;
  options.pool = &pool;
  options.grain = grain;
  options.threads = threads;
  return options;
}

TEST(ParallelFor, VisitsEachIndexOnce) {
  ThreadPool pool(3);
  for (std::size_t n : {0u, 1u, 2u, 7u, 64u, 1000u}) {
    for (std::size_t grain : {0u, 1u, 3u, 64u, 5000u}) {
      std::vector<std::atomic<int>> visits(n);
      gslam::parallelFor(
          0, n, [&visits](std::size_t i) { ++visits[i]; }, on(pool, grain));
      for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(visits[i].load(), 1) << n << ' ' << grain;
    }
  }
}

TEST(ParallelFor, StartsWhereItIsTold) {
  std::atomic<std::size_t> sum(0);
  gslam::parallelFor(10, 20, [&sum](std::size_t i) { sum += i; });
  EXPECT_EQ(sum.load(), 145u);
  gslam::parallelFor(20, 10, [](std::size_t) { FAIL() << "an empty range has no index"; });
}

TEST(ParallelChunks, CutsByGrainAlone) {
  ThreadPool pool(2);
  std::vector<std::size_t> sizes(4, 0);
  gslam::parallelChunks(
      5, 15,
      [&sizes](std::size_t first, std::size_t last) { sizes[(first - 5) / 3] = last - first; },
      on(pool, 3));
  EXPECT_EQ(sizes, (std::vector<std::size_t>{3, 3, 3, 1}));
}

TEST(ParallelChunks, EndOfTheIndexRangeDoesNotWrap) {
  const std::size_t top = std::numeric_limits<std::size_t>::max();
  std::atomic<int> calls(0);
  gslam::parallelFor(top - 3, top, [&calls](std::size_t) { ++calls; });
  EXPECT_EQ(calls.load(), 3);
  ParallelOptions options;
  options.grain = top;
  gslam::parallelChunks(
      1, top, [&calls](std::size_t, std::size_t) { ++calls; }, options);
  EXPECT_EQ(calls.load(), 4);
}

TEST(ParallelFor, OneThreadRunsInTheCallerInOrder) {
  ThreadPool pool(2);
  std::vector<std::size_t> order;
  const std::thread::id caller = std::this_thread::get_id();
  gslam::parallelFor(
      0, 50,
      [&](std::size_t i) {
        ASSERT_EQ(std::this_thread::get_id(), caller);
        order.push_back(i);
      },
      on(pool, 4, 1));
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(order[i], i);
}

TEST(ParallelFor, MayBeNestedOnABusyPool) {
  ThreadPool pool(1);
  std::atomic<int> calls(0);
  gslam::parallelFor(
      0, 8,
      [&](std::size_t) {
        gslam::parallelFor(
            0, 8, [&calls](std::size_t) { ++calls; }, on(pool, 1));
      },
      on(pool, 1));
  EXPECT_EQ(calls.load(), 64);
}

TEST(ParallelFor, RunsWhileAllWorkersAreBlocked) {
  ThreadPool pool(1);
  std::promise<void> release;
  std::shared_future<void> released(release.get_future());
  std::future<void> blocked = pool.submit([released] { released.wait(); });
  std::atomic<int> calls(0);
  gslam::parallelFor(
      0, 100, [&calls](std::size_t) { ++calls; }, on(pool, 1));
  EXPECT_EQ(calls.load(), 100);
  release.set_value();
  blocked.get();
}

TEST(ParallelFor, RethrowsTheLowestFailure) {
  ThreadPool pool(3);
  for (unsigned threads : {1u, 2u, 4u}) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      try {
        gslam::parallelFor(
            0, 100,
            [](std::size_t i) {
              if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
            },
            on(pool, 1, threads));
        FAIL() << "must throw";
      } catch (const std::runtime_error& error) {
        ASSERT_STREQ(error.what(), "7");
      }
    }
  }
}

TEST(ParallelFor, StopsTakingChunksAfterAFailure) {
  ThreadPool pool(1);
  std::atomic<int> calls(0);
  EXPECT_THROW(gslam::parallelFor(
                   0, 100000,
                   [&calls](std::size_t) {
                     ++calls;
                     throw std::runtime_error("stop");
                   },
                   on(pool, 1)),
               std::runtime_error);
  EXPECT_LE(calls.load(), 2);
}

TEST(ParallelFor, FailureOfAHugeLoopIsToldAtOnce) {
  const std::size_t huge = std::numeric_limits<std::size_t>::max();
  for (unsigned threads : {1u, 2u}) {
    ParallelOptions options;
    options.threads = threads;
    EXPECT_THROW(gslam::parallelFor(
                     0, huge, [](std::size_t) { throw std::runtime_error("stop"); }, options),
                 std::runtime_error);
  }
}

TEST(ParallelFor, BoundOfThreadsHolds) {
  ThreadPool pool(4);
  for (unsigned bound : {1u, 2u, 3u}) {
    std::atomic<unsigned> at_work(0), most(0);
    gslam::parallelFor(
        0, 300,
        [&](std::size_t) {
          const unsigned now = ++at_work;
          unsigned before = most.load();
          while (before < now && !most.compare_exchange_weak(before, now)) {
          }
          std::this_thread::yield();
          --at_work;
        },
        on(pool, 1, bound));
    EXPECT_LE(most.load(), bound);
  }
}

TEST(ParallelReduce, HasTheSameBitsForAnyNumberOfThreads) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> values(10007);
  for (double& value : values) value = uniform(random);
  const auto sum = [&values](std::size_t first, std::size_t last) {
    double part = 0;
    for (std::size_t i = first; i < last; ++i) part += values[i];
    return part;
  };
  const auto add = [](double a, double b) { return a + b; };
  ThreadPool one(1), four(4);
  const double expected = gslam::parallelReduce(0, values.size(), 0.0, sum, add, on(one, 100, 1));
  for (int repeat = 0; repeat < 20; ++repeat) {
    ASSERT_EQ(gslam::parallelReduce(0, values.size(), 0.0, sum, add, on(one, 100)), expected);
    ASSERT_EQ(gslam::parallelReduce(0, values.size(), 0.0, sum, add, on(four, 100)), expected);
  }
}

TEST(ParallelReduce, KeepsTheOrderOfChunks) {
  ThreadPool pool(3);
  const std::string joined = gslam::parallelReduce(
      0, 26, std::string(">"),
      [](std::size_t first, std::size_t last) {
        std::string part;
        for (std::size_t i = first; i < last; ++i) part += static_cast<char>('a' + i);
        return part;
      },
      [](const std::string& a, const std::string& b) { return a + b; }, on(pool, 4));
  EXPECT_EQ(joined, ">abcdefghijklmnopqrstuvwxyz");
}

TEST(ParallelReduce, WorksOnBool) {
  const bool all = gslam::parallelReduce(
      0, 1000, true, [](std::size_t first, std::size_t) { return first < 1000; },
      [](bool a, bool b) { return a && b; });
  EXPECT_TRUE(all);
}

TEST(ParallelReduce, EmptyRangeGivesTheInitialValue) {
  const int value = gslam::parallelReduce(
      3, 3, 42, [](std::size_t, std::size_t) { return 1; }, [](int a, int b) { return a + b; });
  EXPECT_EQ(value, 42);
}

}  // namespace
