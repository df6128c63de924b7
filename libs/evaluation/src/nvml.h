// NVIDIA's management library, loaded where it is installed. Its interface is documented in the
// "NVML API Reference Guide".
#ifndef GSLAM_EVALUATION_SRC_NVML_H
#define GSLAM_EVALUATION_SRC_NVML_H

#include <cstdint>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

class Nvml {
 public:
  struct Use {
    double percent = 0;
    std::uint64_t memory = 0;  // bytes
    bool has_memory = false;
  };

  // Whether it works: whyNot() is empty then.
  explicit Nvml(const std::string& library);
  Nvml(const Nvml&) = delete;
  Nvml& operator=(const Nvml&) = delete;
  ~Nvml();

  const std::string& whyNot() const { return why_not_; }
  // Of each GPU that tells.
  std::vector<Use> read() const;

 private:
  using Device = void*;
  struct Utilization {
    unsigned gpu, memory;  // percent
  };
  struct Memory {
    unsigned long long total, free, used;  // bytes
  };

  void* library_ = nullptr;
  bool is_begun_ = false;
  int (*shutdown_)() = nullptr;
  int (*utilization_)(Device, Utilization*) = nullptr;
  int (*memory_)(Device, Memory*) = nullptr;
  std::vector<Device> devices_;
  std::string why_not_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_SRC_NVML_H
