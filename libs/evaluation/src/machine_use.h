// What the whole machine uses: load of cores, energy, GPUs.
#ifndef GSLAM_EVALUATION_SRC_MACHINE_USE_H
#define GSLAM_EVALUATION_SRC_MACHINE_USE_H

#include <gslam/evaluation/resource_monitor.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "proc_files.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Loads of cores since it was made.
class CoreLoads {
 public:
  explicit CoreLoads(std::string proc) : path_(std::move(proc) + "/stat") { read(); }
  // Percent of each core since the begin.
  std::vector<double> read();

 private:
  std::string path_, text_;
  std::map<std::size_t, CoreTicks> begin_;
};

// A counter of micro-joules that begins again at 0 when it is full.
class EnergyCounter {
 public:
  EnergyCounter(std::uint64_t begin, std::uint64_t range) : last_(begin), range_(range) {}
  void add(std::uint64_t now) {
    if (now >= last_) {
      sum_ += now - last_;
    } else if (range_ >= last_) {
      sum_ += range_ - last_ + now;
    }
    last_ = now;
  }
  double joules() const { return 1e-6 * double(sum_); }

 private:
  std::uint64_t last_;
  std::uint64_t range_;  // 0: not known
  std::uint64_t sum_ = 0;
};

// RAPL, as the system shows it in /sys/class/powercap (Documentation/power/powercap of Linux).
class Rapl {
 public:
  explicit Rapl(const std::string& sys);
  void sample();
  EnergyReport report() const;

 private:
  struct Zone {
    std::string path;
    bool is_dram;
    EnergyCounter counter;
  };
  void open(const std::string& zone);

  std::vector<Zone> zones_;
  bool has_all_dram_ = true;  // of those that are there
  std::string why_not_;
  std::string text_;
};

// NVIDIA's library, where it is installed.
class Nvml;

// GPUs that amdgpu shows in /sys/class/drm, and NVIDIA's.
class Gpus {
 public:
  Gpus(const std::string& sys, const std::string& nvml);
  Gpus(const Gpus&) = delete;
  Gpus& operator=(const Gpus&) = delete;
  ~Gpus();
  void sample();
  GpuReport report() const;

 private:
  void note(double percent, std::uint64_t memory, bool has_memory);

  struct Device {
    std::string busy, memory;  // files
  };
  std::vector<Device> devices_;
  std::unique_ptr<Nvml> nvml_;
  std::string text_;
  std::size_t values_ = 0;
  double sum_ = 0;
  std::uint64_t memory_ = 0;  // of this sample
  GpuReport report_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_SRC_MACHINE_USE_H
