#ifndef GSLAM_EVALUATION_RESOURCE_MONITOR_H
#define GSLAM_EVALUATION_RESOURCE_MONITOR_H

#include <gslam/evaluation/export.h>
#include <gslam/evaluation/process_usage.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// @file
/// What a run uses while it runs: memory, CPU, energy, GPU.
///
///     auto tree = std::make_shared<gslam::ProcessTree>();
///     gslam::ResourceMonitor monitor(tree);
///     ...                                           // the run
///     const gslam::ResourceReport report = monitor.stop();

namespace gslam {
inline namespace v1 {

/// How ResourceMonitor samples.
struct MonitorOptions {
  /// Between two samples. It becomes longer where they would take more than `most_overhead`; a day
  /// at most.
  std::chrono::milliseconds period{50};
  double most_overhead = 0.005;     ///< of one core, for all samples together but the last and
                                    ///< those that report() takes
  std::size_t most_samples = 4096;  ///< that are kept; when as many are there, every other one goes
  std::string proc = "/proc";       ///< of the load of cores
  std::string nvml = "libnvidia-ml.so.1";  ///< NVIDIA's library, of GPUs; loaded where there is one
  std::string sys = "/sys";                ///< of energy and GPUs
};

/// What was used around one time.
struct ResourceSample {
  double time = 0;              ///< since the begin, seconds
  std::uint64_t rss_bytes = 0;  ///< as ProcessUsage
  double cpu_percent = 0;       ///< since the sample before; 100 is one core
  std::size_t threads = 0;      ///< as ProcessUsage
  std::size_t processes = 0;    ///< as ProcessUsage
};

/// Energy of the whole machine's processors, whoever used them.
struct EnergyReport {
  std::string why_not;        ///< why it is not known; empty where it is
  double package_joules = 0;  ///< all processor packages; RAPL
  bool has_dram = false;      ///< whether that of memory is known
  double dram_joules = 0;     ///< memory that RAPL tells of
};

/// GPUs of the whole machine, whoever used them.
struct GpuReport {
  std::string why_not;                  ///< why nothing is known; empty where something is
  std::size_t gpus = 0;                 ///< whose load is known
  double mean_percent = 0;              ///< of these together, over all samples
  double highest_percent = 0;           ///< of one of them in one sample
  bool has_memory = false;              ///< whether that is known
  std::uint64_t peak_memory_bytes = 0;  ///< most of all together, bytes
};

/// What was used from the begin of a monitor to its end.
///
/// Thread-safety: plain data.
struct ResourceReport {
  double seconds = 0;                ///< from the begin to the end
  ProcessUsage used;                 ///< usedBetween() begin and end
  std::uint64_t rss_bytes = 0;       ///< in the last sample with a living process
  std::uint64_t peak_rss_bytes = 0;  ///< ProcessUsage::peak_rss_bytes at the end
  std::uint64_t peak_sampled_rss_bytes =
      0;                             ///< most of all samples: since the begin of the monitor
  std::uint64_t peak_pss_bytes = 0;  ///< most of all samples; 0: not asked for
  double cpu_percent = 0;            ///< over all the time; 100 is one core
  double peak_cpu_percent = 0;       ///< most between two samples
  std::size_t most_threads = 0;      ///< of all samples
  std::size_t most_processes = 0;    ///< of all samples
  /// Load of each core of the machine, 0 to 100, whoever made it; by the numbers of cores. A core
  /// that was off has 0. Empty where /proc/stat does not tell.
  std::vector<double> core_percent;
  EnergyReport energy;                  ///< of the machine
  GpuReport gpu;                        ///< of the machine
  std::size_t samples_taken = 0;        ///< all
  double monitor_cpu_seconds = 0;       ///< CPU that sampling took
  double overhead_percent = 0;          ///< of one core: 100 * monitor_cpu_seconds / seconds
  std::vector<ResourceSample> samples;  ///< by time; not more than MonitorOptions::most_samples
};

/// Samples a tree of processes in a thread of its own.
///
/// Where the tree is this process's own, the monitor is part of what it measures;
/// ResourceReport::monitor_cpu_seconds says how much.
///
/// All members are thread-safe. Linux only: elsewhere there is no ProcessTree to give it.
class GSLAM_EVALUATION_EXPORT ResourceMonitor {
 public:
  /// Begins.
  /// @param tree     not null; may be read by others meanwhile
  /// @param options  as said there
  /// @throws ArgumentError for null, a period below 1 ms, an overhead that is not above 0 and up to
  ///   1, or fewer than 2 samples
  explicit ResourceMonitor(std::shared_ptr<ProcessTree> tree, const MonitorOptions& options = {});
  ResourceMonitor(const ResourceMonitor&) = delete;
  ResourceMonitor& operator=(const ResourceMonitor&) = delete;
  ~ResourceMonitor();

  /// Until now.
  ResourceReport report();

  /// Takes a last sample and ends. Again: the same report. To be called while the processes still
  /// live: before an IsolatedSlam is destroyed.
  ResourceReport stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_RESOURCE_MONITOR_H
