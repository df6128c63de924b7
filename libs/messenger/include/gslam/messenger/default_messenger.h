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
  std::mutex mutex;
  Messenger messenger;

  static DefaultMessenger& ofProgram() {
    static DefaultMessenger* const made = new DefaultMessenger;
    return *made;
  }
};

/// Ends its subscriptions before the rest of the program does.
struct DefaultMessengerEnd {
  ~DefaultMessengerEnd() {
    DefaultMessenger& ours = DefaultMessenger::ofProgram();
    const std::unique_lock<std::mutex> lock(ours.mutex);
    const Messenger messenger = ours.messenger;
    ours.messenger = Messenger();
    if (is_ours) messenger.shutDown(Pending::discard);
  }
  bool is_ours = true;
};

inline DefaultMessengerEnd& defaultMessengerEnd() {
  static DefaultMessengerEnd end;
  return end;
}

}  // namespace detail

/// The messenger that a program and its libraries share where they are not handed one. A plugin
/// that was built with hidden visibility has one of its own until its host calls
/// setDefaultMessenger() in it. At the end of the program its subscriptions end, and what waits is
/// dropped. Thread-safe.
inline Messenger defaultMessenger() {
  detail::DefaultMessenger& ours = detail::DefaultMessenger::ofProgram();
  detail::defaultMessengerEnd();
  const std::lock_guard<std::mutex> lock(ours.mutex);
  return ours.messenger;
}

/// Makes another one the default, for who asks from now on: how a host hands its own over to a
/// plugin. It is not shut down at the end. Thread-safe.
inline void setDefaultMessenger(const Messenger& messenger) {
  detail::DefaultMessenger& ours = detail::DefaultMessenger::ofProgram();
  detail::DefaultMessengerEnd& end = detail::defaultMessengerEnd();
  const std::lock_guard<std::mutex> lock(ours.mutex);
  ours.messenger = messenger;
  end.is_ours = false;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DEFAULT_MESSENGER_H
