#ifndef GSLAM_MESSENGER_DEFAULT_MESSENGER_H
#define GSLAM_MESSENGER_DEFAULT_MESSENGER_H

#include <gslam/messenger/messenger.h>

#include <atomic>
#include <mutex>

/// @file
/// The messenger of those who are not told which to use.

namespace gslam {
inline namespace v1 {
namespace detail {

/// One for each process: in a child of fork() that of the parent is left alone for good, as its
/// threads are not here, and one may have held the mutex. Never destroyed, so that static
/// destructors may publish.
struct DefaultMessenger {
  explicit DefaultMessenger(const DefaultMessenger* of_parent) : parents(of_parent) {}

  static DefaultMessenger& ofProcess() {
    static std::atomic<DefaultMessenger*> latest{nullptr};
    DefaultMessenger* found = latest.load();
    while (found == nullptr || found->process != processId()) {
      DefaultMessenger* const made = new DefaultMessenger(found);
      if (latest.compare_exchange_strong(found, made)) return *made;
      delete made;  // another thread was faster
    }
    return *found;
  }

  const long process = processId();
  const DefaultMessenger* const parents;  // kept, for whoever looks for leaks
  std::mutex mutex;                       // guards all below
  Messenger messenger;
  bool is_ours = true;  // else of the host
};

/// Ends its subscriptions before the rest of the program does.
struct DefaultMessengerEnd {
  ~DefaultMessengerEnd() {
    DefaultMessenger& ours = DefaultMessenger::ofProcess();
    std::unique_lock<std::mutex> lock(ours.mutex);
    const Messenger last = ours.messenger;
    const bool was_ours = ours.is_ours;
    ours.messenger = Messenger();
    ours.is_ours = true;
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
/// one, and its exit() leaves the parent's alone; but it destroys static subscribers and messengers
/// of the parent, so where there are such it must end with _exit(). Thread-safe.
inline Messenger defaultMessenger() {
  detail::DefaultMessenger& ours = detail::DefaultMessenger::ofProcess();
  detail::endDefaultMessenger();
  const std::lock_guard<std::mutex> lock(ours.mutex);
  return ours.messenger;
}

/// Makes another one the default, for who asks from now on: how a host hands its own over to a
/// plugin, which must have been built with the same minor version of messenger. It is not shut down
/// at the end. Thread-safe.
inline void setDefaultMessenger(const Messenger& messenger) {
  detail::DefaultMessenger& ours = detail::DefaultMessenger::ofProcess();
  detail::endDefaultMessenger();
  Messenger before;  // ends without the lock
  const std::lock_guard<std::mutex> lock(ours.mutex);
  before = ours.messenger;
  ours.messenger = messenger;
  ours.is_ours = false;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DEFAULT_MESSENGER_H
