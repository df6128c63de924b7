#ifndef GSLAM_MESSENGER_SUBSCRIBER_H
#define GSLAM_MESSENGER_SUBSCRIBER_H

#include <gslam/messenger/topic.h>

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
class Subscriber {
 public:
  /// Subscribed to nothing.
  Subscriber() = default;
  /// Takes the subscription over; `other` is subscribed to nothing then.
  Subscriber(Subscriber&& other) noexcept = default;
  /// Ends its own subscription and takes the other over.
  Subscriber& operator=(Subscriber&& other) noexcept {
    Subscriber ended(std::move(other));
    topic_.swap(ended.topic_);
    subscription_.swap(ended.subscription_);
    return *this;
  }
  ~Subscriber() { unsubscribe(); }

  /// Ends the subscription. Messages that are published from now on do not reach the callback. A
  /// message that another thread is delivering at this moment still may, also after this returns:
  /// what the callback refers to must outlive that delivery.
  void unsubscribe() noexcept {
    // Taken out first: the end of the callback may destroy this object, which it may own.
    const std::shared_ptr<detail::Topic> topic = std::move(topic_);
    const std::shared_ptr<detail::Subscription> subscription = std::move(subscription_);
    if (subscription) topic->remove(subscription);
  }

  /// Lets the subscription live as long as the topic, without this handle.
  void keep() noexcept {
    const std::shared_ptr<detail::Topic> topic = std::move(topic_);
    const std::shared_ptr<detail::Subscription> subscription = std::move(subscription_);
  }

  /// Whether the subscription is in force.
  explicit operator bool() const noexcept { return subscription_ != nullptr; }

  /// Name of the topic; empty when subscribed to nothing.
  std::string topic() const { return topic_ ? topic_->name() : std::string(); }

 private:
  friend class Messenger;
  Subscriber(std::shared_ptr<detail::Topic> topic,
             std::shared_ptr<detail::Subscription> subscription)
      : topic_(std::move(topic)), subscription_(std::move(subscription)) {}

  std::shared_ptr<detail::Topic> topic_;
  std::shared_ptr<detail::Subscription> subscription_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_SUBSCRIBER_H
