#include "options.h"

#include <cmath>
#include <sstream>

namespace replay {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::string numberText(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

double number(const gslam::Svar& parameters, const char* name, double least, double most) {
  const double value = parameters.get<double>(name);
  if (value >= least && value <= most) return value;
  throw gslam::ArgumentError(name, "is " + numberText(value) + ", expected " + numberText(least) +
                                       " to " + numberText(most));
}

std::uint64_t count(const gslam::Svar& parameters, const char* name, double most) {
  return static_cast<std::uint64_t>(number(parameters, name, 0, most));
}

std::chrono::nanoseconds milliseconds(const gslam::Svar& parameters, const char* name) {
  return std::chrono::nanoseconds(std::llround(1e6 * number(parameters, name, 0, 1e6)));
}

template <class Choice>
Choice choice(const gslam::Svar& parameters, const char* name,
              std::initializer_list<std::pair<const char*, Choice>> choices) {
  const auto given = parameters.get<std::string>(name);
  std::string all;
  for (const auto& one : choices) {
    if (given == one.first) return one.second;
    all += (all.empty() ? "" : ", ") + std::string(one.first);
  }
  throw gslam::ArgumentError(name, "is '" + given + "', expected one of " + all);
}

PoseOptions readPoses(const gslam::Svar& parameters) {
  PoseOptions poses;
  poses.file = parameters.get<std::string>("trajectory");
  if (poses.file.empty()) {
    throw gslam::ArgumentError("trajectory",
                               "is empty, expected a file with the poses to answer with; `gslam "
                               "info DATASET --ground-truth FILE` makes one of ground truth");
  }
  poses.max_gap = std::llround(1e9 * number(parameters, "max_gap_s", 0, 1e6));
  poses.noise_m = number(parameters, "noise_m", 0, 1e6);
  poses.noise_rad = kPi / 180 * number(parameters, "noise_deg", 0, 180);
  poses.seed = count(parameters, "seed", 1e15);
  poses.scale = number(parameters, "scale", 1e-6, 1e6);
  poses.drift = 0.01 * number(parameters, "drift_percent", 0, 1e4);
  poses.drift_rad_per_m = kPi / 180 * number(parameters, "drift_deg_per_m", -360, 360);
  return poses;
}

CostOptions readCost(const gslam::Svar& parameters) {
  CostOptions cost;
  cost.allocations = count(parameters, "allocations", 1e8);
  cost.allocation_bytes = count(parameters, "allocation_bytes", 1e10);
  cost.cpu = milliseconds(parameters, "cpu_ms");
  cost.cpu_threads = count(parameters, "cpu_threads", 1024);
  if (cost.cpu_threads == 0) {
    throw gslam::ArgumentError("cpu_threads", "is 0, expected 1 thread or more");
  }
  cost.grow_bytes = static_cast<std::size_t>(1e6 * number(parameters, "grow_mb", 0, 1e5));
  return cost;
}

FaultOptions readFault(const gslam::Svar& parameters) {
  using Call = FaultOptions::Call;
  FaultOptions fault;
  fault.kind = faultCalled("fault", parameters.get<std::string>("fault"));
  fault.call = choice<Call>(
      parameters, "fault_in",
      {{"configure", Call::configure}, {"feed", Call::feed}, {"finish", Call::finish}});
  fault.frame = count(parameters, "fault_at", 1e15);
  return fault;
}

}  // namespace

FaultOptions::Kind faultCalled(const char* parameter, const std::string& name) {
  using Kind = FaultOptions::Kind;
  return choice<Kind>(gslam::Svar::object({{parameter, name}}), parameter,
                      {{"none", Kind::none},
                       {"signal", Kind::signal},
                       {"abort", Kind::abort},
                       {"exit", Kind::exit},
                       {"throw", Kind::exception},
                       {"hang", Kind::hang}});
}

gslam::Svar defaultParameters() {
  return gslam::Svar::object({{"trajectory", ""},
                              {"max_gap_s", 0.0},
                              {"noise_m", 0.0},
                              {"noise_deg", 0.0},
                              {"seed", 0},
                              {"scale", 1.0},
                              {"drift_percent", 0.0},
                              {"drift_deg_per_m", 0.0},
                              {"start_after", 0},
                              {"losses", ""},
                              {"delay_ms", 0.0},
                              {"latency_ms", 0.0},
                              {"strays", 0},
                              {"stamp_error_s", 0.0},
                              {"keyframe_every", 0},
                              {"corrects", false},
                              {"allocations", 0},
                              {"allocation_bytes", 64},
                              {"cpu_ms", 0.0},
                              {"cpu_threads", 1},
                              {"grow_mb", 0.0},
                              {"fault", "none"},
                              {"fault_in", "feed"},
                              {"fault_at", 0}});
}

gslam::Svar parameterHelp() {
  return gslam::Svar::object(
      {{"trajectory", "the file that is replayed: TUM, KITTI or EuRoC"},
       {"max_gap_s", "widest gap that is interpolated, seconds; 0: any"},
       {"noise_m", "standard deviation of each coordinate"},
       {"noise_deg", "standard deviation about each axis"},
       {"seed", "of the noise"},
       {"scale", "of all lengths"},
       {"drift_percent", "of the way, along x of the world"},
       {"drift_deg_per_m", "of the heading, about z of the world"},
       {"start_after", "frames before the first pose"},
       {"losses", "such as 100-149,200-209:guessed,2.5s-3s:none"},
       {"delay_ms", "that feed() takes longer"},
       {"latency_ms", "that the answer comes behind feed()"},
       {"strays", "poses a frame of frames that there are not"},
       {"stamp_error_s", "by which stamps of poses are wrong"},
       {"keyframe_every", "tracked frames from keyframe to keyframe; 0: no map"},
       {"corrects", "whether all poses come again at the end, without noise"},
       {"allocations", "calls of malloc() a frame"},
       {"allocation_bytes", "of each"},
       {"cpu_ms", "CPU time a frame of each thread"},
       {"cpu_threads", "that spend it"},
       {"grow_mb", "memory a frame that is kept, 10^6 bytes"},
       {"fault", "none, signal, abort, exit, throw, hang"},
       {"fault_in", "the call: configure, feed or finish"},
       {"fault_at", "the number of the frame, of feed"}});
}

Options readOptions(const gslam::Svar& parameters) {
  Options options;
  options.poses = readPoses(parameters);
  options.cost = readCost(parameters);
  options.fault = readFault(parameters);
  options.losses = Losses(parameters.get<std::string>("losses"));
  options.start_after = count(parameters, "start_after", 1e15);
  options.delay = milliseconds(parameters, "delay_ms");
  options.latency = milliseconds(parameters, "latency_ms");
  options.strays = count(parameters, "strays", 1e6);
  options.stamp_error = std::llround(1e9 * number(parameters, "stamp_error_s", -1e6, 1e6));
  options.keyframe_every = count(parameters, "keyframe_every", 1e15);
  options.is_corrected = parameters.get<bool>("corrects");
  return options;
}

}  // namespace replay
