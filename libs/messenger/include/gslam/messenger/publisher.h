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
/// A handle: copies are the same publisher. The topic lives as long as any of its handles. All
/// members are thread-safe. A message must not be changed once it is published.
///
/// Messages that one thread publishes reach each subscriber in that order. What a callback throws
/// goes to Messenger::onError(), and the others still get the message.
template <class T>
class Publisher {
 public:
  /// Sends to nobody.
  Publisher() = default;

  /// Sends this message; no copy is made.
  /// @param message  not null; the pointer passed must not be changed by a subscriber meanwhile
  /// @throws ArgumentError when `message` is null
  void publish(const std::shared_ptr<const T>& message) const {
    if (!message) throw ArgumentError("message", "is null, expected one to publish on " + topic());
    detail::Letter<T> letter(message);
    send(letter);
  }

  /// Sends this message. It is moved once, if at all: synchronous subscribers that take a
  /// `const T&` see it where it is.
  void publish(T&& message) const {
    detail::Letter<T> letter(std::move(message));
    send(letter);
  }
  /// Sends this message. It is copied once, if at all.
  void publish(const T& message) const {
    detail::Letter<T> letter(message);
    send(letter);
  }

  /// Name of the topic; empty for a default-constructed publisher.
  std::string topic() const { return link_ ? link_->topic->name() : std::string(); }

  /// Number of those who would get a message now.
  std::size_t subscriberCount() const { return link_ ? link_->topic->subscriptions().size() : 0; }

 private:
  friend class Messenger;
  // Counts as one publisher, however many copies there are.
  struct Link {
    explicit Link(std::shared_ptr<detail::Topic> its_topic) : topic(std::move(its_topic)) {
      ++topic->publisher_count;
      topic->tell(TopicChange::publisher_came);
    }
    ~Link() {
      --topic->publisher_count;
      topic->tell(TopicChange::publisher_left);
    }
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;
    const std::shared_ptr<detail::Topic> topic;
  };

  explicit Publisher(std::shared_ptr<detail::Topic> topic)
      : link_(std::make_shared<const Link>(std::move(topic))) {}
  void send(detail::Letter<T>& letter) const {
    if (link_) link_->topic->deliver(letter);
  }

  std::shared_ptr<const Link> link_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_PUBLISHER_H
