#ifndef GSLAM_MESSENGER_PUBLISHER_H
#define GSLAM_MESSENGER_PUBLISHER_H

#include <gslam/messenger/topic.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

/// @file
/// The sending end of a topic.

namespace gslam {
inline namespace v1 {

class Messenger;

/// Sends messages of type T to one topic. Got from Messenger::advertise().
///
/// A handle: copies send to the same topic, which lives as long as any of its handles. All members
/// are thread-safe. A message must not be changed once it is published.
template <class T>
class Publisher {
 public:
  /// Sends to nobody.
  Publisher() = default;

  /// Calls every subscriber with this message, in this thread, in the order of subscribing; no
  /// copy is made. What a subscriber throws is logged, and the others still get the message.
  /// @param message  not null; the pointer passed must not be changed by a subscriber meanwhile
  /// @throws ArgumentError when `message` is null
  void publish(const std::shared_ptr<const T>& message) const {
    if (!message) throw ArgumentError("message", "is null, expected one to publish on " + topic());
    if (topic_) topic_->deliver(&message);
  }

  /// Moves the message into shared storage once, whatever the number of subscribers.
  void publish(T message) const { publish(std::make_shared<const T>(std::move(message))); }

  /// Name of the topic; empty for a default-constructed publisher.
  std::string topic() const { return topic_ ? topic_->name() : std::string(); }

  /// Number of those who would get a message now.
  std::size_t subscriberCount() const { return topic_ ? topic_->subscriberCount() : 0; }

 private:
  friend class Messenger;
  explicit Publisher(std::shared_ptr<detail::Topic> topic) : topic_(std::move(topic)) {}

  std::shared_ptr<detail::Topic> topic_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_PUBLISHER_H
