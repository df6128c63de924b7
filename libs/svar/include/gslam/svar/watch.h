#ifndef GSLAM_SVAR_WATCH_H
#define GSLAM_SVAR_WATCH_H

#include <gslam/svar/svar.h>

#include <memory>
#include <mutex>
#include <string>
#include <utility>

/// @file
/// Callbacks that run when a value of a SharedSvar changes.

namespace gslam {
inline namespace v1 {
namespace detail {

/// A path and what to call when the value there has changed.
class Watcher {
 public:
  Watcher(std::string path, Svar callback)
      : path_(std::move(path)), callback_(std::move(callback)) {}

  const std::string& path() const noexcept { return path_; }

  void call(const Svar& value) {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    const Svar callback = callback_;  // which may end itself while it runs
    if (!callback.isNull()) callback(value);
  }

  /// Waits for a call that another thread is in; may be called from the callback itself.
  void stop() {
    Svar ended;  // goes when the lock is released, with what it captured
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    ended.swap(callback_);
  }

 private:
  const std::string path_;
  std::recursive_mutex mutex_;  // guards what follows
  Svar callback_;               // a function, or null when it was stopped
};

}  // namespace detail

/// Keeps a callback of SharedSvar::watch() alive. May outlive the SharedSvar. To be used by one
/// thread at a time.
class Watch {
 public:
  /// Watches nothing.
  Watch() = default;
  /// Ends it as reset() does.
  ~Watch() { reset(); }
  /// Takes over what the other watches.
  Watch(Watch&&) noexcept = default;
  /// Ends what this watched before.
  Watch& operator=(Watch&& other) noexcept {
    reset();
    watcher_ = std::move(other.watcher_);
    return *this;
  }

  /// From its return on the callback does not run any more and is destroyed. Waits for the callback
  /// if another thread is in it, so do not call this while you hold a lock that the callback takes.
  void reset() {
    if (watcher_ != nullptr) watcher_->stop();
    watcher_.reset();
  }

 private:
  friend class SharedSvar;
  explicit Watch(std::shared_ptr<detail::Watcher> watcher) : watcher_(std::move(watcher)) {}
  std::shared_ptr<detail::Watcher> watcher_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_WATCH_H
