// SLAM systems in processes of their own, and all the ways in which these come to their ends.
#include <dirent.h>
#include <gmock/gmock.h>
#include <gslam/core/isolated_slam.h>
#include <gslam/core/plugins.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "resident_bytes.h"
#include "toy_frames.h"

#if GSLAM_DETAIL_HAS_ISOLATION
namespace {

using gslam::IsolatedSlam;
using gslam::IsolationError;
using gslam::IsolationFailure;
using gslam::IsolationOptions;
using gslam::Svar;
using gslam::TrackedPose;
using testing::AllOf;
using testing::HasSubstr;
using Kind = gslam::IsolationFailure::Kind;
using std::chrono::milliseconds;

constexpr bool isSanitized() {
  return gslam::thisBuild().sanitizer != 0;
}

// Sanitizers handle what would end a process; the child is to end as others do.
class Isolation : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ::setenv("ASAN_OPTIONS", "handle_segv=0:handle_abort=0:allocator_may_return_null=1", 1);
    ::setenv("TSAN_OPTIONS", "handle_segv=0:handle_abort=0", 1);
    ::setenv("UBSAN_OPTIONS", "handle_segv=0:handle_abort=0", 1);
  }
};

IsolationOptions optionsOf(const std::string& slam = "toy") {
  IsolationOptions options;
  options.slam = std::string(GSLAM_TEST_PLUGIN_TOY) + ":" + slam;
  options.worker = GSLAM_TEST_WORKER;
  return options;
}

// A SLAM system with its setup, and the poses that it published.
class SlamRun {
 public:
  SlamRun(std::unique_ptr<gslam::Slam> slam, const Svar& parameters) : slam_(std::move(slam)) {
    setup_.parameters = parameters;
    setup_.sensors = toyRig();
    subscriber_ = setup_.messenger.subscribe<TrackedPose>(
        "pose", [this](const TrackedPose& pose) { poses_.push_back(pose); });
    slam_->configure(setup_);
  }
  gslam::Slam& slam() { return *slam_; }
  const std::vector<TrackedPose>& poses() const { return poses_; }

 private:
  std::unique_ptr<gslam::Slam> slam_;
  gslam::SlamSetup setup_;
  std::vector<TrackedPose> poses_;
  gslam::Subscriber subscriber_;
};

std::unique_ptr<gslam::Slam> isolated(const IsolationOptions& options = optionsOf()) {
  return std::unique_ptr<gslam::Slam>(new IsolatedSlam(options));
}

Svar misbehaving(const std::string& how, const std::string& where = "feed", int at = 1) {
  return Svar::object({{"how", how}, {"where", where}, {"at", at}});
}

int openFiles() {
  int count = 0;
  DIR* const listing = ::opendir("/proc/self/fd");
  while (::readdir(listing) != nullptr) ++count;
  ::closedir(listing);
  return count;
}

bool hasChildren() {
  return ::waitpid(-1, nullptr, WNOHANG) >= 0;
}

// What feed() of frame 1 throws where the system misbehaves in that call.
IsolationFailure failureOf(const std::string& how, milliseconds limit = milliseconds(20000)) {
  const int files = openFiles();
  IsolationFailure failure;
  {
    IsolationOptions options = optionsOf();
    options.feed_limit = limit;
    IsolatedSlam slam(options);
    gslam::SlamSetup setup;
    setup.parameters = misbehaving(how);
    slam.configure(setup);
    slam.feed(toyFrame(0));
    bool is_over = false;
    for (std::uint64_t id = 1; !is_over && id < 3; ++id) {
      try {
        slam.feed(toyFrame(id));
      } catch (const IsolationError& error) {
        failure = error.failure();
        EXPECT_THAT(error.what(), AllOf(HasSubstr("toy"), HasSubstr("feed() of frame ")));
        is_over = true;
      }
    }
    EXPECT_TRUE(is_over) << how;
    EXPECT_EQ(slam.processNumber(), 0);
    EXPECT_FALSE(hasChildren());
    EXPECT_THROW(slam.finish(), IsolationError);
    EXPECT_THROW(slam.map(), IsolationError);
    EXPECT_NE(slam.failure(), nullptr);
  }
  EXPECT_EQ(failure.call, "feed");
  EXPECT_TRUE(failure.has_frame);
  EXPECT_EQ(openFiles(), files);
  return failure;
}

