#include "machine_use.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "nvml.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

bool readNumber(const std::string& path, std::string& text, std::uint64_t& out) {
  std::size_t at = 0;
  return readFile(path, text) == 0 && takeNumber(text, at, out);
}

}  // namespace

std::vector<double> CoreLoads::read() {
  std::vector<double> loads;
  if (readFile(path_, text_) != 0) return loads;
  for (const CoreTicks& core : parseCores(text_)) {
    if (core.core > 65535) continue;
    const CoreTicks& begin = begin_.emplace(core.core, core).first->second;
    if (loads.size() <= core.core) loads.resize(core.core + 1);
    if (core.all <= begin.all || core.busy < begin.busy) continue;
    loads[core.core] =
        std::min(100.0, 100.0 * double(core.busy - begin.busy) / double(core.all - begin.all));
  }
  return loads;
}

Rapl::Rapl(const std::string& sys) {
  const std::string folder = sys + "/class/powercap/";
  // Not intel-rapl-mmio, which shows the same package again.
  for (const std::string& name : namesIn(folder, "intel-rapl:")) open(folder + name);
  const bool has_package =
      std::any_of(zones_.begin(), zones_.end(), [](const Zone& zone) { return !zone.is_dram; });
  if (why_not_.empty() && !has_package) {
    why_not_ = "no RAPL: " + folder + " has no processor package";
  }
}

void Rapl::open(const std::string& zone) {
  std::string name;
  if (readFile(zone + "/name", name) != 0) return;
  const bool is_dram = name.compare(0, 4, "dram") == 0;
  if (!is_dram && name.compare(0, 7, "package") != 0) return;  // a part of a package, or all of it
  const std::string path = zone + "/energy_uj";
  const int problem = readFile(path, text_);
  std::uint64_t begin = 0, range = 0;
  std::size_t at = 0;
  const bool is_known = problem == 0 && takeNumber(text_, at, begin);
  if (is_dram && !is_known) {
    has_all_dram_ = false;  // that of packages is known all the same
    return;
  }
  if (problem != 0) {
    why_not_ = path + " cannot be read: " + std::generic_category().message(problem);
    if (problem == EACCES) why_not_ += " (most systems show it to root only)";
    return;
  }
  if (!is_known) {
    why_not_ = path + " is no number";
    return;
  }
  readNumber(zone + "/max_energy_range_uj", text_, range);
  zones_.push_back({path, is_dram, EnergyCounter(begin, range)});
}

void Rapl::sample() {
  for (Zone& zone : zones_) {
    std::uint64_t now = 0;
    if (readNumber(zone.path, text_, now)) {
      zone.counter.add(now);
    } else if (zone.is_dram) {
      has_all_dram_ = false;
    } else if (why_not_.empty()) {
      why_not_ = zone.path + " could not be read any more";
    }
  }
}

EnergyReport Rapl::report() const {
  EnergyReport report;
  report.why_not = why_not_;
  if (!why_not_.empty()) return report;
  for (const Zone& zone : zones_) {
    (zone.is_dram ? report.dram_joules : report.package_joules) += zone.counter.joules();
    report.has_dram = report.has_dram || zone.is_dram;
  }
  if (!has_all_dram_) {
    report.has_dram = false;
    report.dram_joules = 0;
  }
  return report;
}

Gpus::Gpus(const std::string& sys, const std::string& nvml) {
  const std::string folder = sys + "/class/drm/";
  for (const std::string& name : namesIn(folder, "card")) {
    std::string device = folder;
    device.append(name).append("/device");
    std::uint64_t value = 0;
    // card0-HDMI-A-1 and the like are outputs.
    if (name.find('-') == std::string::npos &&
        readNumber(device + "/gpu_busy_percent", text_, value)) {
      devices_.push_back({device + "/gpu_busy_percent", device + "/mem_info_vram_used"});
    }
  }
  nvml_.reset(new Nvml(nvml));
  report_.gpus = devices_.size() + nvml_->read().size();
  if (report_.gpus > 0) return;
  report_.why_not = "no GPU in " + folder + " tells its load";
  report_.why_not +=
      "; " + (nvml_->whyNot().empty() ? "NVML tells the load of none" : nvml_->whyNot());
}

Gpus::~Gpus() = default;

void Gpus::note(double percent, std::uint64_t memory, bool has_memory) {
  ++values_;
  sum_ += percent;
  report_.highest_percent = std::max(report_.highest_percent, percent);
  report_.has_memory = report_.has_memory || has_memory;
  if (has_memory) memory_ += memory;
}

void Gpus::sample() {
  memory_ = 0;
  for (const Device& device : devices_) {
    std::uint64_t percent = 0, memory = 0;
    if (!readNumber(device.busy, text_, percent)) continue;
    const bool has_memory = readNumber(device.memory, text_, memory);
    note(double(percent), memory, has_memory);
  }
  if (nvml_->whyNot().empty()) {
    for (const Nvml::Use& use : nvml_->read()) note(use.percent, use.memory, use.has_memory);
  }
  report_.peak_memory_bytes = std::max(report_.peak_memory_bytes, memory_);
}

GpuReport Gpus::report() const {
  GpuReport report = report_;
  if (values_ > 0) report.mean_percent = sum_ / double(values_);
  return report;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
