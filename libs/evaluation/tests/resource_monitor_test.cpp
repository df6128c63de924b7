#include <gslam/base/error.h>
#include <gslam/evaluation/resource_monitor.h>
#include <gtest/gtest.h>
#include <time.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <thread>
#include <utility>

#include "fake_files.h"
#include "spender_child.h"

namespace {

using gslam::MonitorOptions;
using gslam::ProcessTree;
using gslam::ResourceMonitor;
using gslam::ResourceReport;

std::shared_ptr<ProcessTree> sharedTree(long root) {
  gslam::ProcessTreeOptions options;
  options.root = root;
  return std::make_shared<ProcessTree>(options);
}

MonitorOptions quick() {
  MonitorOptions options;
  options.period = std::chrono::milliseconds(5);
  options.most_overhead = 1;
  return options;
}

void sleepFor(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST(ResourceMonitor, refusesNonsense) {
  const auto tree = std::make_shared<ProcessTree>();
  EXPECT_THROW(ResourceMonitor(nullptr), gslam::ArgumentError);
  for (const int period : {0, -1}) {
    MonitorOptions options;
    options.period = std::chrono::milliseconds(period);
    EXPECT_THROW(ResourceMonitor(tree, options), gslam::ArgumentError);
  }
  for (const double overhead : {0.0, -1.0, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    MonitorOptions options;
    options.most_overhead = overhead;
    EXPECT_THROW(ResourceMonitor(tree, options), gslam::ArgumentError);
  }
  MonitorOptions options;
  options.most_samples = 1;
  EXPECT_THROW(ResourceMonitor(tree, options), gslam::ArgumentError);
}

TEST(ResourceMonitor, measuresAProgramOfKnownCost) {
  spender::Child child({"burn", "0.5", "2"});
  const auto tree = sharedTree(child.number());
  ResourceMonitor monitor(tree, quick());
  child.go();
  EXPECT_EQ(child.line(), "done");
  const ResourceReport report = monitor.stop();
  EXPECT_NEAR(report.used.cpu_seconds, 1.0, 0.1);
  EXPECT_NEAR(report.cpu_percent, 100 * report.used.cpu_seconds / report.seconds, 1e-6);
  EXPECT_LE(report.cpu_percent, 210);
  EXPECT_GE(report.peak_cpu_percent, report.cpu_percent - 1);
  EXPECT_GE(report.most_threads, 3u);
  EXPECT_LE(report.most_threads, 3u + spender::kOtherThreads);
  EXPECT_EQ(report.most_processes, 1u);
  EXPECT_GT(report.samples_taken, 10u);
  EXPECT_EQ(report.samples.size(), report.samples_taken);
  EXPECT_GT(report.rss_bytes, 100000u);
  EXPECT_GE(report.peak_rss_bytes, report.peak_sampled_rss_bytes);
  // Two threads burned on the machine's cores.
  ASSERT_EQ(report.core_percent.empty(), false);
  double load = 0;
  for (const double percent : report.core_percent) {
    EXPECT_GE(percent, 0);
    EXPECT_LE(percent, 100);
    load += percent;
  }
  EXPECT_GE(load, 0.5 * report.cpu_percent);
}

TEST(ResourceMonitor, seesAPeakThatIsOver) {
  spender::Child child({"touch", "100"});
  const auto tree = sharedTree(child.number());
  ResourceMonitor monitor(tree, quick());
  child.go();
  child.line();
  sleepFor(100);
  child.go();
  EXPECT_EQ(child.line(), "done");
  const ResourceReport report = monitor.stop();
  EXPECT_GE(report.peak_sampled_rss_bytes, 100000000u);
  EXPECT_GE(report.peak_rss_bytes, 100000000u);
  if (spender::canCount()) {  // a sanitizer gives nothing back
    EXPECT_LE(report.rss_bytes, 50000000u);
  }
  for (std::size_t i = 1; i < report.samples.size(); ++i) {
    EXPECT_GT(report.samples[i].time, report.samples[i - 1].time);
  }
}

TEST(ResourceMonitor, keepsTheSamplesBounded) {
  for (const std::size_t most : {2u, 3u, 8u}) {
    MonitorOptions options = quick();
    options.period = std::chrono::milliseconds(1);
    options.most_samples = most;
    ResourceMonitor monitor(std::make_shared<ProcessTree>(), options);
    for (int i = 0; i < 300; ++i) monitor.report();
    const ResourceReport report = monitor.stop();
    EXPECT_GE(report.samples_taken, 300u);
    EXPECT_LE(report.samples.size(), most);
    EXPECT_GE(report.samples.size(), most / 2);
    EXPECT_EQ(report.samples[0].time, 0);
    // They cover the time, not only its begin.
    EXPECT_GT(report.samples.back().time, 0.2 * report.seconds);
  }
}

// Whatever the period, samples take no more than they may.
TEST(ResourceMonitor, keepsItsOverhead) {
  MonitorOptions options;
  options.period = std::chrono::milliseconds(1);
  options.most_overhead = 0.005;
  ResourceMonitor monitor(std::make_shared<ProcessTree>(), options);
  timespec before = {}, after = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
  sleepFor(1500);
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
  const ResourceReport report = monitor.stop();
  const double used =
      double(after.tv_sec - before.tv_sec) + 1e-9 * double(after.tv_nsec - before.tv_nsec);
  EXPECT_GT(report.samples_taken, 3u);
  EXPECT_LE(report.overhead_percent, 1.0);
  EXPECT_GT(report.overhead_percent, 0);
  EXPECT_NEAR(report.overhead_percent, 100 * report.monitor_cpu_seconds / report.seconds, 1e-9);
  // What it says of itself is what the process used, which did nothing else.
  EXPECT_LE(used, 0.015 + report.monitor_cpu_seconds);
}

// "Never" is a period, too: once the end of the wait was out of range, and a core was busy.
TEST(ResourceMonitor, takesPeriodsOfAnyLength) {
  for (const auto& often : {std::pair<long long, double>{INT64_MAX, 0.005},
                            {INT64_MAX / 1000000 + 1, 0.005},
                            {1, 1e-18},
                            {1, std::numeric_limits<double>::min()}}) {
    MonitorOptions options;
    options.period = std::chrono::milliseconds(often.first);
    options.most_overhead = often.second;
    ResourceMonitor monitor(std::make_shared<ProcessTree>(), options);
    sleepFor(50);
    EXPECT_LE(monitor.stop().samples_taken, 3u);  // at the begin, at the end, and one of 1 ms
  }
}

TEST(ResourceMonitor, stopsOnceAndStaysStopped) {
  ResourceMonitor monitor(std::make_shared<ProcessTree>(), quick());
  sleepFor(20);
  const ResourceReport first = monitor.stop();
  sleepFor(20);
  const ResourceReport second = monitor.stop();
  const ResourceReport third = monitor.report();
  EXPECT_EQ(first.samples_taken, second.samples_taken);
  EXPECT_EQ(first.seconds, second.seconds);
  EXPECT_EQ(first.core_percent, third.core_percent);
  EXPECT_EQ(first.samples_taken, third.samples_taken);
}

TEST(ResourceMonitor, isForThreads) {
  const auto tree = std::make_shared<ProcessTree>();
  MonitorOptions options = quick();
  options.period = std::chrono::milliseconds(1);
  ResourceMonitor monitor(tree, options);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 20; ++k) {
        monitor.report();
        tree->read();
        tree->cpuTime();
      }
      if (i == 0) monitor.stop();
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(monitor.stop().samples_taken, 20u);
}

TEST(ResourceMonitor, outlivesTheProcess) {
  spender::Child child({"burn", "0.05", "1"});
  ResourceMonitor monitor(sharedTree(child.number()), quick());
  child.go();
  child.line();
  sleepFor(30);
  child.end();
  sleepFor(30);
  const ResourceReport report = monitor.stop();
  EXPECT_GT(report.rss_bytes, 0u);
  EXPECT_NEAR(report.used.cpu_seconds, 0.05, 0.03);
  EXPECT_EQ(report.samples.back().processes, 0u);
}

// /sys with packages of 300 J that count to 300000000 uJ.
class FakeMachine : public FakeFiles {
 public:
  void putZone(const std::string& zone, const std::string& name, const std::string& energy) const {
    const std::string folder = "class/powercap/" + zone;
    write(folder + "/name", name + "\n");
    write(folder + "/energy_uj", energy);
    write(folder + "/max_energy_range_uj", "300000000\n");
  }
  MonitorOptions options() const {
    MonitorOptions options;
    options.period = std::chrono::milliseconds(3600000);  // only what report() takes
    options.sys = root();
    options.nvml = "no_such_library.so.1";
    return options;
  }
};

TEST(ResourceMonitor, addsUpEnergy) {
  const FakeMachine machine;
  machine.putZone("intel-rapl:0", "package-0", "1000000\n");
  machine.putZone("intel-rapl:0:0", "core", "500\n");
  machine.putZone("intel-rapl:0:1", "dram", "100\n");
  machine.putZone("intel-rapl:1", "package-1", "299000000\n");
  machine.putZone("intel-rapl:2", "psys", "7\n");
  machine.putZone("intel-rapl-mmio:0", "package-0", "1000000\n");
  ResourceMonitor monitor(std::make_shared<ProcessTree>(), machine.options());
  machine.putZone("intel-rapl:0", "package-0", "3000000\n");
  machine.putZone("intel-rapl:0:0", "core", "900000\n");
  machine.putZone("intel-rapl:0:1", "dram", "500100\n");
  machine.putZone("intel-rapl:1", "package-1", "2000000\n");  // it began again
  machine.putZone("intel-rapl:2", "psys", "70000000\n");
  const gslam::EnergyReport first = monitor.report().energy;
  EXPECT_EQ(first.why_not, "");
  EXPECT_NEAR(first.package_joules, 2 + 3, 1e-9);
  EXPECT_TRUE(first.has_dram);
  EXPECT_NEAR(first.dram_joules, 0.5, 1e-9);
  machine.putZone("intel-rapl:1", "package-1", "1000000\n");  // and again
  EXPECT_NEAR(monitor.stop().energy.package_joules, 5 + 299, 1e-9);
}

// Memory whose energy cannot be read leaves that of the packages.
TEST(ResourceMonitor, tellsPackagesWithoutMemory) {
  const FakeMachine machine;
  machine.putZone("intel-rapl:0", "package-0", "1000000\n");
  machine.putZone("intel-rapl:0:0", "dram", "5\n");
  machine.write("class/powercap/intel-rapl:1:0/name", "dram\n");  // no counter
  ResourceMonitor monitor(std::make_shared<ProcessTree>(), machine.options());
  machine.putZone("intel-rapl:0", "package-0", "3000000\n");
  const gslam::EnergyReport energy = monitor.stop().energy;
  EXPECT_EQ(energy.why_not, "");
  EXPECT_NEAR(energy.package_joules, 2, 1e-9);
  EXPECT_FALSE(energy.has_dram);  // half of it would be wrong
}

// To start NVML takes long; what the machine uses meanwhile is not the run's.
TEST(ResourceMonitor, beginsWithEnergyLast) {
  const FakeMachine machine;
  machine.putZone("intel-rapl:0", "package-0", "1000000\n");
  MonitorOptions options = machine.options();
  options.nvml = GSLAM_TEST_NVML;
  const std::string counter = machine.root() + "/class/powercap/intel-rapl:0/energy_uj";
  setenv("GSLAM_TEST_NVML_USES_ENERGY", counter.c_str(), 1);
  ResourceMonitor monitor(std::make_shared<ProcessTree>(), options);
  unsetenv("GSLAM_TEST_NVML_USES_ENERGY");
  EXPECT_EQ(machine.read("class/powercap/intel-rapl:0/energy_uj"), "150000000\n");
  machine.putZone("intel-rapl:0", "package-0", "152000000\n");
  EXPECT_NEAR(monitor.stop().energy.package_joules, 2, 1e-9);
}

TEST(ResourceMonitor, saysWhyThereIsNoEnergy) {
  const auto tree = std::make_shared<ProcessTree>();
  {
    const FakeMachine machine;
    ResourceMonitor monitor(tree, machine.options());
    EXPECT_NE(monitor.stop().energy.why_not.find("no RAPL"), std::string::npos);
  }
  {
    const FakeMachine machine;
    machine.putZone("intel-rapl:0", "package-0", "many\n");
    ResourceMonitor monitor(tree, machine.options());
    EXPECT_NE(monitor.stop().energy.why_not.find("is no number"), std::string::npos);
  }
  {
    const FakeMachine machine;
    machine.write("class/powercap/intel-rapl:0/name", "package-0\n");
    ResourceMonitor monitor(tree, machine.options());
    EXPECT_NE(monitor.stop().energy.why_not.find("cannot be read"), std::string::npos);
  }
  {
    const FakeMachine machine;
    machine.putZone("intel-rapl:0", "package-0", "5\n");
    ResourceMonitor monitor(tree, machine.options());
    machine.remove("class/powercap");
    EXPECT_NE(monitor.stop().energy.why_not.find("any more"), std::string::npos);
  }
}

TEST(ResourceMonitor, readsGpusOfTheSystem) {
  const FakeMachine machine;
  machine.write("class/drm/card0/device/vendor", "0x8086\n");  // tells no load
  machine.write("class/drm/card1/device/gpu_busy_percent", "40\n");
  machine.write("class/drm/card1/device/mem_info_vram_used", "1000000\n");
  machine.write("class/drm/card1-DP-1/device/gpu_busy_percent", "99\n");  // an output
  ResourceMonitor monitor(std::make_shared<ProcessTree>(), machine.options());
  monitor.report();
  sleepFor(210);
  machine.write("class/drm/card1/device/gpu_busy_percent", "60\n");
  machine.write("class/drm/card1/device/mem_info_vram_used", "900000\n");
  const gslam::GpuReport gpu = monitor.stop().gpu;
  EXPECT_EQ(gpu.why_not, "");
  EXPECT_EQ(gpu.gpus, 1u);
  EXPECT_NEAR(gpu.mean_percent, 50, 1e-9);
  EXPECT_EQ(gpu.highest_percent, 60);
  EXPECT_TRUE(gpu.has_memory);
  EXPECT_EQ(gpu.peak_memory_bytes, 1000000u);
}

TEST(ResourceMonitor, asksTheLibraryOfNvidia) {
  const FakeMachine machine;
  MonitorOptions options = machine.options();
  options.nvml = GSLAM_TEST_NVML;
  ResourceMonitor monitor(std::make_shared<ProcessTree>(), options);
  const gslam::GpuReport gpu = monitor.stop().gpu;
  EXPECT_EQ(gpu.why_not, "");
  EXPECT_EQ(gpu.gpus, 2u);
  EXPECT_NEAR(gpu.mean_percent, 50, 1e-9);
  EXPECT_EQ(gpu.highest_percent, 80);
  EXPECT_EQ(gpu.peak_memory_bytes, 3000000000u);
}

TEST(ResourceMonitor, saysWhyThereIsNoGpu) {
  const FakeMachine machine;
  MonitorOptions options = machine.options();
  ResourceMonitor monitor(std::make_shared<ProcessTree>(), options);
  EXPECT_NE(monitor.stop().gpu.why_not.find("no_such_library"), std::string::npos);
  options.nvml = "libm.so.6";  // a library, but not that
  ResourceMonitor other(std::make_shared<ProcessTree>(), options);
  EXPECT_NE(other.stop().gpu.why_not.find("lacks"), std::string::npos);
}

TEST(ResourceMonitor, readsTheLoadOfCores) {
  const FakeMachine machine;
  MonitorOptions options = machine.options();
  options.proc = machine.root();
  machine.write("stat",
                "cpu  9 9 9 9\ncpu0 100 0 0 100 0 0 0 0 0 0\ncpu2 50 0 0 50 0 0 0 0\nintr 5\n");
  ResourceMonitor monitor(std::make_shared<ProcessTree>(), options);
  // cpu0: 10 user, 10 system, 20 idle, 10 iowait; cpu2: backwards; cpu3 was off until now.
  machine.write(
      "stat", "intr 5\ncpu0 110 0 10 120 10 0 0 0 0 0\ncpu2 40 0 0 50 0 0 0 0\ncpu3 5 0 0 0\ncpu9");
  const std::vector<double> cores = monitor.stop().core_percent;
  ASSERT_EQ(cores.size(), 10u);  // the last line is cut off: a core without figures
  EXPECT_NEAR(cores[0], 40, 1e-9);
  EXPECT_EQ(cores[1], 0);
  EXPECT_EQ(cores[2], 0);
  EXPECT_EQ(cores[3], 0);
}

}  // namespace