bool isSamePose(const TrackedPose& a, const TrackedPose& b) {
  return a.frame == b.frame && a.stamp == b.stamp && a.state == b.state &&
         std::memcmp(a.T_world_body.data(), b.T_world_body.data(), 7 * sizeof(double)) == 0;
}

TEST_F(Isolation, GivesTheSamePosesToTheBit) {
  gslam::Plugins plugins;
  const Svar parameters = Svar::object({{"seed", "x\n\xC3\xA4\""}, {"keep", 3}});
  SlamRun here(plugins.slam(optionsOf().slam).make(), parameters);
  SlamRun there(isolated(), parameters);
  for (std::uint64_t id = 0; id < 30; ++id) {
    const auto frame = toyFrame(id, 1 + int(id) % 5);
    here.slam().feed(frame);
    there.slam().feed(frame);
    ASSERT_EQ(there.poses().size(), id + 1);
    EXPECT_TRUE(isSamePose(here.poses()[id], there.poses()[id])) << id;
  }
  const auto bare = std::make_shared<gslam::Frame>();
  bare->id = 30;
  here.slam().feed(bare);
  there.slam().feed(bare);
  EXPECT_TRUE(isSamePose(here.poses().back(), there.poses().back()));
  here.slam().finish();
  there.slam().finish();
}

TEST_F(Isolation, TellsWhichSignalEndedIt) {
  IsolationFailure failure = failureOf("segfault");
  EXPECT_EQ(failure.kind, Kind::signal);
  EXPECT_EQ(failure.number, SIGSEGV);
  EXPECT_EQ(failure.signal_name, "SIGSEGV");
  EXPECT_EQ(failure.last_frame, 1u);
  failure = failureOf("abort");
  EXPECT_EQ(failure.kind, Kind::signal);
  EXPECT_EQ(failure.number, SIGABRT);
  failure = failureOf("kill");
  EXPECT_EQ(failure.kind, Kind::signal);
  EXPECT_EQ(failure.number, SIGKILL);
}

TEST_F(Isolation, TellsTheStatusItEndedWith) {
  IsolationFailure failure = failureOf("exit");
  EXPECT_EQ(failure.kind, Kind::exit);
  EXPECT_EQ(failure.number, 7);
  failure = failureOf("exit0");
  EXPECT_EQ(failure.kind, Kind::exit);
  EXPECT_EQ(failure.number, 0);
}

TEST_F(Isolation, EndsWhatHangs) {
  const auto start = std::chrono::steady_clock::now();
  const IsolationFailure failure = failureOf("hang", milliseconds(3000));
  EXPECT_EQ(failure.kind, Kind::timeout);
  EXPECT_EQ(failure.limit, milliseconds(3000));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_THAT(toText(failure), HasSubstr("within 3000 ms"));
}

TEST_F(Isolation, SurvivesGarbage) {
  EXPECT_EQ(failureOf("garbage").kind, Kind::garbage);
  // A terabyte is promised; what comes is an answer that is taken for a part of it.
  EXPECT_EQ(failureOf("huge", milliseconds(3000)).kind, Kind::timeout);
}

TEST_F(Isolation, SeesAClosedSocket) {
  const IsolationFailure failure = failureOf("close", milliseconds(5000));
  EXPECT_EQ(failure.kind, Kind::exit);
}

TEST_F(Isolation, SeesTheEndThoughAHelperHoldsTheSocket) {
  const auto start = std::chrono::steady_clock::now();
  const IsolationFailure failure = failureOf("helper");
  EXPECT_EQ(failure.kind, Kind::signal);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15));
}

