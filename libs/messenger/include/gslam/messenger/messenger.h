#ifndef GSLAM_MESSENGER_MESSENGER_H
#define GSLAM_MESSENGER_MESSENGER_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
#include <gslam/messenger/publisher.h>
#include <gslam/messenger/subscriber.h>
#include <gslam/messenger/topic.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <typeinfo>
#include <utility>

/// @file
/// Publish and subscribe by topic inside one process.

namespace gslam {
inline namespace v1 {

/// Publisher and subscriber of one topic do not agree on the message type.
class GSLAM_PUBLIC TypeMismatch : public Error {
 public:
  /// @param topic  name of the topic
  /// @param has    type it was first used with
  /// @param asked  type asked for now
  TypeMismatch(const std::string& topic, const std::string& has, const std::string& asked)
      : Error("topic " + topic + " carries " + has + ", not " + asked) {}
};

/// Connects publishers and subscribers by the name and type of a topic.
///
/// A handle: copies are the same messenger. It may go before its publishers and subscribers do. A
/// topic takes its type from whoever comes first and keeps it as long as the messenger lives.
/// All members are thread-safe.
class Messenger {
 public:
  Messenger() : state_(std::make_shared<State>()) {}

  /// Makes a sender for a topic.
  /// @param topic  parts of letters, digits and `_`, joined by `/`; the leading `/` may be left out
  /// @throws ArgumentError for another name, TypeMismatch when the topic carries another type
  template <class T>
  Publisher<T> advertise(const std::string& topic) const {
    return Publisher<T>(find(topic, typeid(T)));
  }

  /// Calls `callback` in the publisher's thread with each message that is published from now on.
  /// @return the handle that holds the subscription: without it the subscription ends at once
  /// @throws ArgumentError for an empty callback or an impossible name, TypeMismatch when the topic
  ///         carries another type
  template <class T>
  GSLAM_NODISCARD Subscriber
  subscribe(const std::string& topic,
            std::function<void(const std::shared_ptr<const T>&)> callback) const {
    if (!callback) throw ArgumentError("callback", "is empty, expected a function");
    const std::shared_ptr<detail::Topic> found = find(topic, typeid(T));
    const auto subscription =
        std::make_shared<detail::Subscription>([callback](const void* message) {
          callback(*static_cast<const std::shared_ptr<const T>*>(message));
        });
    found->add(subscription);
    return Subscriber(found, subscription);
  }

 private:
  struct State {
    std::mutex mutex;
    std::map<std::string, std::shared_ptr<detail::Topic>> topics;
  };

  std::shared_ptr<detail::Topic> find(const std::string& topic, const std::type_info& type) const {
    const std::string name = checkedName(topic);
    std::lock_guard<std::mutex> lock(state_->mutex);
    std::shared_ptr<detail::Topic>& found = state_->topics[name];
    if (!found) found = std::make_shared<detail::Topic>(name, type);
    if (found->type() != type) {
      throw TypeMismatch(name, detail::readableTypeName(found->type().name()),
                         detail::readableTypeName(type.name()));
    }
    return found;
  }

  static std::string checkedName(const std::string& topic) {
    std::string name = (topic.empty() || topic[0] != '/') ? "/" + topic : topic;
    bool part_begins = true;
    for (char c : name.substr(1)) {
      const bool word =
          (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
      if (!word && (c != '/' || part_begins)) refuseName(topic);
      part_begins = c == '/';
    }
    if (part_begins) refuseName(topic);
    return name;
  }

  [[noreturn]] static void refuseName(const std::string& topic) {
    throw ArgumentError("topic", "is \"" + topic +
                                     "\", expected a name such as /sensor/imu, of letters, digits, "
                                     "_ and single slashes");
  }

  std::shared_ptr<State> state_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_MESSENGER_H
