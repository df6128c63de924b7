// What reaches stdout, stderr and glog.
#include <glog/logging.h>
#include <gslam/optimizer_ceres.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "scenes.h"

namespace {

using gslam::OptimizerIteration;
using gslam::OptimizerOptions;
using scenes::Bundle;

// With a free gauge and next to no damping: until matrices cannot be factored any more, of which
// Ceres warns.
OptimizerOptions reckless() {
  OptimizerOptions options;
  options.function_tolerance = 1e-20;
  options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.max_iterations = 30;
  options.initial_damping = 1e-16;
  return options;
}

void solveRecklessly(const OptimizerOptions& options) {
  Bundle scene = Bundle::make(4, 20, {scenes::radtan()}, {}, 1);
  scene.disturb(0.3, 0.3, 1, 0);
  gslam::ceresBackend().bundle(scene.problem(), options);
}

TEST(silence, nothing_is_written_to_stdout_or_stderr) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  OptimizerOptions options = reckless();
  solveRecklessly(options);
  options.linear_solver = gslam::LinearSolverKind::Sparse;
  solveRecklessly(options);
  Bundle scene = Bundle::make(4, 20, {scenes::radtan()}, {}, 1);
  const std::vector<std::uint32_t> some = {1};
  EXPECT_FALSE(
      gslam::ceresBackend().bundle_covariance(scene.problem(), some, some, {}, {}).is_valid);
  EXPECT_EQ("", testing::internal::GetCapturedStderr());
  EXPECT_EQ("", testing::internal::GetCapturedStdout());
}

TEST(silence, threshold_is_put_back_when_the_last_search_ends) {
  const int before = FLAGS_minloglevel;
  std::atomic<int> raised{0};
  OptimizerOptions options = reckless();
  options.max_iterations = 5;
  options.progress = [&raised](const OptimizerIteration& /*step*/) {
    raised += FLAGS_minloglevel == google::GLOG_FATAL ? 1 : 0;
    return true;
  };
  std::thread other([&options] { solveRecklessly(options); });
  solveRecklessly(options);
  other.join();
  EXPECT_GE(raised, 2);
  EXPECT_EQ(before, FLAGS_minloglevel);
}

class Sink : public google::LogSink {
 public:
  void send(google::LogSeverity /*severity*/, const char* /*full*/, const char* /*base*/,
            int /*line*/, const struct tm* /*when*/, const char* /*message*/,
            std::size_t /*length*/) override {
    ++messages;
  }
  std::atomic<int> messages{0};
};

TEST(silence, an_application_with_a_log_keeps_its_threshold) {
  google::InitGoogleLogging("optimizer_ceres_test");
  for (int severity = 0; severity < google::NUM_SEVERITIES; ++severity) {
    google::SetLogDestination(severity, "");  // no files
  }
  const int threshold_of_stderr = FLAGS_stderrthreshold;
  FLAGS_stderrthreshold = google::NUM_SEVERITIES;
  Sink sink;
  google::AddLogSink(&sink);
  const int before = FLAGS_minloglevel;
  bool is_kept = true;
  OptimizerOptions options = reckless();
  options.progress = [&](const OptimizerIteration& /*step*/) {
    is_kept = is_kept && FLAGS_minloglevel == before;
    return true;
  };
  solveRecklessly(options);
  EXPECT_TRUE(is_kept);
  EXPECT_GT(sink.messages, 0);  // what the other tests do not see is there
  google::RemoveLogSink(&sink);
  FLAGS_stderrthreshold = threshold_of_stderr;
  google::ShutdownGoogleLogging();
  EXPECT_EQ(before, FLAGS_minloglevel);
}

}  // namespace