TEST_F(Isolation, ThrowsWhatTheSystemThrew) {
  const auto thrownBy = [](const std::string& how) {
    SlamRun run(isolated(), misbehaving(how));
    run.slam().feed(toyFrame(1));
  };
  const auto textOf = [&](const std::string& how) -> std::string {
    try {
      thrownBy(how);
      return "";
    } catch (const gslam::Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(textOf("throw"), "the toy broke");
  EXPECT_EQ(textOf("throw argument"), gslam::ArgumentError("toy", "is broken").what());
  EXPECT_EQ(textOf("throw file"), gslam::FileError("/toy/box", "is empty").what());
  EXPECT_EQ(textOf("throw parse"), gslam::ParseError("toy.yaml", 3, 4, "has no wheels").what());
  EXPECT_EQ(textOf("throw std"), "beyond the box");
  EXPECT_THAT(textOf("throw int"), HasSubstr("no std::exception"));
  EXPECT_THROW(thrownBy("throw argument"), gslam::ArgumentError);
  EXPECT_THROW(thrownBy("throw file"), gslam::FileError);
  try {
    thrownBy("throw parse");
    ADD_FAILURE();
  } catch (const gslam::ParseError& error) {
    EXPECT_EQ(error.source(), "toy.yaml");
    EXPECT_EQ(error.line(), 3u);
    EXPECT_EQ(error.column(), 4u);
  }
}

TEST_F(Isolation, GoesOnAfterAnException) {
  SlamRun run(isolated(), misbehaving("throw"));
  EXPECT_THROW(run.slam().feed(toyFrame(1)), gslam::Error);
  run.slam().feed(toyFrame(2));
  run.slam().finish();
  EXPECT_EQ(run.poses().size(), 1u);
}

TEST_F(Isolation, NamesTheCallInWhichItEnded) {
  for (const std::string where : {"configure", "map", "finish"}) {
    IsolatedSlam slam(optionsOf());
    gslam::SlamSetup setup;
    setup.parameters = misbehaving("abort", where, 0);
    try {
      slam.configure(setup);
      slam.feed(toyFrame(9));
      if (where == "map") slam.map();
      slam.finish();
      ADD_FAILURE() << where;
    } catch (const IsolationError& error) {
      EXPECT_EQ(error.failure().call, where);
      EXPECT_EQ(error.failure().has_frame, where != "configure");
      EXPECT_THAT(error.what(), HasSubstr(where + "()"));
    }
  }
}

TEST_F(Isolation, TellsOfAnEndBetweenTwoCalls) {
  IsolatedSlam slam(optionsOf());
  slam.configure({});
  slam.feed(toyFrame(4));
  EXPECT_EQ(::kill(pid_t(slam.processNumber()), SIGKILL), 0);
  std::this_thread::sleep_for(milliseconds(300));
  try {
    slam.feed(toyFrame(5));
    ADD_FAILURE();
  } catch (const IsolationError& error) {
    EXPECT_EQ(error.failure().kind, Kind::signal);
    EXPECT_EQ(error.failure().call, "");
    EXPECT_EQ(error.failure().last_frame, 4u);
    EXPECT_THAT(error.what(), HasSubstr("SIGKILL) between two calls after frame 4"));
  }
  EXPECT_FALSE(hasChildren());
}

TEST_F(Isolation, FailsToBeginAsTheSystemDoes) {
  EXPECT_THROW(IsolatedSlam{optionsOf("toy_throws")}, gslam::ArgumentError);
  try {
    const IsolatedSlam slam(optionsOf("toy_crashes"));
    ADD_FAILURE();
  } catch (const IsolationError& error) {
    EXPECT_EQ(error.failure().number, SIGSEGV);
    EXPECT_EQ(error.failure().call, "make");
  }
  EXPECT_THROW(IsolatedSlam{optionsOf("nobody")}, gslam::FileError);
  EXPECT_FALSE(hasChildren());
}

TEST_F(Isolation, RefusesProgramsThatAreNoWorkers) {
  const int files = openFiles();
  IsolationOptions options = optionsOf();
  options.worker = "/not/there";
  EXPECT_THROW(IsolatedSlam{options}, gslam::FileError);
  options.start_limit = milliseconds(500);
  for (const std::string program : {"/bin/true", "/bin/cat"}) {
    options.worker = program;
    try {
      const IsolatedSlam slam(options);
      ADD_FAILURE() << program;
    } catch (const IsolationError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(program), HasSubstr("isIsolationWorker")));
    }
  }
  options.slam = "";
  EXPECT_THROW(IsolatedSlam{options}, gslam::ArgumentError);
  EXPECT_EQ(openFiles(), files);
  EXPECT_FALSE(hasChildren());
}

TEST_F(Isolation, IsNotNested) {
  ::setenv("GSLAM_ISOLATION_WORKER", "1", 1);
  EXPECT_THROW(IsolatedSlam{optionsOf()}, gslam::Error);
  ::unsetenv("GSLAM_ISOLATION_WORKER");
}

