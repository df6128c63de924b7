// Where the exceptions of callbacks go, and the knowledge that a callback is running.
#ifndef GSLAM_MESSENGER_DETAIL_ERROR_SINK_H
#define GSLAM_MESSENGER_DETAIL_ERROR_SINK_H

#include <gslam/base/log_hook.h>
#include <gslam/base/platform.h>

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
  friend class CallbackThread;
  Mortal* next_ = nullptr;  // that waits for its end
};

/// Whether a thread is in callbacks. Such a thread must not wait for the end of other callbacks:
/// they might wait for it.
class CallbackThread {
 public:
  bool isCalling() const noexcept { return depth_ > 0; }
  void enter() noexcept { ++depth_; }
  void leave() noexcept {
    // Before it has left: what was given up in a callback ends without waiting for others.
    if (depth_ == 1 && graves_ != nullptr) bury();
    --depth_;
  }

  /// Destroys an object after the callbacks of this thread have returned, which may be inside of
  /// it; at once where there are none.
  void destroyLater(Mortal* object) noexcept {
    if (depth_ == 0) {
      delete object;
      return;
    }
    object->next_ = graves_;
    graves_ = object;
  }

  /// This thread. A library with hidden visibility has another view of it than its host, so what
  /// belongs to a messenger asks its ErrorSink.
  static CallbackThread& ofThisLibrary() noexcept {
    static thread_local CallbackThread thread;
    return thread;
  }

 private:
  GSLAM_COLD void bury() noexcept {
    while (Mortal* const object = graves_) {
      graves_ = object->next_;
      delete object;
    }
  }

  int depth_ = 0;
  Mortal* graves_ = nullptr;
};

/// While one lives, this thread runs callbacks.
class Delivering {
 public:
  explicit Delivering(CallbackThread& thread) noexcept : thread_(thread) { thread_.enter(); }
  ~Delivering() { thread_.leave(); }
  Delivering(const Delivering&) = delete;
  Delivering& operator=(const Delivering&) = delete;

 private:
  CallbackThread& thread_;
};

/// Gives what callbacks throw to a handler; to the log where there is none.
class ErrorSink {
 public:
  /// This thread, as the one sees it who made the messenger, and so the same for all libraries that
  /// use it.
  CallbackThread& thread() const noexcept {
    // mostly it is this library, whose function can be inlined
    return thread_ == &CallbackThread::ofThisLibrary ? CallbackThread::ofThisLibrary() : thread_();
  }

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

  GSLAM_COLD void report(const std::string& topic, const std::exception_ptr& error) {
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
  CallbackThread& (*const thread_)() noexcept = &CallbackThread::ofThisLibrary;
  std::mutex mutex_;  // guards handler_
  std::shared_ptr<const CallbackErrorHandler> handler_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_ERROR_SINK_H
