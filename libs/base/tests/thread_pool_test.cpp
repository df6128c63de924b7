#include <gslam/base/thread_pool.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using gslam::ThreadPool;

TEST(ThreadPool, ReturnsResults) {
  ThreadPool pool(2);
  std::future<int> number = pool.submit([] { return 42; });
  std::future<std::string> text = pool.submit([] { return std::string("abc"); });
  std::future<void> nothing = pool.submit([] {});
  EXPECT_EQ(number.get(), 42);
  EXPECT_EQ(text.get(), "abc");
  nothing.get();
}

TEST(ThreadPool, PassesExceptionsOn) {
  ThreadPool pool(1);
  std::future<int> result = pool.submit([]() -> int { throw std::runtime_error("broken"); });
  EXPECT_THROW(result.get(), std::runtime_error);
  EXPECT_EQ(pool.submit([] { return 1; }).get(), 1);  // the worker lives on
}

TEST(ThreadPool, TakesMoveOnlyTasks) {
  struct MoveOnly {
    std::unique_ptr<int> value{new int(5)};
    int operator()() { return *value; }
  };
  ThreadPool pool(1);
  EXPECT_EQ(pool.submit(MoveOnly()).get(), 5);
}

TEST(ThreadPool, OneWorkerKeepsTheOrder) {
  std::vector<int> order;
  {
    ThreadPool pool(1);
    for (int i = 0; i < 100; ++i) pool.post([&order, i] { order.push_back(i); });
  }
  ASSERT_EQ(order.size(), 100u);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
}

TEST(ThreadPool, DestructorRunsWhatIsQueued) {
  std::atomic<int> done(0);
  {
    ThreadPool pool(3);
    for (int i = 0; i < 1000; ++i) pool.post([&done] { ++done; });
  }
  EXPECT_EQ(done.load(), 1000);
}

TEST(ThreadPool, PostedTaskThatThrowsIsLogged) {
  std::vector<std::string> messages;
  gslam::setLogSink(
      [&messages](const gslam::LogRecord& record) { messages.push_back(record.message); });
  {
    ThreadPool pool(1);
    pool.post([] { throw std::runtime_error("lost"); });
    pool.post([] { throw 7; });
    EXPECT_EQ(pool.submit([] { return 1; }).get(), 1);
  }
  gslam::setLogSink(nullptr);
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[0], "a task of the thread pool threw: lost");
}

TEST(ThreadPool, TasksMaySubmitTasks) {
  ThreadPool pool(2);
  std::future<std::future<int>> outer =
      pool.submit([&pool] { return pool.submit([] { return 3; }); });
  EXPECT_EQ(outer.get().get(), 3);
}

TEST(ThreadPool, ManyThreadsMaySubmit) {
  std::atomic<int> done(0);
  {
    ThreadPool pool(2);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (int i = 0; i < 500; ++i) pool.post([&done] { ++done; });
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  EXPECT_EQ(done.load(), 2000);
}

TEST(ThreadPool, TaskFreesItsCapturesBeforeTheNextRuns) {
  ThreadPool pool(1);
  const std::shared_ptr<int> watched = std::make_shared<int>(1);
  pool.post([watched] {});
  pool.submit([] {}).get();
  EXPECT_EQ(watched.use_count(), 1);
}

TEST(ThreadPool, SharedOneHasAWorker) {
  EXPECT_GE(ThreadPool::shared().size(), 1u);
  EXPECT_EQ(ThreadPool::shared().submit([] { return 9; }).get(), 9);
}

class ThreadCount : public testing::Test {
 protected:
  ~ThreadCount() override { unsetenv("GSLAM_THREADS"); }
};

TEST_F(ThreadCount, ComesFromTheEnvironment) {
  setenv("GSLAM_THREADS", "3", 1);
  EXPECT_EQ(gslam::defaultThreadCount(), 3u);
  EXPECT_EQ(ThreadPool().size(), 3u);
}

TEST_F(ThreadCount, IsAtLeastOne) {
  unsetenv("GSLAM_THREADS");
  EXPECT_GE(gslam::defaultThreadCount(), 1u);
  setenv("GSLAM_THREADS", "", 1);
  EXPECT_GE(gslam::defaultThreadCount(), 1u);
}

TEST_F(ThreadCount, NonsenseIsAnError) {
  for (const char* wish : {"0", "-1", "two", "4x", "5000", "99999999999999999999"}) {
    setenv("GSLAM_THREADS", wish, 1);
    EXPECT_THROW(gslam::defaultThreadCount(), gslam::ArgumentError) << wish;
  }
}

}  // namespace
