#include "machine.h"

#include <sys/utsname.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

namespace app {
namespace {

// What stands behind a name and a colon in a file of /proc; empty where there is no such line.
std::string factOf(const std::string& path, const std::string& name) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (line.compare(0, name.size(), name) != 0) continue;
    const std::size_t colon = line.find(':', name.size());
    if (colon == std::string::npos) continue;
    const std::size_t first = line.find_first_not_of(" \t", colon + 1);
    return first == std::string::npos ? "" : line.substr(first);
  }
  return "";
}

std::string compiler() {
#if defined(__clang__)
  return "clang++ " __clang_version__;
#elif defined(__GNUC__)
  return "g++ " __VERSION__;
#else
  return "unknown";
#endif
}

}  // namespace

gslam::Svar describeMachine() {
  gslam::Svar machine = gslam::Svar::object({{"cores", std::thread::hardware_concurrency()}});
  const std::string processor = factOf("/proc/cpuinfo", "model name");
  machine.set("cpu", processor.empty() ? gslam::Svar() : gslam::Svar(processor));
  const std::string kilobytes = factOf("/proc/meminfo", "MemTotal");
  machine.set("memory_mb", kilobytes.empty()
                               ? gslam::Svar()
                               : gslam::Svar(std::strtoll(kilobytes.c_str(), nullptr, 10) / 1024));
  machine.set("compiler", compiler());
  utsname name{};
  if (uname(&name) != 0) return machine;
  machine.set("system", std::string(name.sysname) + " " + name.release);
  machine.set("architecture", std::string(name.machine));
  return machine;
}

}  // namespace app
