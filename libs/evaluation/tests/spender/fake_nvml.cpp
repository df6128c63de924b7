// Stands for NVIDIA's management library: two GPUs, of which the second has no memory that it
// tells. While it starts, the machine uses energy: 150 J are in the counter that
// GSLAM_TEST_NVML_USES_ENERGY names.
#include <cstdio>
#include <cstdlib>

// NOLINTBEGIN(readability-identifier-naming): names of NVIDIA's
extern "C" {

struct Utilization {
  unsigned gpu, memory;
};
struct Memory {
  unsigned long long total, free, used;
};

__attribute__((visibility("default"))) int nvmlInit_v2() {
  const char* const counter = std::getenv("GSLAM_TEST_NVML_USES_ENERGY");
  if (counter == nullptr) return 0;
  std::FILE* const file = std::fopen(counter, "w");
  if (file == nullptr) return 1;
  std::fputs("150000000\n", file);
  std::fclose(file);
  return 0;
}
__attribute__((visibility("default"))) int nvmlShutdown() {
  return 0;
}
__attribute__((visibility("default"))) int nvmlDeviceGetCount_v2(unsigned* count) {
  *count = 2;
  return 0;
}
__attribute__((visibility("default"))) int nvmlDeviceGetHandleByIndex_v2(unsigned index,
                                                                         void** device) {
  static int devices[2];
  if (index > 1) return 2;
  *device = &devices[index];
  devices[index] = int(index);
  return 0;
}
__attribute__((visibility("default"))) int nvmlDeviceGetUtilizationRates(void* device,
                                                                         Utilization* use) {
  use->gpu = *static_cast<int*>(device) == 0 ? 80 : 20;
  use->memory = 1;
  return 0;
}
__attribute__((visibility("default"))) int nvmlDeviceGetMemoryInfo(void* device, Memory* memory) {
  if (*static_cast<int*>(device) == 1) return 3;  // not supported
  memory->total = 8000000000ULL;
  memory->used = 3000000000ULL;
  memory->free = 5000000000ULL;
  return 0;
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming)
