#include <gslam/base/log.h>
#include <gtest/gtest.h>

#include <atomic>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using gslam::LogLevel;
using gslam::LogRecord;

class Log : public testing::Test {
 protected:
  ~Log() override { gslam::setLogSink(nullptr); }

  void collect(LogLevel least) {
    gslam::setLogSink([this](const LogRecord& record) { records_.push_back(record); }, least);
  }

  std::vector<LogRecord> records_;
};

TEST_F(Log, IsOffAtFirst) {
  EXPECT_FALSE(gslam::logEnabled(LogLevel::error));
  GSLAM_LOG(error) << "nobody listens";
}

TEST_F(Log, CarriesLevelPlaceAndMessage) {
  collect(LogLevel::info);
  GSLAM_LOG(warning) << "lost track at frame " << 7;
  ASSERT_EQ(records_.size(), 1u);
  EXPECT_EQ(records_[0].level, LogLevel::warning);
  EXPECT_EQ(records_[0].message, "lost track at frame 7");
  EXPECT_NE(std::string(records_[0].file).find("log_test.cpp"), std::string::npos);
  EXPECT_GT(records_[0].line, 0);
}

TEST_F(Log, DropsWhatIsBelowTheLevelWithoutEvaluatingIt) {
  collect(LogLevel::warning);
  int evaluated = 0;
  const auto count = [&evaluated] { return ++evaluated; };
  GSLAM_LOG(info) << count();
  EXPECT_EQ(evaluated, 0);
  GSLAM_LOG(error) << count();
  EXPECT_EQ(evaluated, 1);
  ASSERT_EQ(records_.size(), 1u);
  EXPECT_EQ(records_[0].message, "1");
}

TEST_F(Log, EmptySinkTurnsItOff) {
  collect(LogLevel::debug);
  gslam::setLogSink(nullptr, LogLevel::debug);
  GSLAM_LOG(error) << "gone";
  EXPECT_TRUE(records_.empty());
  EXPECT_FALSE(gslam::logEnabled(LogLevel::error));
}

TEST_F(Log, MacroIsOneStatement) {
  collect(LogLevel::debug);
  if (records_.empty())
    GSLAM_LOG(info) << "then";
  else
    GSLAM_LOG(info) << "else";
  ASSERT_EQ(records_.size(), 1u);
  EXPECT_EQ(records_[0].message, "then");
}

TEST_F(Log, SinkThatThrowsDoesNoHarm) {
  gslam::setLogSink([](const LogRecord&) { throw std::runtime_error("disk full"); });
  EXPECT_NO_THROW(GSLAM_LOG(error) << "dropped");
}

TEST_F(Log, SinkMayReplaceItself) {
  int calls = 0;
  gslam::setLogSink([&](const LogRecord&) {
    ++calls;
    gslam::setLogSink([&](const LogRecord&) { calls += 10; });
  });
  GSLAM_LOG(error) << "first";
  GSLAM_LOG(error) << "second";
  EXPECT_EQ(calls, 11);
}

TEST_F(Log, WhatASinkLogsIsDropped) {
  int calls = 0;
  gslam::setLogSink([&](const LogRecord&) {
    ++calls;
    GSLAM_LOG(error) << "from inside";
  });
  GSLAM_LOG(error) << "from outside";
  GSLAM_LOG(error) << "again";
  EXPECT_EQ(calls, 2);
}

TEST_F(Log, StreamSinkWritesOneLineARecord) {
  std::ostringstream stream;
  gslam::setLogSink(gslam::streamLogSink(stream), LogLevel::debug);
  gslam::log({LogLevel::debug, "src/deep/tracker.cpp", 42, "lost"});
  gslam::log({LogLevel::error, "map.cpp", 1, "full"});
  EXPECT_EQ(stream.str(), "debug tracker.cpp:42: lost\nerror map.cpp:1: full\n");
}

TEST_F(Log, ThreadsMayLogWhileTheSinkChanges) {
  std::atomic<int> seen(0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([] {
      for (int i = 0; i < 1000; ++i) GSLAM_LOG(info) << i;
    });
  }
  for (int i = 0; i < 200; ++i) gslam::setLogSink([&seen](const LogRecord&) { ++seen; });
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(seen.load(), 4000);
  const int before = seen.load();
  GSLAM_LOG(info) << "still works";
  EXPECT_EQ(seen.load(), before + 1);
}

}  // namespace
