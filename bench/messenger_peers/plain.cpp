// What one writes by hand: a vector of functions without a lock, and one that is copied on write
// behind a mutex, as anything must be that threads may subscribe to.
#include <functional>
#include <mutex>
#include <vector>

#include "publish.h"

namespace {

template <class T>
class FunctionVector {
 public:
  void subscribe(std::size_t& received) {
    functions_.push_back([&received](const Message<T>&) { ++received; });
  }
  void publish(const Message<T>& message) {
    for (const auto& function : functions_) function(message);
  }

 private:
  std::vector<std::function<void(const Message<T>&)>> functions_;
};

template <class T>
class MutexSnapshot {
 public:
  void subscribe(std::size_t& received) {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto functions = std::make_shared<Functions>(*functions_);
    functions->push_back([&received](const Message<T>&) { ++received; });
    functions_ = functions;
  }
  void publish(const Message<T>& message) {
    std::shared_ptr<const Functions> functions;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      functions = functions_;
    }
    for (const auto& function : *functions) function(message);
  }

 private:
  using Functions = std::vector<std::function<void(const Message<T>&)>>;
  std::mutex mutex_;
  std::shared_ptr<const Functions> functions_ = std::make_shared<const Functions>();
};

PEER(FunctionVector, "function_vector");
PEER(MutexSnapshot, "mutex_snapshot");

}  // namespace
