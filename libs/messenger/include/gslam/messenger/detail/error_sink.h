// Where the exceptions of callbacks go, and the knowledge that a callback is running.
#ifndef GSLAM_MESSENGER_DETAIL_ERROR_SINK_H
#define GSLAM_MESSENGER_DETAIL_ERROR_SINK_H

#include <gslam/base/log.h>

#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {

/// Takes what a callback threw: the topic and the exception.
using CallbackErrorHandler = std::function<void(const std::string& topic, std::exception_ptr)>;

namespace detail {

/// While one lives, this thread runs callbacks. Such a thread must not wait for the end of other
/// callbacks: they might wait for it.
class Delivering {
 public:
  Delivering() noexcept { ++depth(); }
  ~Delivering() {
    if (--depth() == 0 && !graves().empty()) bury();
  }
  Delivering(const Delivering&) = delete;
  Delivering& operator=(const Delivering&) = delete;

  static bool isHere() noexcept { return depth() > 0; }

  /// Destroys an object after the callbacks of this thread have returned, which may be inside of
  /// it; at once where there are none.
  static void destroyLater(std::shared_ptr<void> object) {
    if (isHere()) graves().push_back(std::move(object));
  }

 private:
  static int& depth() noexcept {
    static thread_local int depth = 0;
    return depth;
  }
  static std::vector<std::shared_ptr<void>>& graves() noexcept {
    static thread_local std::vector<std::shared_ptr<void>> objects;
    return objects;
  }
  static void bury() {
    std::vector<std::shared_ptr<void>> objects;
    objects.swap(graves());
  }
};

/// Gives what callbacks throw to a handler; to the log where there is none.
class ErrorSink {
 public:
  void set(CallbackErrorHandler handler) {
    auto next = std::make_shared<const CallbackErrorHandler>(std::move(handler));
    const std::lock_guard<std::mutex> lock(mutex_);
    handler_.swap(next);
  }

  template <class Call>
  void guard(const std::string& topic, Call call) {
    try {
      call();
    } catch (...) {
      report(topic, std::current_exception());
    }
  }

  void report(const std::string& topic, const std::exception_ptr& error) {
    std::shared_ptr<const CallbackErrorHandler> handler;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      handler = handler_;
    }
    try {
      if (handler != nullptr && *handler) return (*handler)(topic, error);
      std::rethrow_exception(error);
    } catch (const std::exception& problem) {
      GSLAM_LOG(error) << "a subscriber of " << topic << " threw: " << problem.what();
    } catch (...) {
      GSLAM_LOG(error) << "a subscriber of " << topic << " threw something that is no exception";
    }
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<const CallbackErrorHandler> handler_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_ERROR_SINK_H
