#ifndef GSLAM_OPTIMIZER_SRC_REGISTRY_H
#define GSLAM_OPTIMIZER_SRC_REGISTRY_H

#include <gslam/optimizer/backend.h>
#include <gslam/optimizer/options.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

// Which back ends there are, and the choice of one for a call.

namespace gslam {
inline namespace v1 {
namespace detail {

// Back ends in the order in which they are asked. A list is never changed once others can see it,
// and never freed: looking one up is a load, and what it gave stays good whatever is registered
// meanwhile. Registering is rare, and a list is a few pointers.
class BackendRegistry {
 public:
  using List = std::vector<const OptimizerBackend*>;

  static BackendRegistry& instance();

  void add(const OptimizerBackend& backend);
  const List& list() const noexcept { return *list_.load(std::memory_order_acquire); }

 private:
  BackendRegistry();

  std::mutex mutex_;  // of writers
  std::vector<std::unique_ptr<const OptimizerBackend>> backends_;
  std::vector<std::unique_ptr<const List>> lists_;
  std::atomic<const List*> list_;
};

// @throws ArgumentError that says which back ends there are and how to get one; `problem` such as
// "bundles", `can` of those that can solve it
[[noreturn]] void refuseBackend(const std::string& wanted, const char* problem,
                                const std::vector<std::string>& can);

// The back end that options ask for, else the first that has the function.
template <class Function>
const OptimizerBackend& backendFor(const OptimizerOptions& options,
                                   Function OptimizerBackend::*function, const char* problem) {
  const BackendRegistry::List& all = BackendRegistry::instance().list();
  for (const OptimizerBackend* backend : all) {
    if (backend->*function && (options.backend.empty() || options.backend == backend->name)) {
      return *backend;
    }
  }
  std::vector<std::string> can;
  for (const OptimizerBackend* backend : all) {
    if (backend->*function) can.push_back(backend->name);
  }
  refuseBackend(options.backend, problem, can);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_REGISTRY_H