TEST_F(Isolation, RefusesParametersWithoutAJsonForm) {
  IsolatedSlam slam(optionsOf());
  gslam::SlamSetup setup;
  setup.parameters = Svar::object({{"f", Svar::function([] { return 1; })}});
  EXPECT_THROW(slam.configure(setup), gslam::Error);
  EXPECT_THROW(slam.feed(nullptr), gslam::ArgumentError);
  setup.parameters = Svar();
  slam.configure(setup);
}

TEST_F(Isolation, HasAMapOrNone) {
  SlamRun none(isolated(), Svar());
  EXPECT_EQ(none.slam().map(), nullptr);
  SlamRun some(isolated(), Svar::object({{"has_map", true}}));
  EXPECT_NE(some.slam().map(), nullptr);
}

TEST_F(Isolation, FramesThatAreKeptStayAsTheyAre) {
  IsolatedSlam slam(optionsOf());
  gslam::SlamSetup setup;
  setup.parameters = Svar::object({{"keep", 50}});
  slam.configure(setup);
  for (std::uint64_t id = 0; id < 120; ++id) slam.feed(toyFrame(id, 1 + int(id * 7) % 20));
  slam.finish();  // compares them
  EXPECT_LT(slam.sharedBytes(), std::uint64_t(120) * 20 * 20 * 31 * 17);
}

TEST_F(Isolation, ReusesItsMemory) {
  IsolatedSlam slam(optionsOf());
  slam.configure({});
  slam.feed(toyFrame(0, 10));
  const std::uint64_t first = slam.sharedBytes();
  for (std::uint64_t id = 1; id < 100; ++id) slam.feed(toyFrame(id, 10));
  EXPECT_EQ(slam.sharedBytes(), first);
}

TEST_F(Isolation, AThousandFramesLeakNothing) {
  IsolatedSlam slam(optionsOf());
  slam.configure({});
  long before = 0;
  int files = 0;
  for (std::uint64_t id = 0; id < 1000; ++id) {
    slam.feed(toyFrame(id));
    if (id == 200) {
      before = residentBytes();
      files = openFiles();
    }
  }
  EXPECT_EQ(openFiles(), files);
  if (!isSanitized()) {
    EXPECT_LE(residentBytes() - before, 256 << 10);
  }
}

TEST_F(Isolation, LeavesNothingBehind) {
  const int files = openFiles();
  for (int i = 0; i < 10; ++i) {
    IsolatedSlam slam(optionsOf());
    slam.configure({});
    slam.feed(toyFrame(1));
  }
  EXPECT_EQ(openFiles(), files);
  EXPECT_FALSE(hasChildren());
}

TEST_F(Isolation, EndsWhatHangsOrCrashesInTheDestructor) {
  std::vector<std::string> records;
  gslam::setLogSink([&](const gslam::LogRecord& record) { records.push_back(record.message); },
                    gslam::LogLevel::warning);
  for (const std::string how : {"hang", "abort"}) {
    IsolationOptions options = optionsOf();
    options.end_limit = milliseconds(3000);
    SlamRun run(isolated(options), misbehaving(how, "destructor"));
    run.slam().feed(toyFrame(1));
  }
  gslam::setLogSink(nullptr);
  EXPECT_FALSE(hasChildren());
  ASSERT_EQ(records.size(), 2u);
  EXPECT_THAT(records[0], HasSubstr("within 3000 ms"));
  EXPECT_THAT(records[1], HasSubstr("SIGABRT"));
}

TEST_F(Isolation, LogsIntoTheProgramsLog) {
  std::vector<std::string> records;
  gslam::setLogSink([&](const gslam::LogRecord& record) {
    records.push_back(std::string(record.file) + " " + record.message);
  });
  SlamRun run(isolated(), Svar());
  gslam::setLogSink(nullptr);
  ASSERT_EQ(records.size(), 1u);
  EXPECT_THAT(records[0], AllOf(HasSubstr("toy.cpp"), HasSubstr("the toy is configured")));
}

