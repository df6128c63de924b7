#ifndef GSLAM_MESSENGER_DEFAULT_MESSENGER_H
#define GSLAM_MESSENGER_DEFAULT_MESSENGER_H

#include <gslam/messenger/messenger.h>

#include <mutex>

/// @file
/// The messenger of those who are not told which to use.

namespace gslam {
inline namespace v1 {
namespace detail {

/// Never destroyed, so that static destructors may publish.
struct DefaultMessenger {
  std::mutex mutex;  // guards all below
  Messenger messenger;
  bool is_ours = true;  // else of the host
  long process = processId();
  struct Parents {
    Messenger messenger;
    Parents* others;
  };
  Parents* parents = nullptr;

  static DefaultMessenger& ofProgram() {
    static DefaultMessenger* const made = new DefaultMessenger;
    return *made;
  }

  /// In a child of fork() the messenger is one of the parent's, whose threads are not here: it is
  /// left alone for good.
  void forgetParent() {
    if (process == processId()) return;
    parents = new Parents{messenger, parents};  // never destroyed
    replace(Messenger(), true);
  }
  void replace(const Messenger& other, bool other_is_ours) {
    messenger = other;
    is_ours = other_is_ours;
    process = processId();
  }
};

/// Ends its subscriptions before the rest of the program does.
struct DefaultMessengerEnd {
  ~DefaultMessengerEnd() {
    DefaultMessenger& ours = DefaultMessenger::ofProgram();
    std::unique_lock<std::mutex> lock(ours.mutex);
    ours.forgetParent();
    const Messenger last = ours.messenger;
    const bool was_ours = ours.is_ours;
    ours.replace(Messenger(), true);
    lock.unlock();
    if (was_ours) last.shutDown(Pending::discard);
  }
};

inline void endDefaultMessenger() {
  static const DefaultMessengerEnd end;
}

}  // namespace detail

/// The messenger that a program and its libraries share where they are not handed one. A plugin
/// that was built with hidden visibility has one of its own until its host calls
/// setDefaultMessenger() in it. At the end of the program its subscriptions end, and what waits is
/// dropped; whoever asks after that gets one on which nobody listens. A child of fork() has a new
/// one. Thread-safe.
inline Messenger defaultMessenger() {
  detail::DefaultMessenger& ours = detail::DefaultMessenger::ofProgram();
  detail::endDefaultMessenger();
  const std::lock_guard<std::mutex> lock(ours.mutex);
  ours.forgetParent();
  return ours.messenger;
}

/// Makes another one the default, for who asks from now on: how a host hands its own over to a
/// plugin. It is not shut down at the end. Thread-safe.
inline void setDefaultMessenger(const Messenger& messenger) {
  detail::DefaultMessenger& ours = detail::DefaultMessenger::ofProgram();
  detail::endDefaultMessenger();
  Messenger before;  // ends without the lock
  const std::lock_guard<std::mutex> lock(ours.mutex);
  ours.forgetParent();
  before = ours.messenger;
  ours.replace(messenger, false);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DEFAULT_MESSENGER_H
