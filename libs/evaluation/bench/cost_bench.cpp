// What measuring costs: a malloc() that counts beside glibc's own, readings of /proc, a frame that
// is measured, and the monitor with its usual period.
#include <benchmark/benchmark.h>
#include <gslam/evaluation/allocation_counts.h>
#include <gslam/evaluation/frame_times.h>
#include <gslam/evaluation/process_usage.h>
#include <gslam/evaluation/resource_monitor.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#if defined(__linux__) && defined(__GLIBC__)
extern "C" {
// NOLINTNEXTLINE(readability-identifier-naming,bugprone-reserved-identifier)
void* __libc_malloc(std::size_t);
// NOLINTNEXTLINE(readability-identifier-naming,bugprone-reserved-identifier)
void __libc_free(void*);
}
#define HAS_GLIBC 1
#endif

namespace {

// Threads that wait, as those of a program with pools do.
class WaitingThreads {
 public:
  explicit WaitingThreads(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
      threads_.emplace_back([this] {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait(lock, [this] { return is_over_; });
      });
    }
  }
  WaitingThreads(const WaitingThreads&) = delete;
  WaitingThreads& operator=(const WaitingThreads&) = delete;
  ~WaitingThreads() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_over_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_over_ = false;
  std::vector<std::thread> threads_;
};

void counted(benchmark::State& state) {
  const std::size_t size = std::size_t(state.range(0));
  for (auto _ : state) {
    void* block = std::malloc(size);
    benchmark::DoNotOptimize(block);
    std::free(block);
  }
}
BENCHMARK(counted)->Name("malloc_free/counted")->Arg(16)->Arg(1000)->Arg(100000)->ThreadRange(1, 2);

#if defined(HAS_GLIBC)
void plain(benchmark::State& state) {
  const std::size_t size = std::size_t(state.range(0));
  for (auto _ : state) {
    void* block = __libc_malloc(size);
    benchmark::DoNotOptimize(block);
    __libc_free(block);
  }
}
BENCHMARK(plain)->Name("malloc_free/glibc")->Arg(16)->Arg(1000)->Arg(100000)->ThreadRange(1, 2);
#endif

void readCounts(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(gslam::allocationCountsOf(0).calls);
}
BENCHMARK(readCounts)->Name("read/allocations");

void readTree(benchmark::State& state) {
  const WaitingThreads threads(state.range(0));
  gslam::ProcessTree tree;
  for (auto _ : state) benchmark::DoNotOptimize(tree.read().rss_bytes);
}
BENCHMARK(readTree)->Name("read/process_of_threads")->Arg(1)->Arg(32);

void readClock(benchmark::State& state) {
  gslam::ProcessTree tree;
  for (auto _ : state) benchmark::DoNotOptimize(tree.cpuTime());
}
BENCHMARK(readClock)->Name("read/cpu_time");

class IdleSlam : public gslam::Slam {
 public:
  void configure(const gslam::SlamSetup& setup) override {
    pose_ = setup.messenger.advertise<gslam::TrackedPose>("pose");
  }
  void feed(const std::shared_ptr<const gslam::Frame>& frame) override {
    pose_.publish({frame->id, frame->stamp, gslam::SE3d(), gslam::TrackingState::tracking});
  }
  std::shared_ptr<const gslam::Map> map() override { return nullptr; }
  void finish() override {}

 private:
  gslam::Publisher<gslam::TrackedPose> pose_;
};

void feed(benchmark::State& state, gslam::Slam& slam) {
  slam.configure({});
  const auto frame = std::make_shared<gslam::Frame>();
  for (auto _ : state) {
    ++frame->id;
    slam.feed(frame);
  }
}
void feedPlain(benchmark::State& state) {
  IdleSlam slam;
  feed(state, slam);
}
void feedMeasured(benchmark::State& state) {
  gslam::MeasuredSlam slam(std::make_shared<IdleSlam>());
  feed(state, slam);
}
BENCHMARK(feedPlain)->Name("feed/plain")->Iterations(200000);
BENCHMARK(feedMeasured)->Name("feed/measured")->Iterations(200000);

// Of a process that waits for two seconds: all that it uses is the monitor.
void monitor(benchmark::State& state) {
  const WaitingThreads threads(state.range(0));
  gslam::MonitorOptions options;
  options.period = std::chrono::milliseconds(state.range(1));
  gslam::ResourceReport report;
  for (auto _ : state) {
    gslam::ResourceMonitor watching(std::make_shared<gslam::ProcessTree>(), options);
    std::this_thread::sleep_for(std::chrono::seconds(2));
    report = watching.stop();
  }
  state.counters["overhead_percent"] = report.overhead_percent;
  state.counters["process_percent"] = report.cpu_percent;
  state.counters["samples"] = double(report.samples_taken);
}
BENCHMARK(monitor)
    ->Name("monitor/threads_period")
    ->Args({1, 50})
    ->Args({32, 50})
    ->Args({32, 5})
    ->Iterations(1)
    ->UseRealTime();

}  // namespace
