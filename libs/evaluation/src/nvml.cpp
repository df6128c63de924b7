#include "nvml.h"

#if defined(__linux__)
#include <dlfcn.h>
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

#if defined(__linux__)

namespace {

template <class Function>
bool find(void* library, const char* name, Function& out) {
  out = reinterpret_cast<Function>(::dlsym(library, name));
  return out != nullptr;
}

}  // namespace

Nvml::Nvml(const std::string& library) {
  library_ = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) {
    why_not_ = "no NVIDIA driver (" + library + " cannot be loaded)";
    return;
  }
  int (*init)() = nullptr;
  int (*count)(unsigned*) = nullptr;
  int (*handle)(unsigned, Device*) = nullptr;
  if (!find(library_, "nvmlInit_v2", init) || !find(library_, "nvmlShutdown", shutdown_) ||
      !find(library_, "nvmlDeviceGetCount_v2", count) ||
      !find(library_, "nvmlDeviceGetHandleByIndex_v2", handle) ||
      !find(library_, "nvmlDeviceGetUtilizationRates", utilization_) ||
      !find(library_, "nvmlDeviceGetMemoryInfo", memory_)) {
    why_not_ = library + " lacks functions of NVML";
    return;
  }
  const int problem = init();
  is_begun_ = problem == 0;
  unsigned devices = 0;
  if (!is_begun_ || count(&devices) != 0 || devices == 0) {
    why_not_ = is_begun_ ? "NVML knows no GPU" : "NVML fails, error " + std::to_string(problem);
    return;
  }
  for (unsigned i = 0; i < devices; ++i) {
    Device device = nullptr;
    if (handle(i, &device) == 0) devices_.push_back(device);
  }
  if (devices_.empty()) why_not_ = "NVML gives access to no GPU";
}

Nvml::~Nvml() {
  if (is_begun_) shutdown_();
  if (library_ != nullptr) ::dlclose(library_);
}

std::vector<Nvml::Use> Nvml::read() const {
  std::vector<Use> uses;
  for (Device device : devices_) {
    Utilization load = {0, 0};
    if (utilization_(device, &load) != 0) continue;
    Use use;
    use.percent = double(load.gpu);
    Memory memory = {0, 0, 0};
    use.has_memory = memory_(device, &memory) == 0;
    use.memory = memory.used;
    uses.push_back(use);
  }
  return uses;
}

#else

Nvml::Nvml(const std::string&) : why_not_("NVML is looked for on Linux only") {}
Nvml::~Nvml() = default;
std::vector<Nvml::Use> Nvml::read() const {
  return {};
}

#endif  // __linux__

}  // namespace detail
}  // namespace v1
}  // namespace gslam
