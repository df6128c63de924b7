#include <gslam/base/error.h>
#include <gslam/evaluation/resource_monitor.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "machine_use.h"

#if defined(__linux__)
#include <time.h>
#endif

namespace gslam {
inline namespace v1 {
namespace {

using Seconds = std::chrono::duration<double>;

// CPU that the calling thread has used, seconds.
double threadSeconds() {
#if defined(__linux__)
  timespec time = {};
  if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) == 0) {
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }
#endif
  return 0;
}

void check(const std::shared_ptr<ProcessTree>& tree, const MonitorOptions& options) {
  if (!tree) throw ArgumentError("tree", "is null, expected processes to watch");
  if (options.period.count() < 1) {
    throw ArgumentError(
        "period", "is " + std::to_string(options.period.count()) + " ms, expected 1 ms or more");
  }
  if (!(options.most_overhead > 0 && options.most_overhead <= 1)) {
    throw ArgumentError("most_overhead", "is " + std::to_string(options.most_overhead) +
                                             ", expected above 0 and up to 1");
  }
  if (options.most_samples < 2) {
    throw ArgumentError("most_samples",
                        "is " + std::to_string(options.most_samples) + ", expected 2 or more");
  }
}

}  // namespace

class ResourceMonitor::Impl {
 public:
  Impl(std::shared_ptr<ProcessTree> tree, const MonitorOptions& options)
      : tree_(std::move(tree)),
        options_(options),
        gpus_(options.sys, options.nvml),
        cores_(options.proc),
        rapl_(options.sys),
        begin_(tree_->read()),
        last_(begin_) {
    // Only the thread's own work is left from here on.
    keep({0, begin_.rss_bytes, 0, begin_.threads, begin_.processes});
    note(begin_);
    thread_ = std::thread([this] { work(); });
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() { end(); }

  ResourceReport report() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_ended_) sampleAll();
    return result();
  }

  ResourceReport stop() {
    end();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_ended_) sampleAll();
    is_ended_ = true;
    return result();
  }

 private:
  void end() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_ending_ = true;
    }
    changed_.notify_all();
    const std::lock_guard<std::mutex> lock(join_mutex_);
    if (thread_.joinable()) thread_.join();
  }

  void work() {
    std::unique_lock<std::mutex> lock(mutex_);
    constexpr Seconds kMost = std::chrono::hours(24);  // time + pause must not overflow
    Seconds pause = std::min<Seconds>(options_.period, kMost);
    while (!changed_.wait_for(lock, pause, [this] { return is_ending_; })) {
      const double before = cpu_seconds_;
      sample();
      // Each sample pays for itself by the pause behind it.
      const Seconds earned((cpu_seconds_ - before) / options_.most_overhead);
      pause = std::min(std::max<Seconds>(options_.period, earned), kMost);
    }
  }

  void sample() {
    const double before = threadSeconds();
    const ProcessUsage usage = tree_->read();
    const double seconds = 1e-9 * double(usage.time - last_.time);
    ResourceSample sample;
    sample.time = 1e-9 * double(usage.time - begin_.time);
    sample.rss_bytes = usage.rss_bytes;
    sample.threads = usage.threads;
    sample.processes = usage.processes;
    if (seconds > 0) {
      sample.cpu_percent = 100 * (usage.cpu_seconds - last_.cpu_seconds) / seconds;
    }
    // Of children that ended the system tells ticks, which are too coarse for a moment.
    if (seconds >= 0.5 * Seconds(options_.period).count()) {
      result_.peak_cpu_percent = std::max(result_.peak_cpu_percent, sample.cpu_percent);
    }
    keep(sample);
    note(usage);
    rapl_.sample();
    if (sample.time >= next_gpu_) {
      gpus_.sample();
      next_gpu_ = sample.time + 0.2;
    }
    cpu_seconds_ += threadSeconds() - before;
  }

  // With what is only wanted in reports.
  void sampleAll() {
    sample();
    core_percent_ = cores_.read();
  }

  // Bounded: when there are too many, every other one goes, and so do as many of those to come.
  void keep(const ResourceSample& sample) {
    if (result_.samples_taken++ % stride_ != 0) return;
    if (result_.samples.size() >= options_.most_samples) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < result_.samples.size(); i += 2) {
        result_.samples[kept++] = result_.samples[i];
      }
      result_.samples.resize(kept);
      stride_ *= 2;
      if ((result_.samples_taken - 1) % stride_ != 0) return;
    }
    result_.samples.push_back(sample);
  }

  void note(const ProcessUsage& usage) {
    last_ = usage;
    // A process that is about to end has none any more, but still lives.
    if (usage.rss_bytes > 0) result_.rss_bytes = usage.rss_bytes;
    result_.peak_rss_bytes = usage.peak_rss_bytes;
    result_.peak_sampled_rss_bytes = std::max(result_.peak_sampled_rss_bytes, usage.rss_bytes);
    result_.peak_pss_bytes = std::max(result_.peak_pss_bytes, usage.pss_bytes);
    result_.most_threads = std::max(result_.most_threads, usage.threads);
    result_.most_processes = std::max(result_.most_processes, usage.processes);
  }

  ResourceReport result() {
    ResourceReport report = result_;
    report.used = usedBetween(begin_, last_);
    report.seconds = 1e-9 * double(last_.time - begin_.time);
    if (report.seconds > 0) {
      report.cpu_percent = 100 * report.used.cpu_seconds / report.seconds;
      report.overhead_percent = 100 * cpu_seconds_ / report.seconds;
    }
    report.monitor_cpu_seconds = cpu_seconds_;
    report.core_percent = core_percent_;
    report.energy = rapl_.report();
    report.gpu = gpus_.report();
    return report;
  }

  const std::shared_ptr<ProcessTree> tree_;
  const MonitorOptions options_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_ending_ = false;
  bool is_ended_ = false;
  detail::Gpus gpus_;  // first, since to start NVML may take a second
  detail::CoreLoads cores_;
  detail::Rapl rapl_;
  const ProcessUsage begin_;
  ProcessUsage last_;
  ResourceReport result_;
  std::vector<double> core_percent_;
  double cpu_seconds_ = 0;
  double next_gpu_ = 0;
  std::size_t stride_ = 1;
  std::mutex join_mutex_;
  std::thread thread_;
};

ResourceMonitor::ResourceMonitor(std::shared_ptr<ProcessTree> tree, const MonitorOptions& options) {
  check(tree, options);
  impl_.reset(new Impl(std::move(tree), options));
}
ResourceMonitor::~ResourceMonitor() = default;
ResourceReport ResourceMonitor::report() {
  return impl_->report();
}
ResourceReport ResourceMonitor::stop() {
  return impl_->stop();
}

}  // namespace v1
}  // namespace gslam