TEST_F(Isolation, LimitsMemory) {
  if (isSanitized()) GTEST_SKIP() << "sanitizers need all addresses";
  IsolationOptions options = optionsOf();
  options.most_memory = std::uint64_t(1) << 30;
  SlamRun run(isolated(options), misbehaving("memory"));
  try {
    run.slam().feed(toyFrame(1));
    ADD_FAILURE();
  } catch (const gslam::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("bad_alloc"));
  }
}

TEST_F(Isolation, WorksInManyThreadsAtOnce) {
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([t] {
      SlamRun run(isolated(), misbehaving(t % 2 == 0 ? "" : "abort", "feed", 20));
      try {
        for (std::uint64_t id = 0; id < 30; ++id) run.slam().feed(toyFrame(id));
        EXPECT_EQ(t % 2, 0);
        EXPECT_EQ(run.poses().size(), 30u);
      } catch (const IsolationError& error) {
        EXPECT_EQ(t % 2, 1);
        EXPECT_EQ(error.failure().last_frame, 20u);
        EXPECT_EQ(error.failure().number, SIGABRT);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_FALSE(hasChildren());
}

TEST_F(Isolation, OutlivesTheThreadThatBeganIt) {
  std::unique_ptr<gslam::Slam> slam;
  std::thread([&] { slam = isolated(); }).join();
  std::this_thread::sleep_for(milliseconds(50));
  SlamRun run(std::move(slam), Svar());
  run.slam().feed(toyFrame(1));
  EXPECT_EQ(run.poses().size(), 1u);
}

TEST_F(Isolation, WorksWhereChildrenAreReapedUnseen) {
  struct sigaction ignore = {}, before = {};
  ignore.sa_handler = SIG_IGN;
  ::sigaction(SIGCHLD, &ignore, &before);
  {
    SlamRun run(isolated(), misbehaving("abort"));
    run.slam().feed(toyFrame(0));
    try {
      run.slam().feed(toyFrame(1));
      ADD_FAILURE();
    } catch (const IsolationError& error) {
      EXPECT_EQ(error.failure().kind, Kind::lost);
    }
  }
  ::sigaction(SIGCHLD, &before, nullptr);
}

TEST_F(Isolation, FactoriesCanBeMadeIsolated) {
  gslam::Plugins plugins;
  const gslam::SlamFactory toy = plugins.slam(optionsOf().slam);
  const gslam::SlamFactory factory = gslam::isolatedFactory(toy, optionsOf());
  EXPECT_EQ(factory.name, "toy");
  EXPECT_TRUE(factory.needs.imu);
  SlamRun run(factory.make(), Svar());
  run.slam().feed(toyFrame(1));
  EXPECT_EQ(run.poses().size(), 1u);
}

TEST_F(Isolation, AProgramIsItsOwnWorkerByDefault) {
  const std::string command =
      std::string(GSLAM_TEST_WORKER) + " " + GSLAM_TEST_PLUGIN_TOY + " > /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(Isolation, AWorkerThatSomebodyTypedEndsAtOnce) {
  const std::string command = std::string(GSLAM_TEST_WORKER) + " --gslam-isolation-worker";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
}

TEST_F(Isolation, TheChildEndsWithItsParent) {
  const std::string command = std::string("exec ") + GSLAM_TEST_WORKER + " " +
                              GSLAM_TEST_PLUGIN_TOY + " hang & echo $!; wait 2> /dev/null";
  FILE* const output = ::popen(command.c_str(), "r");
  ASSERT_NE(output, nullptr);
  int parent = 0, child = 0;
  ASSERT_EQ(std::fscanf(output, "%d %d", &parent, &child), 2);
  std::this_thread::sleep_for(milliseconds(100));
  EXPECT_EQ(::kill(child, 0), 0);
  EXPECT_EQ(::kill(parent, SIGKILL), 0);
  // Until init has reaped it, it is a zombie, which has no memory.
  const auto isGone = [child] {
    std::string line;
    std::ifstream facts("/proc/" + std::to_string(child) + "/stat");
    return !std::getline(facts, line) || line.find(") Z") != std::string::npos;
  };
  for (int i = 0; i < 100 && !isGone(); ++i) std::this_thread::sleep_for(milliseconds(50));
  EXPECT_TRUE(isGone());
  ::pclose(output);
}

}  // namespace
#endif  // GSLAM_DETAIL_HAS_ISOLATION
