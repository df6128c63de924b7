#ifndef GSLAM_MESSENGER_INBOX_H
#define GSLAM_MESSENGER_INBOX_H

#include <gslam/messenger/subscriber.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

/// @file
/// Messages that wait until somebody asks for them.

namespace gslam {
inline namespace v1 {

/// A subscription without a callback. Got from Messenger::inbox(). Movable; take(), waitFor() and
/// the counts may be called by several threads at once.
template <class T>
class Inbox {
 public:
  /// Gets nothing.
  Inbox() = default;

  /// The message that waited longest, or null where none does.
  std::shared_ptr<const T> take() {
    std::shared_ptr<const T> message;
    if (subscription_) subscription_->queue().tryPop(message);
    return message;
  }

  /// The same; waits for one, but no longer than that, where there is none.
  template <class Rep, class Period>
  std::shared_ptr<const T> waitFor(const std::chrono::duration<Rep, Period>& time) {
    std::shared_ptr<const T> message;
    if (subscription_) subscription_->queue().waitPopFor(message, time);
    return message;
  }

  /// The newest message, or null where none waits; those before it are dropped, and counted as
  /// such.
  std::shared_ptr<const T> takeLatest() {
    std::shared_ptr<const T> latest = take();
    for (std::shared_ptr<const T> next = take(); next != nullptr; next = take()) {
      latest.swap(next);
      subscription_->queue().countDropped(1);
    }
    return latest;
  }

  /// Number of messages that wait; after the end those that are to be drained.
  std::size_t waiting() const { return subscription_ ? subscription_->counts().waiting : 0; }
  /// Number of messages that were dropped, also after the end.
  std::uint64_t dropped() const { return subscriber_.dropped(); }
  /// Name of the topic; empty where there is none.
  std::string topic() const { return subscriber_.topic(); }
  /// Ends the subscription; who waits gets null.
  void unsubscribe() noexcept { subscriber_.unsubscribe(); }

 private:
  friend class Messenger;
  using Subscription = detail::InboxSubscription<detail::TypedPayload<T>>;
  Inbox(Subscriber subscriber, std::shared_ptr<Subscription> subscription)
      : subscription_(std::move(subscription)), subscriber_(std::move(subscriber)) {}

  std::shared_ptr<Subscription> subscription_;
  Subscriber subscriber_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_INBOX_H
