#ifndef GSLAM_MESSENGER_SUBSCRIBER_H
#define GSLAM_MESSENGER_SUBSCRIBER_H

#include <gslam/messenger/detail/hub.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

/// @file
/// The receiving end of a topic.

namespace gslam {
inline namespace v1 {

class Messenger;

/// A subscription that ends with this object. Got from Messenger::subscribe().
///
/// Movable, not copyable. Not for use by two threads at once, but it may be destroyed in another
/// thread than it was made in, and from inside its own callback.
///
/// When the end returns, the callback does not run and will not run any more: it waits for a
/// callback that another thread is in, so do not end a subscription while you hold a lock that its
/// callback takes. Only from inside of a callback, be it its own or another, it does not wait. The
/// same holds where Messenger::shutDown() ends the subscription at the same time.
///
/// The subscriber of a pattern holds all topics of the messenger, as the messenger does.
class Subscriber {
 public:
  /// Subscribed to nothing.
  Subscriber() = default;
  /// Takes the subscription over; `other` is subscribed to nothing then.
  Subscriber(Subscriber&& other) noexcept = default;
  /// Ends its own subscription and takes the other over.
  Subscriber& operator=(Subscriber&& other) noexcept {
    Subscriber ended(std::move(other));
    hub_.swap(ended.hub_);
    topic_.swap(ended.topic_);
    subscription_.swap(ended.subscription_);
    dropped_.swap(ended.dropped_);
    return *this;
  }
  ~Subscriber() { unsubscribe(); }

  /// Ends the subscription; what waits in its queue is dropped or drained as its options say.
  void unsubscribe() noexcept {
    if (subscription_) unsubscribe(subscription_->atEnd());
  }

  /// Ends the subscription.
  /// @param pending  what becomes of messages that wait in its queue
  void unsubscribe(Pending pending) noexcept {
    // Taken out first: the end of the callback may destroy this object, which it may own.
    const std::shared_ptr<detail::Topic> topic = std::move(topic_);
    const std::shared_ptr<detail::Subscription> subscription = std::move(subscription_);
    const std::shared_ptr<detail::Hub> hub = std::move(hub_);
    if (topic) detail::Hub::end(subscription, &topic, 1, pending);
    if (hub) hub->endPattern(subscription, pending);
  }

  /// Lets the subscription live as long as the topic, without this handle.
  void keep() noexcept {
    const std::shared_ptr<detail::Hub> hub = std::move(hub_);
    const std::shared_ptr<detail::Topic> topic = std::move(topic_);
    const std::shared_ptr<detail::Subscription> subscription = std::move(subscription_);
    dropped_.reset();
  }

  /// Whether the subscription is in force.
  explicit operator bool() const noexcept { return subscription_ != nullptr; }

  /// Name of the topic, or the pattern; empty when subscribed to nothing.
  std::string topic() const { return subscription_ ? subscription_->topic() : std::string(); }

  /// Messages that wait in its queue; 0 for a synchronous one.
  std::size_t waiting() const { return subscription_ ? subscription_->counts().waiting : 0; }
  /// Messages that were dropped because its queue was full, or at its end; also after that.
  std::uint64_t dropped() const { return dropped_ ? dropped_->load() : 0; }

 private:
  friend class Messenger;
  Subscriber(std::shared_ptr<detail::Topic> topic,
             const std::shared_ptr<detail::Subscription>& subscription)
      : topic_(std::move(topic)), subscription_(subscription), dropped_(subscription->dropped()) {}
  Subscriber(std::shared_ptr<detail::Hub> hub,
             const std::shared_ptr<detail::Subscription>& subscription)
      : hub_(std::move(hub)), subscription_(subscription), dropped_(subscription->dropped()) {}

  std::shared_ptr<detail::Hub> hub_;      // of a pattern, which may be in any topic; else null
  std::shared_ptr<detail::Topic> topic_;  // null for a pattern
  std::shared_ptr<detail::Subscription> subscription_;
  detail::SharedCount dropped_;  // null where nothing can be dropped
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_SUBSCRIBER_H
