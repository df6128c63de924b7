#include <gslam/evaluation/cost.h>

#include <algorithm>
#include <utility>

#include "format.h"

namespace gslam {
inline namespace v1 {
namespace {

using evaluation::format;

constexpr double kMegabyte = 1e6;

Svar describeTimes(const Statistics& s) {
  const auto value = [&s](double number) { return s.count > 0 ? Svar(number) : Svar(); };
  return Svar::object({{"median", value(s.median)},
                       {"p90", value(s.p90)},
                       {"p95", value(s.p95)},
                       {"p99", value(s.p99)},
                       {"max", value(s.max)},
                       {"min", value(s.min)},
                       {"mean", value(s.mean)},
                       {"std", value(s.std)},
                       {"count", s.count}});
}

// Frames, and what there is a figure of for each.
void describeFrames(const Cost& cost, Svar& out) {
  out.set("frames", Svar::object({{"delivered", cost.delivered},
                                  {"results", cost.results},
                                  {"dropped", cost.dropped},
                                  {"overlapping", cost.overlapping}}));
  out.set("frame_ms", describeTimes(cost.frame_ms));
  out.set("feed_ms", describeTimes(cost.feed_ms));
  out.set("cpu_ms", describeTimes(cost.cpu_ms));
  out.set("cpu_ms_per_frame", cost.delivered > 0 ? Svar(cost.cpu_ms_per_frame) : Svar());
  out.set("frames_per_second", cost.frames_per_second > 0 ? Svar(cost.frames_per_second) : Svar());
}

void describeProcesses(const ResourceReport& r, Svar& out) {
  const bool is_known = r.seconds > 0;
  const auto value = [is_known](auto number) { return is_known ? Svar(number) : Svar(); };
  out.set("wall_s", value(r.seconds));
  out.set("cpu_s", value(r.used.cpu_seconds));
  out.set("user_s", value(r.used.user_seconds));
  out.set("system_s", value(r.used.system_seconds));
  out.set("cpu_percent", value(r.cpu_percent));
  out.set("peak_cpu_percent", value(r.peak_cpu_percent));
  Svar cores = Svar::array();
  for (const double percent : r.core_percent) cores.push_back(percent);
  out.set("core_percent", is_known && !r.core_percent.empty() ? cores : Svar());
  out.set("rss_mb", value(double(r.rss_bytes) / kMegabyte));
  out.set("peak_rss_mb", value(double(r.peak_rss_bytes) / kMegabyte));
  out.set("peak_sampled_rss_mb", value(double(r.peak_sampled_rss_bytes) / kMegabyte));
  out.set("peak_pss_mb",
          r.peak_pss_bytes > 0 ? Svar(double(r.peak_pss_bytes) / kMegabyte) : Svar());
  out.set("threads", value(r.most_threads));
  out.set("processes", value(r.most_processes));
  out.set("voluntary_switches", value(r.used.voluntary_switches));
  out.set("involuntary_switches", value(r.used.involuntary_switches));
  out.set("minor_faults", value(r.used.minor_faults));
  out.set("major_faults", value(r.used.major_faults));
  out.set("sampling", is_known ? Svar::object({{"samples", r.samples_taken},
                                               {"cpu_s", r.monitor_cpu_seconds},
                                               {"overhead_percent", r.overhead_percent}})
                               : Svar());
  if (!is_known) out.set("why_no_resources", "they were not measured");
}

std::string whyNoAllocationsOf(const Cost& cost) {
  if (!cost.source.why_no_allocations.empty()) return cost.source.why_no_allocations;
  const std::string why = whyNoAllocations();
  return why.empty() ? "the measured processes do not count them" : why;
}

void describeAllocations(const Cost& cost, Svar& out) {
  const AllocationCounts& a = cost.source.allocations;
  const bool is_known = cost.has_allocations;
  const bool is_any = is_known && cost.counted > 0;
  out.set("allocations_per_frame", is_any ? Svar(cost.allocations_per_frame) : Svar());
  out.set("allocated_bytes_per_frame", is_any ? Svar(cost.allocated_bytes_per_frame) : Svar());
  if (!is_known) {
    out.set("allocations", nullptr);
    out.set("heap", nullptr);
    out.set("why_no_allocations", whyNoAllocationsOf(cost));
    return;
  }
  out.set("allocations",
          Svar::object({{"calls", a.calls}, {"bytes", a.bytes}, {"frees", a.frees}}));
  out.set("heap", Svar::object({{"live_blocks", a.live_blocks},
                                {"live_mb", double(a.live_bytes) / kMegabyte},
                                {"peak_mb", double(a.peak_live_bytes) / kMegabyte}}));
}

void describeMachine(const ResourceReport& r, Svar& out) {
  const EnergyReport& e = r.energy;
  const GpuReport& g = r.gpu;
  const bool has_energy = r.seconds > 0 && e.why_not.empty();
  const bool has_gpu = r.seconds > 0 && g.why_not.empty();
  out.set("energy", has_energy
                        ? Svar::object({{"package_j", e.package_joules},
                                        {"dram_j", e.has_dram ? Svar(e.dram_joules) : Svar()},
                                        {"package_w", e.package_joules / r.seconds}})
                        : Svar());
  if (!has_energy) out.set("why_no_energy", r.seconds > 0 ? e.why_not : "it was not measured");
  out.set("gpu",
          has_gpu ? Svar::object(
                        {{"gpus", g.gpus},
                         {"mean_percent", g.mean_percent},
                         {"highest_percent", g.highest_percent},
                         {"peak_memory_mb",
                          g.has_memory ? Svar(double(g.peak_memory_bytes) / kMegabyte) : Svar()}})
                  : Svar());
  if (!has_gpu) out.set("why_no_gpu", r.seconds > 0 ? g.why_not : "it was not measured");
}

std::string line(const std::string& name, const std::string& text) {
  return name + std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') + text + '\n';
}

std::string because(const char* name, const std::string& why) {
  return line(name, "none: " + why);
}

std::string row(const char* name, const Statistics& s) {
  if (s.count == 0) return because(name, "no frame has it");
  return line(name, format("%10.3f %10.3f %10.3f %10.3f %10.3f %9zu", s.median, s.mean, s.p95,
                           s.p99, s.max, s.count));
}

std::string framesText(const Cost& cost) {
  std::string out = line("frames", format("%zu given, %zu with a pose, %zu dropped", cost.delivered,
                                          cost.results, cost.dropped));
  if (cost.frames_per_second > 0) {
    out += line("rate",
                format("%.2f frames/s over %.3f s", cost.frames_per_second, cost.span_seconds));
  }
  out += line("each frame", format("%10s %10s %10s %10s %10s %9s", "median", "mean", "p95", "p99",
                                   "max", "frames"));
  out += row("  to the pose, ms", cost.frame_ms) + row("  in feed(), ms", cost.feed_ms) +
         row("  CPU, ms", cost.cpu_ms);
  if (cost.overlapping == 0) return out;
  return out + line("  overlapping", format("%zu: what is used meanwhile is in the CPU of each; "
                                            "counted once it is %.3f ms a frame",
                                            cost.overlapping, cost.cpu_ms_per_frame));
}

std::string processesText(const ResourceReport& r) {
  if (!(r.seconds > 0)) return because("resources", "they were not measured");
  std::string out =
      line("CPU", format("%.1f %% of one core (most %.1f %%), %.3f s in %.3f s", r.cpu_percent,
                         r.peak_cpu_percent, r.used.cpu_seconds, r.seconds));
  if (!r.core_percent.empty()) {
    std::string loads;
    for (const double percent : r.core_percent) loads += format(" %.0f", percent);
    out += line("cores of the machine", "%:" + loads);
  }
  out += line("memory", format("%.1f MB, most %.1f MB", double(r.rss_bytes) / kMegabyte,
                               double(r.peak_rss_bytes) / kMegabyte));
  out += line("threads", format("%zu in %zu processes at most", r.most_threads, r.most_processes));
  out += line(
      "context switches",
      format("%llu voluntary, %llu not", static_cast<unsigned long long>(r.used.voluntary_switches),
             static_cast<unsigned long long>(r.used.involuntary_switches)));
  out += line("page faults",
              format("%llu minor, %llu major", static_cast<unsigned long long>(r.used.minor_faults),
                     static_cast<unsigned long long>(r.used.major_faults)));
  return out;
}

std::string allocationsText(const Cost& cost) {
  if (!cost.has_allocations) return because("allocations", whyNoAllocationsOf(cost));
  const AllocationCounts& a = cost.source.allocations;
  std::string out =
      line("allocations", format("%llu of %.1f MB", static_cast<unsigned long long>(a.calls),
                                 double(a.bytes) / kMegabyte)) +
      line("  since the start",
           format("%lld blocks of %.1f MB live at the end, most %.1f MB",
                  static_cast<long long>(a.live_blocks), double(a.live_bytes) / kMegabyte,
                  double(a.peak_live_bytes) / kMegabyte));
  if (cost.counted == 0) return out;
  return out + line("  each frame", format("%.1f of %.0f bytes", cost.allocations_per_frame,
                                           cost.allocated_bytes_per_frame));
}

std::string machineText(const ResourceReport& r) {
  if (!(r.seconds > 0)) return "";
  std::string out =
      r.energy.why_not.empty()
          ? line("energy", format("%.1f J of processors, %.1f W", r.energy.package_joules,
                                  r.energy.package_joules / r.seconds))
          : because("energy", r.energy.why_not);
  out +=
      r.gpu.why_not.empty()
          ? line("GPU", format("%.1f %%, most %.1f %%", r.gpu.mean_percent, r.gpu.highest_percent) +
                            (r.gpu.has_memory ? format(", memory most %.1f MB",
                                                       double(r.gpu.peak_memory_bytes) / kMegabyte)
                                              : ""))
          : because("GPU", r.gpu.why_not);
  return out + line("sampling", format("%zu samples, %.2f %% of one core", r.samples_taken,
                                       r.overhead_percent));
}

// Parts of what only grows, such as CPU time: what several of them have in common counts once.
class Spans {
 public:
  void add(double begin, double length) { spans_.emplace_back(begin, begin + length); }
  // Of all together. @param overlapping  how many begin before one that began earlier has ended
  double length(std::size_t* overlapping = nullptr) {
    constexpr double kRounding = 1e-5;  // of a text with six digits
    std::sort(spans_.begin(), spans_.end());
    double sum = 0, end = 0;
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      if (i == 0) end = spans_[0].first;
      if (overlapping != nullptr && spans_[i].first < end - kRounding) ++*overlapping;
      sum += std::max(0.0, spans_[i].second - std::max(end, spans_[i].first));
      end = std::max(end, spans_[i].second);
    }
    return sum;
  }

 private:
  std::vector<std::pair<double, double>> spans_;
};

}  // namespace

Cost costOf(CostSource source) {
  Cost cost;
  std::vector<double> wall, feed, cpu;
  Spans cpu_spans, calls, bytes;
  double begin = 0, end = 0;
  for (const FrameTime& frame : source.frames) {
    cost.dropped += frame.is_dropped ? 1 : 0;
    if (frame.is_dropped) continue;
    const double delivered = 1e-9 * double(frame.delivered);
    begin = cost.delivered == 0 ? delivered : std::min(begin, delivered);
    end = std::max(end, delivered + 1e-3 * std::max(frame.feed_ms, frame.wall_ms));
    ++cost.delivered;
    feed.push_back(frame.feed_ms);
    cpu.push_back(frame.cpu_ms);
    if (frame.has_result) wall.push_back(frame.wall_ms);
    cpu_spans.add(frame.cpu_ms_before, frame.cpu_ms);
    if (!frame.has_allocations) continue;
    ++cost.counted;
    calls.add(double(frame.allocations_before), double(frame.allocations));
    bytes.add(double(frame.allocated_bytes_before), double(frame.allocated_bytes));
  }
  cost.results = wall.size();
  cost.frame_ms = statisticsOf(std::move(wall));
  cost.feed_ms = statisticsOf(std::move(feed));
  cost.cpu_ms = statisticsOf(std::move(cpu));
  cost.span_seconds = cost.delivered > 0 ? end - begin : 0;
  if (cost.span_seconds > 0) cost.frames_per_second = double(cost.delivered) / cost.span_seconds;
  cost.has_allocations = source.allocations.is_counted;
  const double used_cpu = cpu_spans.length(&cost.overlapping);
  if (cost.delivered > 0) cost.cpu_ms_per_frame = used_cpu / double(cost.delivered);
  if (cost.has_allocations && cost.counted > 0) {
    cost.allocations_per_frame = calls.length() / double(cost.counted);
    cost.allocated_bytes_per_frame = bytes.length() / double(cost.counted);
  }
  cost.source = std::move(source);
  return cost;
}

Svar costToSvar(const Cost& cost) {
  Svar out = Svar::object({{"measured", cost.source.is_slam_alone ? "slam" : "process"}});
  describeFrames(cost, out);
  describeProcesses(cost.source.resources, out);
  describeAllocations(cost, out);
  describeMachine(cost.source.resources, out);
  return out;
}

std::string costText(const Cost& cost) {
  return line("measured", cost.source.is_slam_alone
                              ? "the process of the SLAM system alone"
                              : "the whole process, with all else that it does") +
         framesText(cost) + processesText(cost.source.resources) + allocationsText(cost) +
         machineText(cost.source.resources);
}

}  // namespace v1
}  // namespace gslam
