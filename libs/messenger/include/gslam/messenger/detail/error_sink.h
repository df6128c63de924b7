// Where the exceptions of callbacks go, and the knowledge that a callback is running.
#ifndef GSLAM_MESSENGER_DETAIL_ERROR_SINK_H
#define GSLAM_MESSENGER_DETAIL_ERROR_SINK_H

#include <gslam/base/log_hook.h>

#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace gslam {
inline namespace v1 {

/// Takes what a callback threw: the topic and the exception.
using CallbackErrorHandler = std::function<void(const std::string& topic, std::exception_ptr)>;

namespace detail {

/// What ends after the callbacks that run in it.
class Mortal {
 public:
  Mortal() = default;
  virtual ~Mortal() = default;
  Mortal(const Mortal&) = delete;
  Mortal& operator=(const Mortal&) = delete;

 private:
  friend class Delivering;
  Mortal* next_ = nullptr;  // that waits for its end
};

/// While one lives, this thread runs callbacks. Such a thread must not wait for the end of other
/// callbacks: they might wait for it.
class Delivering {
 public:
  Delivering() noexcept { ++depth(); }
  ~Delivering() {
    if (--depth() == 0 && graves() != nullptr) bury();
  }
  Delivering(const Delivering&) = delete;
  Delivering& operator=(const Delivering&) = delete;

  static bool isHere() noexcept { return depth() > 0; }

  /// Destroys an object after the callbacks of this thread have returned, which may be inside of
  /// it; at once where there are none.
  static void destroyLater(Mortal* object) noexcept {
    if (!isHere()) {
      delete object;
      return;
    }
    object->next_ = graves();
    graves() = object;
  }

 private:
  static int& depth() noexcept {
    static thread_local int depth = 0;
    return depth;
  }
  static Mortal*& graves() noexcept {
    static thread_local Mortal* first = nullptr;
    return first;
  }
  static void bury() noexcept {
    while (Mortal* const object = graves()) {
      graves() = object->next_;
      delete object;
    }
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
      logParts(LogLevel::error, __FILE__, __LINE__,
               {"a subscriber of ", topic.c_str(), " threw: ", problem.what()});
    } catch (...) {
      logParts(LogLevel::error, __FILE__, __LINE__,
               {"a subscriber of ", topic.c_str(), " threw something that is no exception"});
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
