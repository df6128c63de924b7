#ifndef GSLAM_APPS_INTERRUPT_H
#define GSLAM_APPS_INTERRUPT_H

#include <functional>

namespace app {

/// Makes Ctrl-C, SIGTERM and SIGHUP wait for a thread that may do anything, instead of a signal
/// handler, which may do little. To be called before any other thread starts.
void holdInterrupts();

/// Calls a function at the first of these signals while it lives, and another, where there is one,
/// at the second. At the next, and where none lives, the process ends with kInterrupted. One at a
/// time.
class OnInterrupt {
 public:
  /// @param stop    is called in another thread, and must return soon
  /// @param insist  likewise, at the second signal; may be empty
  explicit OnInterrupt(std::function<void()> stop, std::function<void()> insist = nullptr);
  OnInterrupt(const OnInterrupt&) = delete;
  OnInterrupt& operator=(const OnInterrupt&) = delete;
  /// Waits for the function, should it run.
  ~OnInterrupt();
};

}  // namespace app

#endif  // GSLAM_APPS_INTERRUPT_H
